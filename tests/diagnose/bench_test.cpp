// Forces at given lengths: what a rig would show, and what a zero of the length does.
#include "bench.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>
#include <sim/diagnose/experiment.hpp>

#include "planted.hpp"
#include "residuals.hpp"

namespace mckibben::diagnose {
namespace {

TEST(Bench, ForcesAreThoseOfTheCord) {
  const plant::Rig rig;
  const domain::Dataset data = on_a_bench(rig, 0.0);
  const Loaded held{rig, 0.0};
  const auto readings = predict(data.runs[2], {&held, 1}).front();
  for (std::size_t k = 0; k < 9; ++k)  // no length moves: threads do not rub
    EXPECT_NEAR(readings.judged()[k], plant::Braid(rig.muscle).force_N(0.11, readings.pressure_Pa[k]), 1e-6);
  const Experiment experiment(data, nothing_masked(data), 1, {0, 1, 2, 3, 4});
  EXPECT_LT(experiment.rmse(residuals_of(experiment, rig, {0, 1, 2, 3, 4}), {0, 1, 2, 3, 4}), 1e-6);
}

TEST(Bench, TheZeroOfTheLengthShiftsWhatIsGiven) {
  plant::Rig rig;
  rig.joint.length_offset_m = 3e-3;
  const domain::Dataset data = on_a_bench({}, 0.0);
  const Loaded held{rig, 0.0};
  const auto readings = predict(data.runs[2], {&held, 1}).front();
  EXPECT_NEAR(readings.judged()[4], plant::Braid(rig.muscle).force_N(0.12, readings.pressure_Pa[4]), 1e-6);
}

TEST(Bench, ACordThatWouldPushReadsNothing) {
  const plant::Rig nominal;
  const domain::Dataset data = on_a_bench(nominal, 0.0);
  plant::Rig rig = nominal;
  rig.joint.length_offset_m = 0.2 * nominal.muscle.rest_length_m;  // shorter than the braid can be
  const Loaded held{rig, 0.0};
  const auto readings = predict(data.runs[4], {&held, 1}).front();
  for (const double force_N : readings.judged()) EXPECT_EQ(force_N, 0.0);
}

}  // namespace
}  // namespace mckibben::diagnose
