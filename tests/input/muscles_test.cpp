// Muscles by catalogue: what the program has built in is the shipped file, and every number says how well it
// is known.
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

}  // namespace
}  // namespace mckibben::input
