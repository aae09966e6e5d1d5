// Sets of effects that explain a gap together, all of up to four effects at once: on the Gram matrix of what
// each changes, less what the free parameters imitate (projected scores), a set costs a small linear system
// and no simulation. Greedy search misses sets of which the first member is not the best single one (Miller,
// Subset Selection in Regression, 1990).
#pragma once

#include <vector>

#include <sim/diagnose/screen.hpp>

namespace mckibben::diagnose {

struct Subset {
  std::vector<Score> members;  ///< with the sizes that they have beside each other
  double drop = 0.0;           ///< expected in the sum of squares / inflation
};

/// The sets that promise most, best first: of two effects and more, all with a sign that their laws allow,
/// and none that the others could do without. Of one effect one law at a time; of a pair, each muscle
/// may have its own.
std::vector<Subset> best_subsets(const std::vector<Score>& scores);

}  // namespace mckibben::diagnose
