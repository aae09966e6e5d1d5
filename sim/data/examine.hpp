// Whether measured runs can be what they say they are, before physics: units, signs, exchanged columns,
// labels of loads, single readings, gauges. Compared with what the rig as described would do; found is only
// what no effect of the catalogue and no muscle a third stronger or weaker could explain.
#pragma once

#include <cstddef>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// What the rig would do in a run, a value each row; empty if it was not simulated, shorter if not to its
/// end.
struct Expected {
  std::vector<double> judged{};  ///< contraction ratio; the cord's force [N] at a given length; angle [rad]
  std::vector<double> pressure_Pa{}, opposite_pressure_Pa{};  ///< the latter of a pair only
  // Where they were read beside: force of the cord, pressures in the valves.
  std::vector<double> force_N{}, valve_pressure_Pa{}, opposite_valve_pressure_Pa{};

  std::vector<double>& beside(domain::Beside which) {
    using enum domain::Beside;
    if (which == force) return force_N;
    if (which == valve_pressure) return valve_pressure_Pa;
    if (which == opposite_valve_pressure) return opposite_valve_pressure_Pa;
    return which == muscle_pressure ? pressure_Pa : opposite_pressure_Pa;
  }
  const std::vector<double>& beside(domain::Beside which) const {
    return const_cast<Expected*>(this)->beside(which);
  }
};

struct Examined {
  std::vector<Finding> findings{};          ///< one that is refused: nothing else was looked for
  std::vector<std::vector<bool>> masked{};  ///< [run][row]: readings that are not the load's
  std::vector<bool> left_out{};             ///< [run]: a diagnosis does without it
  std::vector<std::size_t> dead_gauges{}, dead_opposite_gauges{};  ///< runs whose gauge says nothing
};

/// Columns and loads; if they are what they are called, single readings and jumps that no load could follow,
/// a reading that froze, gauges that are dead, runs that never move, copies. `expected`: one for each run.
Examined examine(const domain::Dataset& data, const std::vector<Expected>& expected);

/// Too few runs for a diagnosis, or too few loads; adds to `findings`.
void require_enough(const domain::Dataset& data, const std::vector<bool>& left_out,
                    std::vector<Finding>& findings);

/// Whether a run's readings are counts of an encoder.
bool counts(const domain::Dataset& data, const domain::Run& run);

}  // namespace mckibben::data
