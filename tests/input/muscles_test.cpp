// Muscles by catalogue: what the program has built in is the shipped file, and every number says how well it
// is known. What their threads bear where no file says it.
#include <cmath>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

TEST(Muscles, AreTheShippedFiles) {
  std::vector<InputFile> inputs;
  for (const std::string name : {"festo_dmsp_10", "festo_dmsp_20", "home_made"}) {
    const Rig built_in = read_rig(name, inputs);
    EXPECT_TRUE(inputs.empty()) << name;
    const Rig file = read_rig(MCKIBBEN_SOURCE_DIR "/scenarios/rigs/" + name + ".yaml", inputs);
    inputs.clear();
    EXPECT_EQ(rig_json(built_in), rig_json(file)) << name;
    EXPECT_EQ(built_in.spreads, file.spreads) << name;
    for (const char* key : {"rest_length", "rest_radius", "braid_angle", "end_correction", "dead_volume"})
      EXPECT_TRUE(built_in.spreads.contains(std::string("muscle.") + key)) << name << ' ' << key;
  }
}

TEST(Muscles, MayBeChangedLikeAnyBase) {
  const Rig rig = rig_of("base: festo_dmsp_20\nmuscle: {rest_length: 200 mm ± 1 mm}");
  EXPECT_DOUBLE_EQ(rig.muscle.rest_length_m, 0.2);
  EXPECT_DOUBLE_EQ(rig.spreads.at("muscle.rest_length"), 1e-3);
  EXPECT_DOUBLE_EQ(rig.muscle.rest_radius_m, 10.6e-3);
  EXPECT_TRUE(std::isinf(rig.spreads.at("effects.bladder_elasticity.force")));
}

// What Festo rates them at: 1.5 kN and 630 N at most, and a quarter of the length.
TEST(Muscles, PullAboutAsTheyAreRated) {
  for (const auto& [name, rated_N, pressure_Pa] :
       {std::tuple{"festo_dmsp_20", 1500.0, 6e5}, std::tuple{"festo_dmsp_10", 630.0, 8e5}}) {
    const Rig rig = rig_of(std::string("base: ") + name);
    const plant::Braid braid(rig.muscle);
    EXPECT_NEAR(braid.force_N(0.0, pressure_Pa), rated_N, 0.16 * rated_N) << name;
    const double pulled_back_N = rig.effects.get<plant::BladderElasticity>().force_N;
    EXPECT_GT(braid.force_N(0.22, pressure_Pa), pulled_back_N) << name;
    EXPECT_LT(braid.force_N(0.26, pressure_Pa), pulled_back_N) << name;
  }
}

// A stop that no file writes bears all that the muscle lifts, wherever its size is written; one that a file
// writes stays.
TEST(Muscles, BearWhatTheyLift) {
  const auto bears = [](const Rig& rig) {
    const plant::Braid braid(rig.muscle);
    return braid.largest_load_kg() * plant::gravity_m_per_s2 >=
           braid.largest_force_N(rig.valve.span_pressure_Pa);
  };
  for (const char* text :
       {"muscle: {rest_radius: 10.8 mm}", "base: thesis\nmuscle: {rest_radius: 20 mm, count: 3}",
        "base: festo_dmsp_20\nvalve: {span_pressure: 8 bar, supply_pressure: 8 bar}",
        "muscle: {rest_length: 60 mm}", "valve: {span_pressure: 6 bar}", "muscle: {braid_angle: 12 deg}"})
    EXPECT_TRUE(bears(rig_of(text))) << text;
  EXPECT_GT(rig_of("muscle: {rest_radius: 10.8 mm}").muscle.stop_stiffness_N_per_m, 3e5);
  EXPECT_EQ(rig_of("muscle: {rest_radius: 6 mm}").muscle.stop_stiffness_N_per_m, 3e5);
  for (const char* name : {"thesis", "thesis_pair"})
    EXPECT_EQ(rig_of(std::string("base: ") + name).muscle.stop_stiffness_N_per_m, 3e5) << name;
  EXPECT_EQ(rig_of("muscle: {rest_radius: 10.8 mm, stop_stiffness: 3e5 N/m}").muscle.stop_stiffness_N_per_m,
            3e5);
  const Rig pair =
      rig_of("base: thesis_pair\nmechanics: {kind: pair, opposite: {muscle: {rest_radius: 12 mm}}}");
  EXPECT_EQ(pair.muscle.stop_stiffness_N_per_m, 3e5);
  EXPECT_TRUE(bears(opposite_rig(pair)));
}

}  // namespace
}  // namespace mckibben::input
