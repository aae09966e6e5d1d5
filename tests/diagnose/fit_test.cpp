// How far a fit goes: rigs that are badly known, whose numbers are far from what is written.
#include <algorithm>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/priors.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Each number may be off by three times what is usual, and is off by as much as scatter makes it.
domain::Dataset badly_known(std::uint64_t seed) {
  RigFile described;
  for (const Parameter& p : nominal_parameters(described))
    if (p.path != "muscle.dead_volume") described.spreads[p.path] = 3.0 * p.scale;
  RigFile truth = described;
  std::mt19937_64 random(seed);
  for (const Parameter& p : nominal_parameters(described, described.spreads))
    p.put(truth,
          std::clamp(p.origin + p.scale * std::normal_distribution(0.0, 1.0)(random), p.lowest, p.highest));
  domain::Dataset data = small(truth, 2.4);
  data.rig.spreads = described.spreads;
  return data;
}

TEST(Fit, ArrivesHoweverFarTheRigIsFromItsSheet) {
  for (const std::uint64_t seed : {13, 21}) {  // numbers that come to bounds on the way
    const domain::Dataset data = badly_known(seed);
    const auto masked = nothing_masked(data);
    const Experiment experiment(data, masked, 2);
    Case c{experiment, data.rig, split(data, {0, 1, 2, 3, 4, 5}), 20.0, {}};
    const Recalibrated found = diagnose::recalibrate(c, replay(c));
    EXPECT_LT(excess(found.contender.fitted.residuals), 0.1) << seed;
  }
}

}  // namespace
}  // namespace mckibben::diagnose
