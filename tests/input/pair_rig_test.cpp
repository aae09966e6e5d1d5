// Rigs of two muscles in files: what the second side takes from the first, along bases too; files of old are
// written as they were.
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

TEST(PairRig, OneMuscleIsWrittenAsEver) {
  EXPECT_FALSE(rig_json(Rig{}).contains("mechanics"));
  EXPECT_EQ(rig_json(rig_of("mechanics: {kind: hanging_load}")), rig_json(Rig{}));
}

TEST(PairRig, ShippedByNameAndAsAFile) {
  std::vector<InputFile> inputs;
  const Json shipped = rig_json(read_rig("thesis_pair", inputs));
  EXPECT_EQ(shipped.at("mechanics").at("kind"), "pair");
  EXPECT_EQ(rig_json(read_rig(MCKIBBEN_SOURCE_DIR "/scenarios/rigs/thesis_pair.yaml", inputs)), shipped);
  EXPECT_EQ(rig_json(rig_of("base: thesis\nmechanics: {kind: pair}")), shipped);
}

TEST(PairRig, WhatIsSaidOfMuscleOneHoldsForBothUntilTheOppositeDiffers) {
  const Rig rig = rig_of(
      "base: thesis_pair\nmuscle: {rest_radius: 8 mm}\nhose: {conductance: 1e-8 m3/(s.Pa)}\n"
      "mechanics: {kind: pair, contraction_1: 0.08, opposite: {muscle: {rest_length: 280 mm}}}");
  const plant::OppositeSide& two = rig.pair()->opposite;
  EXPECT_EQ(rig.pair()->contraction_ratio, 0.08);
  EXPECT_EQ(rig.pair()->mass_kg, 2.0);  // as the base has it
  EXPECT_EQ(two.muscle.rest_radius_m, 0.008);
  EXPECT_EQ(two.muscle.rest_length_m, 0.28);
  EXPECT_EQ(rig.muscle.rest_length_m, 0.3);
  EXPECT_EQ(two.hose.conductance_m3_per_s_Pa, 1e-8);
  EXPECT_EQ(to_json(rig_of(to_json(rig).dump())), to_json(rig));
}

TEST(PairRig, AnEffectOfOneMuscleIsWrittenAsOneOfThatMuscle) {
  const std::string leak = "effects: {muscle_leak: {conductance: 1e-10 m3/(s.Pa)}}";
  const Rig of_one =
      rig_of("base: thesis_pair\n" + leak +
             "\nmechanics: {kind: pair, opposite: {effects: {muscle_leak: {conductance: 0 m3/(s.Pa)}}}}");
  const Rig of_two = rig_of("base: thesis_pair\nmechanics: {kind: pair, opposite: {" + leak + "}}");
  for (const Rig& rig : {of_one, of_two}) {
    const Rig again = rig_of(to_json(rig).dump());
    const auto leaks = [](const plant::Effects& effects) {
      return effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa;
    };
    EXPECT_EQ(leaks(again.effects), leaks(rig.effects));
    EXPECT_EQ(leaks(again.pair()->opposite.effects), leaks(rig.pair()->opposite.effects));
    EXPECT_EQ(leaks(again.effects) + leaks(again.pair()->opposite.effects), 1e-10);
  }
}

TEST(PairRig, AMistakeOfMuscleOneIsToldOnce) {
  try {
    rig_of("base: thesis_pair\nmuscle: {rest_radius: 8 kg}");
    FAIL();
  } catch (const BadInput& bad) {
    EXPECT_EQ(bad.problems().size(), 1u) << bad.what();
  }
}

Scenario scenario_of(const std::string& text) {
  std::vector<Problem> warnings;
  return read_scenario(Source("test.yaml", text, ""), warnings);
}

TEST(PairScenario, IsCompleteAndReadsBackAsAScenario) {
  std::vector<Problem> warnings;
  const Scenario scenario = read_scenario(MCKIBBEN_SOURCE_DIR "/scenarios/pair.yaml", warnings);
  EXPECT_EQ(scenario.name, "pair");
  ASSERT_EQ(scenario.currents.size(), 2u);
  EXPECT_NE(scenario.rig.pair(), nullptr);
  const Json written = scenario_json(scenario);
  EXPECT_EQ(written.at("schema"), scenario_schema);
  EXPECT_EQ(scenario_json(scenario_of(written.dump())).dump(), written.dump());
}

TEST(PairScenario, IsWhatTheRigMakesItAndTheOlderSchemaMeansTwoMuscles) {
  const std::string rest =
      "duration: 1 s\nhand: {loads: [0.5 kg]}\nnoise: {encoder_jitter: 1e-4}\nseed: 3\n"
      "targets: [{angle: {kind: sine, mean: 0 deg, amplitude: 10 deg, period: 1 s}}]\n"
      "criteria: [{rmse_below: 180 deg}]\n"
      "controllers: [{kind: pid, proportional: 30 mA/rad}, {kind: model_inverse}]\n";
  const Scenario now = scenario_of("schema: mckibben-scenario/1\nrig: thesis_pair\n" + rest);
  const Scenario older = scenario_of("schema: mckibben-pair/1\n" + rest);
  EXPECT_EQ(scenario_json(now).dump(), scenario_json(older).dump());
  EXPECT_EQ(now.loads_kg, std::vector<double>{0.5});
  EXPECT_EQ(now.seed, 3U);
  EXPECT_NEAR(*now.criteria.front().rmse_below, 3.14159265, 1e-7);
  EXPECT_TRUE(std::holds_alternative<controllers::PairPidSettings>(now.controllers.front()));
  EXPECT_EQ(scenario_json(now).at("controllers")[0].at("proportional"), "30 mA/rad");
}

}  // namespace
}  // namespace mckibben::input
