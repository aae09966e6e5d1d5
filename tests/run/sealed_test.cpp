// Sealed muscles in runs and replays: filled until they begin, to what was read or what the rig says.
#include <cmath>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

plant::Rig sealed_and_leaking() {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::none;
  rig.valve.fill_pressure_Pa = 3e5;
  rig.valve.resolve();
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  return rig;
}

double muscle_Pa(const Sample& row) {
  return row.state.side.muscle_pressure_Pa;
}

TEST(Sealed, IsFilledUntilTheRunBegins) {
  RunPlan plan;
  plan.rig = sealed_and_leaking();
  plan.load_kg = 10.0;
  plan.ticks = 100;
  const auto controller =
      controllers::make(controllers::StepCurrent{.start_mA = 20.0, .moves = {}}, knowledge_of(plan.rig, {}));
  const Recording recording = simulate(plan, *controller);
  ASSERT_EQ(recording.failure, "");
  EXPECT_EQ(muscle_Pa(recording.samples.front()), 3e5);
  EXPECT_LT(muscle_Pa(recording.samples.back()), 2.9e5);
  EXPECT_GT(recording.samples.front().state.joint.contraction_ratio, 0.05);
  EXPECT_EQ(recording.ledger.air_drawn_kg, 0.0);
}

TEST(Sealed, BeginsAtWhatWasReadFirst) {
  domain::Measurement measured;
  for (int k = 0; k < 100; ++k) {
    measured.time_s.push_back(0.05 * k);
    measured.give("contraction").push_back(0.0);
    measured.take("muscle_pressure").push_back(2e5 - 1e3 * k);
  }
  plant::Rig rig = sealed_and_leaking();
  rig.mechanics = plant::HeldLength{};
  const Course read = course_of(measured, rig);
  ASSERT_TRUE(read.filled_Pa);
  EXPECT_NEAR(*read.filled_Pa, 2e5, 1.0);
  EXPECT_NEAR(muscle_Pa(follow(rig, 0.0, read).samples.front()), 2e5, 1.0);
  measured.take("muscle_pressure").assign(100, std::nan(""));
  EXPECT_EQ(muscle_Pa(follow(rig, 0.0, course_of(measured, rig)).samples.front()), 3e5);
}

}  // namespace
}  // namespace mckibben::run
