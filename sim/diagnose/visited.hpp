// The ranges that runs cover.
#pragma once

#include <string>

#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// In words.
std::string visited(const domain::Dataset& data, const Runs& runs);

}  // namespace mckibben::diagnose
