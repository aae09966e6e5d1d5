// Sanity before physics: whether measured runs can be what they say they are. Signs, units, exchanged columns
// and labels of loads, from what the rig as described would do with the same currents. Objected to is only
// what no effect of the catalogue and no muscle a third stronger or weaker could explain.
#pragma once

#include <cstddef>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/domain/objection.hpp>

namespace mckibben::run {

/// What the rig would do in a run, a value each tick; empty if it was not simulated, shorter if not to its
/// end.
struct Expected {
  std::vector<double> contraction_ratio{}, pressure_Pa{};
};

struct ReplayedRun;
std::vector<Expected> expected_of(const std::vector<ReplayedRun>& replayed);

/// `expected`: one for each run of the data set.
std::vector<domain::Objection> sanity(const domain::Dataset& data, const std::vector<Expected>& expected);

struct Look {
  std::vector<domain::Objection> objections;
  std::size_t runs = 0;  ///< that were looked at
};
/// Simulates as many of the runs as take a few seconds at most, and looks at them. Throws Interrupted.
Look look(const domain::Dataset& data);

/// Throws domain::UnfitData with all objections if one of them is certain.
void raise(const domain::Dataset& data, const std::vector<domain::Objection>& objections);

}  // namespace mckibben::run
