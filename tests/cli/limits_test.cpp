// A bench whose valve works from 0 to 10 mA: a controller that follows it is good, one that is kept at 4 mA
// stands there for the whole run, and every place says so.
#include <string>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

using input::Json;

std::string scenario(const std::string& controllers) {
  return "schema: mckibben-scenario/1\n"
         "rig:\n"
         "  valve: {zero_command: 0 mA, span_command: 10 mA, zero_pressure: 0 bar}\n"
         "  dac: {largest_command: 10 mA}\n"
         "loads: [8 kg]\n"
         "duration: 2.5 s\n"
         "target: {kind: minimum_jerk, start: 0.03, moves: [{at: 0.5 s, lasting: 1.5 s, to: 0.06}]}\n"
         "controllers:\n" +
         controllers;
}

TEST(Limits, FollowTheValve) {
  const Scratch scratch;
  write_text(scratch / "own.yaml", scenario("  - {kind: pid}\n"));
  const Said said = mckibben("run own.yaml --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  EXPECT_EQ(document.at("scenario").at("controllers")[0].at("lowest_command"), "0 mA");
  const Json& run = document.at("runs")[0];
  EXPECT_LT(run.at("rmse").get<double>(), 0.01);
  EXPECT_LT(run.at("at_lowest_current").get<double>() + run.at("at_highest_current").get<double>(), 0.5);
  EXPECT_FALSE(document.at("tuned")[0].at("gained_nothing").get<bool>());
  EXPECT_TRUE(document.at("warnings").empty()) << document.at("warnings");
}

// 8.87 kg is outside the calibration, so the mean over both loads is, too.
TEST(Report, TheMeanIsMarkedWhereOneOfItsRunsIsExtrapolated) {
  const Scratch scratch;
  write_text(scratch / "own.yaml",
             "schema: mckibben-scenario/1\nloads: [11.138 kg, 8.87 kg]\nduration: 1 s\n"
             "target: {kind: minimum_jerk, start: 0.02, moves: [{at: 0.1 s, lasting: 0.8 s, to: 0.1}]}\n"
             "controllers: [{kind: feedforward_pid, calibration: thesis, extrapolate_load: true, "
             "proportional: 40 mA, integral_time: 0.15 s, derivative_time: 0.08 s}]\n");
  ASSERT_EQ(mckibben("run own.yaml", scratch).status, 0);
  const std::string page = read_text(scratch / "out/own/report.html");
  const std::size_t mean = page.find("<tr class='mean'>");
  ASSERT_NE(mean, std::string::npos);
  EXPECT_TRUE(holds(page.substr(mean, page.find("</tr>", mean) - mean), "*</td>"));
}

TEST(Report, AGivenCurrentHasNoErrorForAHeadline) {
  const Scratch scratch;
  const std::string triangle = "  - {kind: triangle_current, low: 0 mA, high: 8 mA, period: 2 s}\n";
  write_text(scratch / "own.yaml", scenario(triangle));
  ASSERT_EQ(mckibben("run own.yaml", scratch).status, 0);
  const std::string page = read_text(scratch / "out/own/report.html");
  EXPECT_TRUE(holds(page, "triangle_current follows no target: it moves 8 kg by "));
  EXPECT_TRUE(lacks(page, "triangle_current: root mean square error"));
}

TEST(Report, WithoutATargetTravelsStandWhereErrorsDo) {
  const Scratch scratch;
  write_text(scratch / "given.yaml",
             "schema: mckibben-scenario/1\nloads: [11.138 kg, 16.138 kg]\nduration: 8 s\n"
             "controllers: [{kind: sine_current, low: 6 mA, high: 12 mA, period: 2 s}]\n");
  const Said said = mckibben("run given.yaml", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "commands are given, and there is no target", "travel_mm"));
  EXPECT_TRUE(lacks(said.out, "rmse"));
  EXPECT_TRUE(lacks(said.err, "oscillates"));
  const std::string page = read_text(scratch / "out/given/report.html");
  EXPECT_TRUE(holds(page, "sine_current follows no target: it moves 11.138 kg by "));
  EXPECT_TRUE(lacks(page, "Root mean square error", "contraction less target"));
}

