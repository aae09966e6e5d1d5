// Recordings as CSV: header on line 1, one row each tick, shortest digits that read back exactly.
#pragma once

#include <string>
#include <vector>

#include <sim/run/recording.hpp>

namespace mckibben::output {

/// True values, and what the encoder counted. `target` [contraction ratio] and the gauge are columns where
/// there are any. `per_count` is the contraction ratio of one encoder count.
std::string csv_of(const run::Recording& recording, double per_count, const std::vector<double>& target,
                   bool gauge);

}  // namespace mckibben::output
