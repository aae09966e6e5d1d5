// A valve that takes volts does what the same valve does under the currents that stand for them.
#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

/// The thesis's rig with a valve that takes 0 to 10 V, and a DAC with the same steps.
plant::Rig in_volts(plant::Rig rig) {
  plant::command_in(rig, plant::CommandUnit::V, 0.0, 10.0);
  rig.dac = {.lowest_command = -2.5, .largest_command = 10.0};
  return rig;
}

Recording driven(const plant::Rig& rig, const controllers::Settings& settings) {
  RunPlan plan;
  plan.rig = rig;
  plan.load_kg = 14.0;
  plan.ticks = 400;
  const std::vector<double> target(plan.ticks, 0.08);
  controllers::Settings followed = settings;
  controllers::follow(followed, controllers::working_range(knowledge_of(rig, {})));
  const auto controller = controllers::make(followed, knowledge_of(rig, target));
  return simulate(plan, *controller);
}

void expect_same(const Recording& current, const Recording& voltage) {
  ASSERT_EQ(current.samples.size(), voltage.samples.size());
  for (std::size_t k = 0; k < current.samples.size(); ++k) {
    const Sample &one = current.samples[k], &other = voltage.samples[k];
    EXPECT_NEAR(other.current_mA, (one.current_mA - 4.0) / 1.6, 1e-12) << k;
    EXPECT_NEAR(other.state.joint.contraction_ratio, one.state.joint.contraction_ratio, 1e-10) << k;
    EXPECT_NEAR(other.state.side.muscle_pressure_Pa, one.state.side.muscle_pressure_Pa, 1e-3) << k;
    EXPECT_EQ(other.counts, one.counts) << k;
  }
}

TEST(CommandsInVolts, DoWhatTheirCurrentsDo) {
  plant::Rig rig;
  rig.friction.f1_s2_per_mA2 = 0.004;  // the faster the current, the more friction
  const controllers::SineCurrent current{.low_mA = 4.0, .high_mA = 15.2, .period_s = 2.0},
      voltage{.low_mA = 0.0, .high_mA = 7.0, .period_s = 2.0};
  expect_same(driven(rig, current), driven(in_volts(rig), voltage));
}

TEST(CommandsInVolts, OfAControllerDoWhatItsCurrentsDo) {
  controllers::PidSettings current;
  current.proportional_mA = 80.0;
  current.integral_time_s = 0.2;
  current.derivative_time_s = 0.05;
  controllers::PidSettings voltage = current;
  voltage.proportional_mA = 50.0;
  const Recording volts = driven(in_volts({}), voltage);
  expect_same(driven({}, current), volts);
  EXPECT_GT(volts.samples.back().state.joint.contraction_ratio, 0.07);
}

}  // namespace
}  // namespace mckibben::run
