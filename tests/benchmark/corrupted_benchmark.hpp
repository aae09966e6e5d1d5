// Scores what the diagnosis says of data that were spoilt on purpose.
#pragma once

#include <cstdint>
#include <string>

#include "whole.hpp"

namespace mckibben::diagnose {

/// Every corruption of three data sets whose label, "DATA SET: CORRUPTION", begins with `wanted`, of
/// each seed; a row each on stdout, then the score.
void score_corrupted(Asked asked, std::uint64_t first, std::uint64_t seeds, const std::string& wanted);

}  // namespace mckibben::diagnose
