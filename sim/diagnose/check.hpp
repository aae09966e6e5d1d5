// Whether measured data can be trusted, before anything is concluded from them: wrong units are errors; what
// else looks wrong is masked or left out, and said by name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

struct Checked {
  std::vector<std::vector<bool>> masked;     ///< [run][row]: readings that are not the load's
  Runs left_out;                             ///< ascending
  Runs contradicted{};                       ///< of these: by what the other runs say of their load
  Runs sound{};                              ///< believed: no fault of their own is looked for in them
  Runs dead_gauges;                          ///< runs whose muscle pressure says nothing: ignore it
  Runs dead_opposite_gauges{};               ///< the same of muscle 2's
  std::vector<std::string> warnings;         ///< each names its run
  std::vector<FaultyRun> faulty{};           ///< of runs left out or mended, for the verdict's sentence
  std::optional<std::string> cannot_tell{};  ///< why no answer is possible, and what would help

  bool is_sound(std::size_t run) const { return std::ranges::find(sound, run) != sound.end(); }
};

/// Looks for single readings and jumps that no load could follow, a reading that froze, gauges that are dead,
/// runs that never move, labels of loads that contradict the other runs, and too few runs or loads. The model
/// is the data set's rig as it is, so a test fires only where no effect of the catalogue and no tolerance of
/// a parameter could be the reason.
///
/// Labels of loads that contradict the other runs: see labels.hpp. `sound` runs are believed.
///
/// Throws data::UnfitData where a column is in another unit, or has another sign, than it says;
/// engine::NumericalFailure; run::Interrupted.
Checked check(const domain::Dataset& data, unsigned threads, Runs sound = {});

}  // namespace mckibben::diagnose
