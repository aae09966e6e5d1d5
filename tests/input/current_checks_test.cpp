// Currents of controllers against the rig's valve.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/scenario_file.hpp>

namespace mckibben::input {
namespace {

Scenario read(const std::string& rig, const std::string& controller, std::vector<Problem>& warnings) {
  return read_scenario(Source("valve.yaml",
                              "schema: mckibben-scenario/1\nrig: " + rig +
                                  "\nloads: [11.138 kg]\nduration: 2 s\ntarget: {kind: steps, moves: []}\n"
                                  "controllers:\n  - " +
                                  controller + "\n",
                              ""),
                       warnings);
}

std::string refused(const std::string& rig, const std::string& controller) {
  std::vector<Problem> warnings;
  try {
    read(rig, controller, warnings);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "nothing";
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

const std::string to_10_mA = "{valve: {zero_current: 0 mA, span_current: 10 mA}}";

TEST(CurrentChecks, OpenCurrentsFollowTheValveAndStandInTheResolvedScenario) {
  std::vector<Problem> warnings;
  const Scenario scenario = read(to_10_mA, "{kind: pid}", warnings);
  EXPECT_TRUE(warnings.empty());
  const Json pid = scenario_json(scenario).at("controllers")[0];
  EXPECT_EQ(pid.at("lowest_current"), "0 mA");
  EXPECT_EQ(pid.at("highest_current"), "10 mA");
  EXPECT_EQ(pid.at("rest_current"), "0 mA");
}

TEST(CurrentChecks, LimitsBeyondTheValvesAreWarnedOfWithTheirLine) {
  std::vector<Problem> warnings;
  read(to_10_mA, "{kind: pid, highest_current: 20 mA}", warnings);
  read("{valve: {zero_current: 1 mA}}", "{kind: pid, lowest_current: 0 mA}", warnings);
  read("{dac: {largest_current: 18 mA}}", "{kind: pid, highest_current: 20 mA}", warnings);
  ASSERT_EQ(warnings.size(), 4u);
  EXPECT_EQ(
      warnings[0].message,
      "highest_current = 20 mA is above the valve's span_current, 10 mA: from there on the pressure does "
      "not change");
  EXPECT_EQ(warnings[0].place.line, 7u);
  EXPECT_EQ(warnings[1].message,
            "lowest_current = 0 mA is below the valve's zero_current, 1 mA: from there on the pressure does "
            "not change");
  EXPECT_TRUE(says(warnings[2].message, "dac.largest_current = 18 mA is below the valve's span_current"));
  EXPECT_TRUE(says(warnings[3].message, "is above the DAC's largest_current, 18 mA"));
}

TEST(CurrentChecks, LimitsWithoutACurrentOfTheValveBetweenThemAreErrors) {
  EXPECT_TRUE(says(refused(to_10_mA, "{kind: pid, lowest_current: 12 mA}"),
                   "valve.yaml:7:33: error: lowest_current = 12 mA: from 12 mA to 10 mA no current moves the "
                   "rig's valve, which works from 0 mA to 10 mA"));
  EXPECT_TRUE(
      says(refused("thesis", "{kind: pid, highest_current: 3 mA}"), "error: highest_current = 3 mA: "));
  EXPECT_TRUE(
      says(refused("thesis", "{kind: pid, rest_current: 3 mA}"),
           "rest_current = 3 mA: must lie between lowest_current and highest_current, 4 mA and 20 mA"));
  EXPECT_TRUE(says(refused("{dac: {largest_current: 3 mA}}", "{kind: pid}"), "cannot move the valve"));
}

}  // namespace
}  // namespace mckibben::input
