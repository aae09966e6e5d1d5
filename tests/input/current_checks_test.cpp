// Currents of controllers against the rig's valve.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>
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

const std::string to_10_mA = "{valve: {zero_command: 0 mA, span_command: 10 mA}}";

TEST(CurrentChecks, OpenCurrentsFollowTheValveAndStandInTheResolvedScenario) {
  std::vector<Problem> warnings;
  const Scenario scenario = read(to_10_mA, "{kind: pid}", warnings);
  EXPECT_TRUE(warnings.empty());
  const Json pid = scenario_json(scenario).at("controllers")[0];
  EXPECT_EQ(pid.at("lowest_command"), "0 mA");
  EXPECT_EQ(pid.at("highest_command"), "10 mA");
  EXPECT_EQ(pid.at("rest_command"), "0 mA");
}

TEST(CurrentChecks, ALoopOnTwoOnOffValvesRestsWithBothShut) {
  std::vector<Problem> warnings;
  const auto rest = [&](const std::string& ports) {
    const std::string rig =
        "{valve: {kind: on_off, ports: " + ports + ", zero_command: -5 V, span_command: 10 V}}";
    return scenario_json(read(rig, "{kind: pid}", warnings)).at("controllers")[0].at("rest_command");
  };
  EXPECT_EQ(rest("2/2"), "2.5 V");
  EXPECT_EQ(rest("3/2"), "-5 V") << "one valve for both is never shut";
}

TEST(CurrentChecks, LimitsBeyondTheValvesAreWarnedOfWithTheirLine) {
  std::vector<Problem> warnings;
  read(to_10_mA, "{kind: pid, highest_command: 20 mA}", warnings);
  read("{valve: {zero_command: 1 mA}}", "{kind: pid, lowest_command: 0 mA}", warnings);
  read("{dac: {largest_command: 18 mA}}", "{kind: pid, highest_command: 20 mA}", warnings);
  ASSERT_EQ(warnings.size(), 4u);
  EXPECT_EQ(warnings[0].message,
            "highest_command = 20 mA is above the valve's span_command, 10 mA: "
            "from there on the pressure does not change");
  EXPECT_EQ(warnings[0].place.line, 7u);
  EXPECT_EQ(warnings[1].message,
            "lowest_command = 0 mA is below the valve's zero_command, 1 mA: "
            "from there on the pressure does not change");
  EXPECT_TRUE(says(warnings[2].message, "dac.largest_command = 18 mA is below the valve's span_command"));
  EXPECT_TRUE(says(warnings[3].message, "is above the DAC's largest_command, 18 mA"));
}

TEST(CurrentChecks, CommandsBeyondTheValvesAreWarnedOfWithTheirLine) {
  std::vector<Problem> warnings;
  read(to_10_mA, "{kind: stair_current, low: 3 mA, high: 12 mA, steps: 3, dwell: 1 s}", warnings);
  read(to_10_mA, "{kind: step_current, moves: [{at: 1 s, to: 5 mA}, {at: 2 s, to: 11 mA}]}", warnings);
  read("thesis", "{kind: sine_current, low: 0 mA, high: 20 mA, period: 2 s}", warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(
      warnings[0].message,
      "high = 12 mA is above the valve's span_command, 10 mA: from there on the pressure does not change");
  EXPECT_EQ(
      warnings[1].message,
      "to = 11 mA is above the valve's span_command, 10 mA: from there on the pressure does not change");
  EXPECT_EQ(warnings[1].place.line, 7u);
}

TEST(CurrentChecks, LimitsWithoutACurrentOfTheValveBetweenThemAreErrors) {
  EXPECT_TRUE(says(refused(to_10_mA, "{kind: pid, lowest_command: 12 mA}"),
                   "valve.yaml:7:33: error: lowest_command = 12 mA: from 12 mA to 10 mA no command moves the "
                   "rig's valve, which works from 0 mA to 10 mA"));
  EXPECT_TRUE(
      says(refused("thesis", "{kind: pid, highest_command: 3 mA}"), "error: highest_command = 3 mA: "));
  EXPECT_TRUE(
      says(refused("thesis", "{kind: pid, rest_command: 3 mA}"),
           "rest_command = 3 mA: must lie between lowest_command and highest_command, 4 mA and 20 mA"));
  EXPECT_TRUE(says(refused("{dac: {largest_command: 3 mA}}", "{kind: pid}"), "cannot move the valve"));
}

}  // namespace
}  // namespace mckibben::input
