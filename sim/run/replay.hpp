// A data set simulated again with its recorded currents, and how far the simulation is from what was
// measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// One measured run and its simulation.
struct ReplayedRun {
  std::string id;
  double load_kg = 0.0;
  Recording recording{};
  double rmse = 0.0;           ///< simulated encoder reading against measured, contraction ratio
  double largest_error = 0.0;  ///< of the same
  double mean_error = 0.0;     ///< simulated minus measured
  std::optional<double> pressure_rmse_Pa{};  ///< muscle pressure, if a gauge was fitted
  std::string failure{};                     ///< why the integrator gave up; empty if it did not
};

/// Simulates every run of a data set. Of runs that were not begun when the user stopped, `failure` says so
/// (`not_begun`).
std::vector<ReplayedRun> replay(const domain::Dataset& dataset, unsigned threads,
                                const ProgressHook& progress);

}  // namespace mckibben::run
