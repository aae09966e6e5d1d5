// Where a diagnosis starts from: the rig as it is described, and the same with its numbers fitted.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// The rig as described on all runs, nothing moved; what its free parameters would change.
Contender replay(const Case& c);

struct Recalibrated {
  Contender contender{};
  std::vector<Rig> other_ends{};  ///< where it ended from other places, if not all ended alike
  std::size_t begun = 1;          ///< places it was begun from
  std::string failure{};          ///< why nothing could be fitted: the rig is as described; empty if it could
};

/// The nominal parameters, and the sizes of effects that the rig has already, fitted to the training runs.
/// Those that are wide are begun with from several places. Where that comes near the floor, `c` takes over
/// how the residuals scatter, and it is fitted again.
Recalibrated recalibrate(Case& c, const Contender& nominal);

}  // namespace mckibben::diagnose
