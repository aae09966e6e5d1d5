// Pictures of effects: those of the documentation are what the program draws.
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/output/effect_pictures.hpp>

namespace mckibben::output {
namespace {

std::string checked_in(const std::string& effect) {
  std::ifstream file(MCKIBBEN_SOURCE_DIR "/docs/effects/" + effect + ".svg", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// How often a line of one ink is drawn: once in the legend, and once for each ride.
int lines(const std::string& svg, const std::string& ink) {
  int count = 0;
  for (auto at = svg.find("class='" + ink); at != std::string::npos; at = svg.find("class='" + ink, at + 1))
    ++count;
  return count;
}

TEST(EffectPictures, EachHasItsLoopsBesideTheNominalOne) {
  const std::string svg = effect_svg("bladder_elasticity");
  EXPECT_EQ(lines(svg, "nominal"), 3);
  EXPECT_EQ(lines(svg, "first"), 3);
  EXPECT_EQ(lines(svg, "second"), 3);
  EXPECT_EQ(lines(svg, "third"), 3);
  EXPECT_NE(svg.find("saturating: force 40 N, ratio 0.04"), std::string::npos);
  EXPECT_NE(svg.find("exaggerated, 4 \u00d7 typical"), std::string::npos);
  EXPECT_NE(svg.find("nominal rig, 16.138 kg"), std::string::npos);
  EXPECT_THROW(effect_svg("residual_law"), std::invalid_argument);
}

TEST(EffectPictures, ThoseOfTheDocumentationAreDrawnNow) {
  std::set<std::string> effects;
  for (const auto& law : diagnose::catalogue()) effects.insert(law.effect);
  EXPECT_GE(effects.size(), 15u);
  for (const std::string& effect : effects)
    EXPECT_TRUE(effect_svg(effect) == checked_in(effect))
        << "draw docs/effects/" << effect << ".svg again: mckibben effects --out DIR";
}

}  // namespace
}  // namespace mckibben::output
