// Sanity before physics: whether measured runs can be what they say they are. Signs, units, exchanged columns
// and labels of loads, from what the rig as described would do with the same currents. A finding is only what
// no effect of the catalogue and no muscle a third stronger or weaker could explain.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/input/diagnostics.hpp>

namespace mckibben::run {

/// What the rig would do in a run, a value each tick; empty if it was not simulated, shorter if not to its
/// end.
struct Expected {
  std::vector<double> contraction_ratio{}, pressure_Pa{};
};

struct ReplayedRun;
std::vector<Expected> expected_of(const std::vector<ReplayedRun>& replayed);

/// A run and the load that it seems to have.
struct SeemingLoad {
  std::size_t run;
  double load_kg;
};

struct Finding {
  std::string quantity;           ///< as in the data set's file: contraction, current, muscle_pressure, load
  std::vector<std::size_t> runs;  ///< ascending
  std::string message;            ///< what is wrong, and what to write instead
  bool certain = true;            ///< the numbers are not what they are called: nothing follows from them
  std::vector<SeemingLoad> exchanged{};  ///< loads that have each other's labels, and what they should be
};

/// `expected`: one for each run of the data set.
std::vector<Finding> sanity(const domain::Dataset& data, const std::vector<Expected>& expected);

struct Look {
  std::vector<Finding> findings;
  std::size_t runs = 0;  ///< that were looked at
};
/// Simulates as many of the runs as take a few seconds at most, and looks at them. Throws Interrupted.
Look look(const domain::Dataset& data);

/// As "run r02: MESSAGE", "runs r01, r02: MESSAGE" or "all runs: MESSAGE".
std::string text_of(const domain::Dataset& data, const Finding& finding);

/// The findings at their places in the data set's file: errors if certain, otherwise warnings.
std::vector<input::Problem> problems_of(const domain::Dataset& data, const std::vector<Finding>& findings);

/// Throws input::BadInput with all findings if one of them is certain.
void raise(const domain::Dataset& data, const std::vector<Finding>& findings);

}  // namespace mckibben::run
