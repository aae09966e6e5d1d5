// Loads weighed by their own runs: a label that contradicts what all other runs say.
#pragma once

#include <optional>
#include <vector>

#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/faults.hpp>

namespace mckibben::diagnose {

struct WrongLabel {
  std::size_t run;
  double load_kg;                ///< that it seems to have
  std::optional<Fault> other{};  ///< of its readings or its current, if that explains it better
};

struct Labels {
  std::vector<WrongLabel> wrong{};
  double common_ratio = 1.0;  ///< median of the load that fits over its label
};

/// The least number of runs whose labels can contradict each other.
inline constexpr std::size_t least_labels = 4;

/// The runs whose label is doubted. The load that fits a run best, less its label, is compared with that of
/// the other runs: an offset common to all, or in proportion to the load, is no wrong label, and hidden
/// effects scatter it. The run must then fit much better, and the others much worse with the same offset.
/// None below four runs; errors below about 0.8 kg at 11 kg, 1.2 kg at 23 kg are not found. Throws
/// engine::NumericalFailure, run::Interrupted.
Labels check_labels(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, Runs runs,
                    unsigned threads);

}  // namespace mckibben::diagnose
