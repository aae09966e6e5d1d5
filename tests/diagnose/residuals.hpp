// What a rig leaves of measured runs.
#pragma once

#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// Of these runs one after the other, each over its floor.
inline Eigen::VectorXd residuals_of(const Experiment& experiment, const Rig& rig, const Runs& runs) {
  const auto readings = experiment.readings(rig, runs);
  Eigen::VectorXd all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Eigen::VectorXd of_run = experiment.residuals(readings[i], runs[i]);
    all.conservativeResize(all.size() + of_run.size());
    all.tail(of_run.size()) = of_run;
  }
  return all;
}

}  // namespace mckibben::diagnose
