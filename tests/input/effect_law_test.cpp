// Effects of several laws in rig files: keys of a law that is not chosen. Where the law itself is missing:
// tests/bad.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/rigs.hpp>

namespace mckibben::input {
namespace {

std::string warning_of(const std::string& effects) {
  std::vector<InputFile> inputs;
  std::vector<Problem> warnings;
  read_rig(Source("rig.yaml", "schema: mckibben-rig/1\nbase: thesis\neffects: " + effects, ""), inputs,
           &warnings);
  return warnings.empty() ? "" : warnings.front().message;
}

TEST(EffectLaw, KeysOfOtherLawsDoNothingAndSaySo) {
  EXPECT_EQ(
      warning_of("{bladder_elasticity: {stiffness: 500 N/m, force: 15 N, ratio: 0.05}}"),
      "force = 15 N does nothing: it is of variant saturating or saturating_linear, and this is linear");
  EXPECT_EQ(warning_of("{bladder_elasticity: {variant: saturating, stiffness: 500 N/m, force: 15 N}}"),
            "stiffness = 500 N/m does nothing: it is of variant linear or saturating_linear, and this is "
            "saturating");
}

TEST(EffectLaw, ThoseOfItsOwnAndAbsentOnesAreNotWarnedOf) {
  EXPECT_EQ(warning_of("{bladder_elasticity: {variant: saturating_linear, stiffness: 500 N/m, force: 15 N}}"),
            "");
  EXPECT_EQ(warning_of("{bladder_elasticity: {stiffness: 500 N/m, force: 0 N, ratio: 0.05}}"), "");
}

}  // namespace
}  // namespace mckibben::input
