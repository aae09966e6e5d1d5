// Results as bytes, for other processes of the same program on the same kind of machine.
#pragma once

#include <string>

#include <sim/run/compare.hpp>

namespace mckibben::run {

std::string packed(const TrackedRun& run);
std::string packed(const TunedController& tuned);

/// What `packed` made. Throws std::invalid_argument if the bytes are not that.
TrackedRun unpacked_run(const std::string& bytes);
TunedController unpacked_tuning(const std::string& bytes);

}  // namespace mckibben::run
