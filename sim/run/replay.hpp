// A data set simulated again with what drove it, and how far the simulation is from what was measured.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// One measured run and its simulation.
struct ReplayedRun {
  std::string id;
  double load_kg = 0.0;  ///< where one hangs
  Recording recording{};
  std::vector<Gap> gaps{};  ///< of each reading that there is; none if the integrator gave up
  std::string failure{};    ///< why it gave up; empty if it did not

  /// Null where that was not read.
  const Gap* gap(std::string_view reading) const {
    const auto found = std::ranges::find(gaps, reading, &Gap::reading);
    return found == gaps.end() ? nullptr : &*found;
  }
};

/// Simulates every run of a data set. Of runs that were not begun when the user stopped, `failure` says so
/// (`not_begun`).
std::vector<ReplayedRun> replay(const domain::Dataset& dataset, unsigned threads,
                                const ProgressHook& progress);

}  // namespace mckibben::run