TEST(Limits, OfARigInVoltsAreInVoltsAndSoIsAllThatIsWritten) {
  const Scratch scratch;
  const std::string rig =
      "rig: {valve: {zero_command: 0 V, span_command: 10 V, zero_pressure: 0 bar, span_pressure: 5 bar}}\n";
  const std::string rest =
      "loads: [8 kg]\nduration: 2.5 s\n"
      "target: {kind: minimum_jerk, start: 0.03, moves: [{at: 0.5 s, lasting: 1.5 s, to: 0.06}]}\n"
      "controllers: [{kind: pid, lowest_current: 500 mV, highest_command: 9 V, largest_command_speed: 40 "
      "V/s}]\n";
  write_text(scratch / "volts.yaml", "schema: mckibben-scenario/1\n" + rig + rest);
  const Said said = mckibben("run volts.yaml", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find(" V, integral_time"), std::string::npos) << said.out;
  const Json document = Json::parse(read_text(scratch / "out/volts/run.json"));
  const Json& pid = document.at("scenario").at("controllers")[0];
  EXPECT_EQ(pid.at("lowest_command"), "0.5 V");
  EXPECT_EQ(pid.at("largest_command_speed"), "40 V/s");
  const double gain = document.at("tuned")[0].at("proportional_V").get<double>();
  EXPECT_EQ(pid.contains("proportional"), false);
  EXPECT_GT(gain, 0.0);
  EXPECT_LT(document.at("runs")[0].at("rmse").get<double>(), 0.01);
  EXPECT_GT(document.at("runs")[0].at("command_travel_V").get<double>(), 1.0);
  EXPECT_EQ(read_text(scratch / "out/volts/8kg_pid.csv").find("time_s,command_V,contraction_ratio,"), 0u);
  const std::string page = read_text(scratch / "out/volts/report.html");
  EXPECT_NE(page.find("\"command\":{\"name\":\"command\",\"title\":\"Command\",\"unit\":\"V\""),
            std::string::npos);

  write_text(scratch / "mA.yaml", "schema: mckibben-scenario/1\n" + rig +
                                      rest.substr(0, rest.find("[{kind")) +
                                      "[{kind: pid, lowest_command: 4 mA}]\n");
  const Said refused = mckibben("check mA.yaml", scratch);
  EXPECT_EQ(refused.status, 65);
  EXPECT_NE(refused.err.find("lowest_command = 4 mA: mA is the wrong kind of unit; wanted is V"),
            std::string::npos)
      << refused.err;
}

TEST(Limits, DataOfARigInVoltsAreWrittenAndReadInVolts) {
  const Scratch scratch;
  write_text(
      scratch / "campaign.yaml",
      "schema: mckibben-campaign/1\n"
      "rig: {valve: {zero_command: 0 V, span_command: 10 V, zero_pressure: 0.5 bar, span_pressure: 5 "
      "bar}}\nloads: [11 kg]\n"
      "currents: [{duration: 3 s, current: {kind: sine_current, low: 0 V, high: 8 V, period: 3 s}}]\n");
  ASSERT_EQ(mckibben("dataset campaign.yaml --out data", scratch).status, 0);
  EXPECT_EQ(read_text(scratch / "data/m1_c01.csv").find("time_s,command_V,"), 0u);
  const Said said = mckibben("replay data --json --out again", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json gap = Json::parse(said.out).at("runs")[0];
  EXPECT_LT(gap.at("rmse").get<double>(), 1e-3) << gap;
  const Said other = mckibben("replay data --rig thesis --out other", scratch);
  EXPECT_EQ(other.status, 65);
  EXPECT_NE(other.err.find("the data are of a valve that is commanded in V, this rig's is in mA"),
            std::string::npos)
      << other.err;
}

TEST(Limits, AControllerAtItsLimitIsSaidEverywhere) {
  const Scratch scratch;
  write_text(scratch / "held.yaml", scenario("  - {kind: pid, lowest_command: 4 mA}\n"
                                             "  - {kind: pid, name: higher, lowest_command: 5 mA}\n"));
  const Said said = mckibben("run held.yaml", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(read_text(scratch / "out/held/run.json"));
  EXPECT_EQ(document.at("runs")[0].at("at_lowest_current"), 1.0);
  EXPECT_TRUE(document.at("tuned")[0].at("gained_nothing").get<bool>());
  EXPECT_TRUE(holds(said.err,
                    "run pid at 8 kg: it stood at its lowest current, 4 mA, for 100 % of the time; the rig's "
                    "valve goes down to 0 mA: lower lowest_command",
                    "run higher at 8 kg: it stood at its lowest current, 5 mA, ",
                    "run pid at 8 kg: its tuning gained nothing: the cost is "));
  EXPECT_TRUE(holds(said.out, "at_limit_%", ": the tuning gained nothing\n"));
  const std::string report = read_text(scratch / "out/held/report.html");
  EXPECT_TRUE(lacks(report, "follows the target best"));
  EXPECT_TRUE(holds(report,
                    "pid errs least: ", " pid stood at its lowest current, 4 mA, for 100 % of the time.",
                    "The tuning of pid gained nothing"));
}

}  // namespace
}  // namespace mckibben::cli
