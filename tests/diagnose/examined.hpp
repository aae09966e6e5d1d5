// Six planted runs, examined for faults of their recording.
#pragma once

#include <algorithm>
#include <vector>

#include <sim/diagnose/first_look.hpp>
#include <sim/diagnose/priors.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {

inline Checked no_doubts(const domain::Dataset& data) {
  Checked checked;
  for (const domain::Run& run : data.runs) checked.masked.emplace_back(run.contraction_ratio.size(), false);
  return checked;
}

inline std::vector<Fault> faults_of(const domain::Dataset& data, const std::vector<Candidate>& effects = {}) {
  const Experiment experiment(data, no_doubts(data).masked, 2);
  return examine(experiment, {data.rig, nominal_parameters(data.rig)}, {0, 1, 2, 3, 4, 5}, effects).faults;
}

/// Its readings come so many rows later, from a row on.
inline void delay(domain::Run& run, std::size_t ticks, std::size_t from = 0) {
  auto& ratios = run.contraction_ratio;
  for (std::size_t k = ratios.size(); k-- > from + ticks;) ratios[k] = ratios[k - ticks];
}
/// Its readings come so many rows earlier.
inline void hasten(domain::Run& run, std::size_t ticks) {
  auto& ratios = run.contraction_ratio;
  for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] = ratios[std::min(k + ticks, ratios.size() - 1)];
}

}  // namespace mckibben::diagnose
