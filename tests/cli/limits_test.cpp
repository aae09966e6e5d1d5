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
         "  valve: {zero_current: 0 mA, span_current: 10 mA, zero_pressure: 0 bar}\n"
         "  dac: {largest_current: 10 mA}\n"
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
  EXPECT_EQ(document.at("scenario").at("controllers")[0].at("lowest_current"), "0 mA");
  const Json& run = document.at("runs")[0];
  EXPECT_LT(run.at("rmse").get<double>(), 0.01);
  EXPECT_LT(run.at("at_lowest_current").get<double>() + run.at("at_highest_current").get<double>(), 0.5);
  EXPECT_FALSE(document.at("tuned")[0].at("gained_nothing").get<bool>());
  EXPECT_TRUE(document.at("warnings").empty()) << document.at("warnings");
}

TEST(Limits, AControllerAtItsLimitIsSaidEverywhere) {
  const Scratch scratch;
  write_text(scratch / "held.yaml", scenario("  - {kind: pid, lowest_current: 4 mA}\n"
                                             "  - {kind: pid, name: higher, lowest_current: 5 mA}\n"));
  const Said said = mckibben("run held.yaml", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(read_text(scratch / "out/held/run.json"));
  EXPECT_EQ(document.at("runs")[0].at("at_lowest_current"), 1.0);
  EXPECT_TRUE(document.at("tuned")[0].at("gained_nothing").get<bool>());
  EXPECT_TRUE(holds(said.err,
                    "run pid at 8 kg: it stood at its lowest current, 4 mA, for 100 % of the time; the rig's "
                    "valve goes down to 0 mA: lower lowest_current",
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
