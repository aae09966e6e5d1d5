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
  std::vector<std::vector<double>> readings{};  ///< as the run's
  std::vector<double> pressure_Pa{};            ///< of muscle 1, also where it was not read

  const std::vector<double>& judged() const {
    static const std::vector<double> none;
    return readings.empty() ? none : readings.front();
  }
};

/// A gauge of a run that says nothing.
struct DeadGauge {
  std::size_t run;
  plant::Channel channel;
};

struct Examined {
  std::vector<Finding> findings{};          ///< one that is refused: nothing else was looked for
  std::vector<std::vector<bool>> masked{};  ///< [run][row]: readings that are not the load's
  std::vector<bool> left_out{};             ///< [run]: a diagnosis does without it
  std::vector<DeadGauge> dead_gauges{};
};

/// Columns and loads; if they are what they are called, single readings and jumps that no load could follow,
/// a reading that froze, gauges that are dead, runs that never move, copies. `expected`: one for each run.
Examined examine(const domain::Dataset& data, const std::vector<Expected>& expected);

/// Too few runs for a diagnosis, or too few loads; adds to `findings`.
void require_enough(const domain::Dataset& data, const std::vector<bool>& left_out,
                    std::vector<Finding>& findings);

/// What would, where they are too few: "at least four runs would help, with two loads and ...".
std::string runs_that_would_help(const domain::Dataset& data);

/// Whether a run's readings are counts of an encoder.
bool counts(const domain::Dataset& data, const domain::Run& run);

}  // namespace mckibben::data
