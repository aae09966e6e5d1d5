// Second thoughts about effects that have been named: which are still needed, which another one beats, which
// have no certain size, and which matters most.
#pragma once

#include <sim/diagnose/name.hpp>

namespace mckibben::diagnose {

/// What was taken first may have stood in for what came after it: drops effects that are no longer needed,
/// and swaps those that another one beats now.
void revise(const Case& c, Naming& result, const Eigen::VectorXd& reference, const Step& step);

/// Drops effects whose 99 % interval reaches "absent".
void drop_uncertain(const Case& c, Naming& result, const Step& step);

/// Takes an effect and what was said of it out of the names.
void forget(Naming& result, const Candidate& gone);

/// Names in their last form: by how much worse the runs held out are without each, terms of one law as one
/// effect, no doubts about what has been named itself.
void settle(const Case& c, Naming& result);

}  // namespace mckibben::diagnose
