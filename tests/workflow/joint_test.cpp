// Whole diagnoses of a joint with two muscles.
#include "diagnose/joint.hpp"

#include <gtest/gtest.h>

#include "diagnose/planted.hpp"
#include "named.hpp"
#include "says.hpp"

namespace mckibben::diagnose {
namespace {

const Moved* moved(const Diagnosis& found, const std::string& path) {
  for (const Moved& one : found.recalibrated)
    if (one.fitted.name == path) return &one;
  return nullptr;
}

TEST(JointDiagnosis, NamesWhatDampsBothMusclesFromPressuresAndAnAngle) {
  const Diagnosis found =
      diagnosis_of(of_a_joint(pair_with(plant::ViscousDamping{.damping_N_s_per_m = 400.0})), 2);
  ASSERT_TRUE(names_only(found, "viscous_damping"));
  const FittedNumber& damping = found.effects[0].parameters.at(0);
  EXPECT_TRUE(surrounds(damping, 400.0));
  EXPECT_EQ(found.gap.judged, Judged::angle);
  EXPECT_LT(found.gap.corrected_rmse, 1.2 * found.gap.noise_floor);
  EXPECT_TRUE(holds(found.because, "the joint's angle falls from", " deg"));
  EXPECT_EQ(found.corrected.pair()->opposite.effects.get<plant::ViscousDamping>().damping_N_s_per_m,
            damping.value);
}

TEST(NightlyJointDiagnosis, NamesTheLeakOfBothMusclesUnderCommands) {
  const Diagnosis found =
      diagnosis_of(of_a_joint(pair_with(plant::MuscleLeak{.conductance_m3_per_s_Pa = 3e-10}), true), 2);
  ASSERT_TRUE(names_only(found, "muscle_leak"));
  EXPECT_TRUE(surrounds(found.effects[0].parameters.at(0), 3e-10));
}

/// A leak of muscle 2, or in the mirror of muscle 1, is named as that muscle's; its size.
FittedNumber leak_of_one_muscle(bool mirror) {
  const domain::Dataset data = of_a_joint(
      pair_with(plant::MuscleLeak{.conductance_m3_per_s_Pa = 3e-10}, Side::two), true, {.angle_rad = 3e-4});
  const Diagnosis found = diagnosis_of(mirror ? mirrored(data) : data, 2);
  EXPECT_EQ(found.verdict, Verdict::missing_effect) << found.because;
  EXPECT_EQ(found.effects.size(), 1u) << found.because;
  if (found.effects.size() != 1u) return {};
  EXPECT_EQ(found.effects[0].who(), EffectName("muscle_leak", mirror ? Side::one : Side::two))
      << found.because;
  EXPECT_TRUE(holds(found.because, mirror ? "muscle_leak of muscle 1" : "muscle_leak of muscle 2"));
  const FittedNumber& leak = found.effects[0].parameters.at(0);
  EXPECT_TRUE(surrounds(leak, 3e-10));
  const auto of = [&](const plant::Effects& effects) {
    return effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa;
  };
  EXPECT_EQ(of(found.corrected.effects), mirror ? leak.value : 0.0);
  EXPECT_EQ(of(found.corrected.pair()->opposite.effects), mirror ? 0.0 : leak.value);
  return leak;
}

TEST(JointDiagnosis, NamesTheMuscleThatLeaks) {
  leak_of_one_muscle(false);
}
TEST(NightlyJointDiagnosis, NamesTheOtherMuscleInTheMirrorWithTheSameSize) {
  const FittedNumber size = leak_of_one_muscle(false);
  EXPECT_NEAR(leak_of_one_muscle(true).value, size.value, 0.25 * (size.high - size.low));
}

TEST(NightlyJointDiagnosis, ATubeThatPushesIsNeverTheAnswer) {
  const Diagnosis found =
      diagnosis_of(of_a_joint(pair_with(plant::BladderElasticity{.stiffness_N_per_m = -800.0})), 2);
  for (const auto* effects : {&found.effects, &found.stand_ins})
    for (const NamedEffect& effect : *effects)
      EXPECT_NE(effect.name, plant::BladderElasticity::name) << found.because;
  EXPECT_FALSE(carries(found.corrected, plant::BladderElasticity::name)) << found.because;
}

TEST(NightlyJointDiagnosis, RecalibratesFrictionOfBothMuscles) {
  Rig truth = plant::thesis_pair();
  truth.friction.scale = std::get<plant::Pair>(truth.mechanics).opposite.friction.scale = 1.25;
  const Diagnosis found = diagnosis_of(of_a_joint(truth), 2);
  EXPECT_EQ(found.verdict, Verdict::recalibrate) << found.because;
  ASSERT_NE(moved(found, "friction.scale"), nullptr);
  EXPECT_NEAR(moved(found, "friction.scale")->fitted.value, 1.25, 0.05);
  // Each muscle may have a number of its own.
  EXPECT_NEAR(found.corrected.pair()->opposite.friction.scale, 1.25, 0.05);
}

TEST(JointDiagnosis, NamesNothingWhereNothingIsMissing) {
  const Diagnosis found = diagnosis_of(of_a_joint(plant::thesis_pair()), 2);
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << found.because;
  EXPECT_FALSE(found.next_experiment);
}

// A small dead band in noise, and the next best explanation as if it did as well.
TEST(NightlyJointDiagnosis, PlansTheCommandsOfBothMusclesThatTellExplanationsApart) {
  domain::Dataset data =
      of_a_joint(pair_with(plant::ValveDeadBand{.half_width_Pa = 1.5e3}), true, {.angle_rad = 3e-3});
  data.runs.resize(3);
  const identify::Settings settings{.threads = 2};
  identify::Identified found = identify::identify(data, settings);
  const identify::Scored chosen = found.table[found.decision.chosen];
  identify::Scored* rival = nullptr;
  for (identify::Scored& one : found.table)
    if (!one.general && !one.names.empty() && one.names != chosen.names &&
        (rival == nullptr || one.score > rival->score))
      rival = &one;
  ASSERT_NE(rival, nullptr);
  rival->score = chosen.score;
  rival->held_out = chosen.held_out;
  const auto next = identify::diagnosis_of(found, settings, {.seed = 3}).next_experiment;
  ASSERT_TRUE(next);
  EXPECT_GT(next->expected_power, 0.5);
  EXPECT_EQ(next->separates.size(), 2u);
  EXPECT_TRUE(next->measurement.current_1 && next->measurement.current_2);
  EXPECT_TRUE(holds(next->current, "muscle 1: ", "; muscle 2: "));
}

}  // namespace
}  // namespace mckibben::diagnose
