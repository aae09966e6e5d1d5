// Whole diagnoses in which other numbers of the rig explain the gap, those of its effects too.
#include <gtest/gtest.h>

#include "diagnose/planted.hpp"
#include "named.hpp"
#include "says.hpp"

namespace mckibben::diagnose {
namespace {

// Friction that falls with speed imitates friction that is larger than a data sheet says.
TEST(Recalibrates, ANumberFarBeyondItsDataSheetBeforeItNamesAnEffect) {
  plant::Rig truth;
  truth.friction.scale = 1.46;
  const auto found = diagnosis_of(small(truth), 0);
  EXPECT_EQ(found.verdict, Verdict::recalibrate) << found.because;
  EXPECT_TRUE(found.effects.empty());
  EXPECT_NEAR(found.corrected.friction.scale, 1.46, 0.04);
  EXPECT_TRUE(holds(found.because, "Further off than the rig file says: friction.scale, by 4."));
  EXPECT_LT(found.gap.corrected_rmse, 1.3 * found.gap.noise_floor);
  for (const Ranked& one : found.ranking) EXPECT_FALSE(one.outcome.starts_with("taken")) << one.name;
}

TEST(Recalibrates, TheSizeOfAnEffectThatTheRigHasAlready) {
  plant::Rig truth, guess;
  truth.effects.get<plant::ValveDeadBand>().half_width_Pa = 7.9e3;
  guess.effects.get<plant::ValveDeadBand>().half_width_Pa = 4e3;
  auto data = small(truth);
  data.rig = guess;
  const auto found = diagnosis_of(data, 0);
  EXPECT_EQ(found.verdict, Verdict::recalibrate);
  EXPECT_TRUE(found.effects.empty());
  EXPECT_NEAR(found.corrected.effects.get<plant::ValveDeadBand>().half_width_Pa, 7.9e3, 300.0);
  EXPECT_GT(found.gap.closed, 0.95);
}

TEST(Recalibrates, AnEffectThatTheRigHasInVainToNone) {
  auto data = small(plant::Rig{});
  data.rig.effects.get<plant::GuideFriction>().coefficient = 0.1;
  const auto found = diagnosis_of(data, 0);
  EXPECT_EQ(found.verdict, Verdict::recalibrate);
  EXPECT_LT(found.corrected.effects.get<plant::GuideFriction>().coefficient, 2e-3);
  EXPECT_TRUE(holds(found.because, "effects.guide_friction.coefficient from 0.1 to"));
}

TEST(NightlyRecalibrates, TheLagOfARegulatorThatIsNotThatOfTheDataSheet) {
  plant::Rig sheet;
  sheet.valve.kind = plant::ValveKind::regulator;
  sheet.valve.time_constant_s = 0.1;
  plant::Rig truth = sheet;
  truth.valve.time_constant_s = 0.14;
  auto data = small(truth, 3.0);
  data.rig = sheet;
  const auto found = diagnosis_of(data, 0);
  EXPECT_EQ(found.verdict, Verdict::recalibrate) << found.because;
  EXPECT_TRUE(found.effects.empty()) << found.because;
  EXPECT_NEAR(found.corrected.valve.time_constant_s, 0.14, 2e-3);
  EXPECT_TRUE(holds(found.because, "valve.time_constant from 0.1 to"));
  EXPECT_GT(found.gap.closed, 0.95);
}

}  // namespace
}  // namespace mckibben::diagnose
