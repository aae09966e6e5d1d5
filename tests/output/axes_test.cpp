// Axes: scales, round numbers, and what is drawn of them.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/output/axes.hpp>

namespace mckibben::output {
namespace {

std::vector<std::string> texts(const std::vector<Tick>& ticks) {
  std::vector<std::string> found;
  found.reserve(ticks.size());
  for (const Tick& tick : ticks) found.push_back(tick.text);
  return found;
}

using Texts = std::vector<std::string>;

TEST(Axes, ScaleLeadsFromValuesToPixels) {
  Scale scale{100.0, 20.0};  // upwards
  for (const double value : {3.0, 1.0, 2.0, std::nan(""), std::numeric_limits<double>::infinity()})
    scale.hold(value);
  EXPECT_DOUBLE_EQ(scale.px(1.0), 100.0);
  EXPECT_DOUBLE_EQ(scale.px(2.0), 60.0);
  EXPECT_DOUBLE_EQ(scale.px(3.0), 20.0);
}

TEST(Axes, MarginsAreThereForWhateverIsHeld) {
  Scale nothing{0.0, 1.0}, constant{0.0, 1.0}, span{0.0, 1.0};
  nothing.widen();
  EXPECT_LT(nothing.low, 0.0);
  EXPECT_GT(nothing.high, 1.0);
  constant.hold(-2.0);
  constant.widen();
  EXPECT_DOUBLE_EQ(constant.px(-2.0), 0.5);
  EXPECT_DOUBLE_EQ(constant.high - constant.low, 0.4);
  for (const double value : {0.0, 10.0}) span.hold(value);
  span.widen(3.0);
  EXPECT_DOUBLE_EQ(span.low, -3.0);
  EXPECT_DOUBLE_EQ(span.high, 13.0);
}

TEST(Axes, NumbersAreRoundInTheUnitOfTheReader) {
  const Scale ratios{.from_px = 0.0, .to_px = 260.0, .low = -0.01, .high = 0.25};
  EXPECT_EQ(texts(round_numbers(ratios, 6)), (Texts{"0", "0.05", "0.1", "0.15", "0.2", "0.25"}));
  const auto mm = round_numbers(ratios, 6, 300.0);
  EXPECT_EQ(texts(mm), (Texts{"0", "20", "40", "60"}));
  EXPECT_DOUBLE_EQ(mm[1].px, ratios.px(20.0 / 300.0));
  const Scale around{.from_px = 0.0, .to_px = 1.0, .low = -1.0, .high = 1.0};
  EXPECT_EQ(texts(round_numbers(around, 4)), (Texts{"-1", "-0.5", "0", "0.5", "1"}));
}

TEST(Axes, WithAFloorNumbersArePowersOfTen) {
  Scale errors{.from_px = 0.0, .to_px = 100.0, .floor = 1e-4};
  for (const double value : {-0.002, 0.02}) errors.hold(value);
  EXPECT_EQ(texts(round_numbers(errors, 5)), (Texts{"0", "-0.001", "0.001", "0.01"}));
  EXPECT_NEAR(errors.px(1e-4) - errors.px(0.0), errors.px(0.0) - errors.px(-1e-4), 1e-9);
  EXPECT_NEAR(errors.px(1e-2) - errors.px(5e-3), errors.px(2e-2) - errors.px(1e-2), 0.1) << "logarithmic";
}

TEST(Axes, DecadesHaveNumbersAtTheirPowers) {
  std::vector<double> values, powers;
  for (const auto& [value, is_power] : decades(0.03, 2.5)) {
    values.push_back(value);
    if (is_power) powers.push_back(value);
  }
  ASSERT_EQ(values.size(), 5u);
  EXPECT_NEAR(values[0], 0.1, 1e-12);
  EXPECT_NEAR(values[2], 0.5, 1e-12);
  EXPECT_NEAR(values[4], 2.0, 1e-12);
  EXPECT_EQ(powers.size(), 2u);
}

TEST(Axes, PanelsAreDrawnWithGridNumbersAndWords) {
  Panel panel{.x = {.from_px = 50.0, .to_px = 250.0, .low = 0.0, .high = 2.0},
              .y = {.from_px = 120.0, .to_px = 20.0, .low = 0.0, .high = 1.0}};
  const std::vector<Tick> half{{panel.x.px(1.0), "1"}};
  EXPECT_EQ(panel.across(half, "a < b"),
            "<path class='grid' stroke='#ddd' d='M150.0 20.0V120.0'/>\n"
            "<text x='150.0' y='136.0' text-anchor='middle'>1</text>\n"
            "<text x='150.0' y='156.0' text-anchor='middle'>a &lt; b</text>\n");
  EXPECT_EQ(panel.upwards({{panel.y.px(0.5), "0.5"}}, ""),
            "<path class='grid' stroke='#ddd' d='M50.0 70.0H250.0'/>\n"
            "<text x='44.0' y='74.0' text-anchor='end'>0.5</text>\n");
  panel.with_grid = false;
  EXPECT_EQ(panel.across(half, ""), "<text x='150.0' y='136.0' text-anchor='middle'>1</text>\n");
  EXPECT_EQ(
      panel.frame(),
      "<rect class='axis' x='50.0' y='20.0' width='200.0' height='100.0' fill='none' stroke='#888'/>\n");
}

}  // namespace
}  // namespace mckibben::output
