// Scores what the diagnosis says of data that were spoilt on purpose.
#pragma once

#include <string>

#include "whole.hpp"

namespace mckibben::diagnose {

/// Every corruption of three data sets whose label, "DATA SET: CORRUPTION", contains `only`; a row each on
/// stdout, then the score.
void score_corrupted(const Asked& asked, const std::string& only);

}  // namespace mckibben::diagnose
