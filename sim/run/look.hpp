// A look at measured data before anything is done with them: simulated, and what is wrong with them.
#pragma once

#include <cstddef>
#include <vector>

#include <sim/data/examine.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::run {

/// `replayed`: all runs of the data set.
std::vector<data::Expected> expected_of(const domain::Dataset& data,
                                        const std::vector<ReplayedRun>& replayed);

/// Runs that are to begin at rest, and swing on longer than they were given.
void add_not_at_rest(const domain::Dataset& data, const std::vector<ReplayedRun>& replayed,
                     std::vector<data::Finding>& findings);

/// Adds readings that are so far off that no effect is missing, but a description is wrong, unless what is
/// wrong has been found.
void add_far_off(const domain::Dataset& data, const std::vector<ReplayedRun>& replayed,
                 std::vector<data::Finding>& findings);

struct Look {
  std::vector<data::Finding> findings;
  std::size_t runs = 0;  ///< that were looked at
};
/// Simulates as much of the runs as takes a few seconds, and looks at it: all that `diagnose` finds without a
/// fit. Where not all was simulated, at columns and loads only. Throws Interrupted.
Look look(domain::Dataset data);

}  // namespace mckibben::run
