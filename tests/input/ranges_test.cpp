// Columns out of range: what is asked about them.
#include <vector>

#include <gtest/gtest.h>

#include <sim/data/ranges.hpp>

#include "says.hpp"

namespace mckibben::data {
namespace {

std::vector<double> even(double from, double to) {
  std::vector<double> values;
  for (int k = 0; k < 20; ++k) values.push_back(from + (to - from) * k / 19.0);
  return values;
}

plant::Rig rig_of_250_mm() {
  plant::Rig rig;
  rig.muscle.rest_length_m = 0.25;
  return rig;
}

TEST(Ranges, ASignComesBeforeAnExchangeOfColumns) {
  domain::ColumnMap map;
  map["contraction"] = {.column = "wire", .unit = "mm", .zero = 312.4};
  map["muscle_pressure"] = {.column = "p", .unit = "bar"};
  const std::vector<double> pressure_bar = even(1.0, 5.5);
  const auto asked = [&](const std::vector<double>& ratios) {
    const std::vector<ReadColumn> columns{{"contraction_ratio", &ratios},
                                          {"muscle_pressure_bar", &pressure_bar}};
    const auto found = check_ranges(columns, map, rig_of_250_mm());
    return found.empty() ? "" : found.front().message;
  };
  const std::string sign = asked(even(-0.249, -0.019));
  EXPECT_TRUE(holds(sign, "its sign is the other one", "zero: 312.4, factor: -1}"));
  EXPECT_TRUE(lacks(sign, "exchanged"));
  EXPECT_TRUE(holds(asked(even(-1.25, -1.2)), "it looks exchanged with muscle_pressure"));
  EXPECT_EQ(asked(even(0.0, 0.2)), "");
}

TEST(Ranges, ALengthWithAZeroThatStandsUnderThePressureLooksExchanged) {
  domain::ColumnMap map;
  map["contraction"] = {.column = "laser", .unit = "mm", .zero = 431.2, .factor = -1.0};
  map["muscle_pressure"] = {.column = "p", .unit = "psi"};
  const auto asked = [&](double low_mm, double high_mm) {
    std::vector<double> ratios = even(11.0, 58.0), bar = even(low_mm, high_mm);  // psi and mm, as read
    for (double& value : ratios) value = -(value - 431.2) / 250.0;
    for (double& value : bar) value *= 0.0689476;
    const std::vector<ReadColumn> columns{{"contraction_ratio", &ratios}, {"muscle_pressure_bar", &bar}};
    const auto found = check_ranges(columns, map, rig_of_250_mm());
    return found.empty() ? "" : found.front().message;
  };
  EXPECT_TRUE(holds(asked(370.0, 430.0),
                    "it looks exchanged with muscle_pressure; write columns: "
                    "{contraction: {column: p, unit: mm, zero: 431.2, factor: -1}, "
                    "muscle_pressure: {column: laser, unit: psi}}"));
  EXPECT_TRUE(lacks(asked(12.0, 60.0), "exchanged")) << "no length of this muscle";
}

TEST(Ranges, AGivenPressureThatIsAForceLooksExchangedWithIt) {
  domain::ColumnMap map;
  map["muscle_pressure"] = {.column = "F", .unit = "bar", .as = domain::Role::input};
  map["force"] = {.column = "p", .unit = "N"};
  const auto asked = [&](const std::vector<double>& bar, const std::vector<double>& N) {
    const std::vector<ReadColumn> columns{{"muscle_pressure_bar", &bar}, {"force_N", &N}};
    const auto found = check_ranges(columns, map, rig_of_250_mm());
    return found.empty() ? "" : found.front().message;
  };
  EXPECT_TRUE(holds(asked(even(20.0, 400.0), even(0.2, 5.0)), "it looks exchanged with force",
                    "{muscle_pressure: {column: p, unit: bar, as: input}, force: {column: F, unit: N}}"));
  EXPECT_TRUE(lacks(asked(even(20.0, 400.0), even(20.0, 390.0)), "exchanged")) << "no pressure of its supply";
}

TEST(Ranges, LengthsThatNoMuscleCanBeHeldAtAreToldOnce) {
  domain::ColumnMap map;
  map["contraction"] = {.column = "x", .unit = "mm", .factor = -1.0, .as = domain::Role::input};
  const auto told = [&](double ratio) {
    const std::vector<double> ratios(20, ratio);
    const std::vector<ReadColumn> columns{{"contraction_ratio", &ratios}};
    return check_ranges(columns, map, rig_of_250_mm());
  };
  const auto low = told(-0.18);
  ASSERT_EQ(low.size(), 1u);
  EXPECT_TRUE(holds(low.front().message, "contraction_ratio = -0.18 is out of range: -0.0",
                    "what this muscle can be held at", "as in 20 of 20 rows", "its sign is the other one",
                    "{contraction: {column: x, unit: mm, as: input}}"));
  EXPECT_TRUE(lacks(told(0.95).front().message, "its sign is the other one"));
  EXPECT_TRUE(told(0.1).empty());
}

TEST(Ranges, APressureSeemsToBeInTheUnitThatFitsTheSupply) {
  domain::ColumnMap map;
  const auto told = [&](const char* unit, double most_bar) {
    map["muscle_pressure"] = {.column = "p", .unit = unit};
    const std::vector<double> pressure_bar = even(0.1 * most_bar, most_bar);
    const std::vector<ReadColumn> columns{{"muscle_pressure_bar", &pressure_bar}};
    return check_ranges(columns, map, rig_of_250_mm()).front().message;
  };
  EXPECT_TRUE(holds(told("bar", 4800.0), "unit: mbar"));
  EXPECT_TRUE(holds(told("bar", 480.0), "unit: kPa"));
  EXPECT_TRUE(holds(told("bar", 4.8e5), "unit: Pa"));
  EXPECT_TRUE(holds(told("kPa", 4800.0), "unit: Pa"));
}

}  // namespace
}  // namespace mckibben::data
