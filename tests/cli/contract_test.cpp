// What scripts rely on, for every verb: exit statuses, one JSON document on stdout and nothing else there,
// and nothing on stdout where there is no result.
#include <memory>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/cli/app.hpp>
#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

// A law that pulls a heavy load past the range in which the braid is defined.
constexpr const char* falls =
    "{muscle: {stop_stiffness: 1e5 N/m}, effects: {residual_law: {terms: [{of: m g, coefficient: -800 N}]}}}";

/// Two runs of half a second: enough to be read, too little for a calibration.
void write_short_runs(const fs::path& folder) {
  std::string table = "time_s,current_mA,contraction_ratio\n";
  for (int k = 0; k < 40; ++k)
    table += fmt::format("{:.3f},{:.1f},{:.4f}\n", 0.012 * k, 4 + 0.2 * k, 0.002 * k);
  fs::create_directory(folder);
  write_text(folder / "r1.csv", table);
  write_text(folder / "dataset.yaml",
             "schema: mckibben-dataset/1\nruns:\n  - {id: r1, file: r1.csv, load: 11.138 kg}\n"
             "  - {id: r2, file: r1.csv, load: 16.138 kg}\n");
}

class Contract : public testing::Test {
 protected:
  /// One folder for all tests here: each writes where no other does.
  static void SetUpTestSuite() {
    scratch = std::make_unique<Scratch>();
    const Scratch& s = *scratch;
    const std::string quick = quick_scenario;
    write_text(s / "quick.yaml", quick);
    write_text(s / "strict.yaml", quick + "criteria: [{rmse_below: 1e-9}]\n");
    write_text(s / "bad.yaml", "schema: mckibben-scenario/1\nsede: 3\n");
    write_text(s / "fall.yaml",
               std::string("schema: mckibben-scenario/1\nrig: ") + falls +
                   "\nloads: [45 kg]\nduration: 1 s\ntarget: {kind: steps, start: 0.01, moves: []}\n"
                   "controllers: [{kind: step_current, moves: []}]\n");
    write_text(s / "campaign.yaml", campaign_of_sines());
    write_text(
        s / "falling_campaign.yaml",
        std::string("schema: mckibben-campaign/1\nrig: ") + falls +
            "\nloads: [45 kg]\ncurrents: [{duration: 1 s, current: {kind: step_current, moves: []}}]\n");
    write_text(s / "falling_rig.yaml",
               "schema: mckibben-rig/1\nmuscle: {stop_stiffness: 1e5 N/m}\n"
               "effects: {residual_law: {terms: [{of: m g, coefficient: -800 N}]}}\n");
    write_short_runs(s / "short");
    write_text(s / "heavy.yaml",
               "schema: mckibben-dataset/1\nrig: falling_rig.yaml\nruns:\n"
               "  - {id: r1, file: short/r1.csv, load: 45 kg}\n");
    write_text(s / "bench.yaml",
               "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 0.1 s\n"
               "rig: {base: thesis, settling_time: 0 s}\n"
               "target: {kind: minimum_jerk, start: 0.05, moves: []}\n"
               "controllers: [{kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}]\n");
    write_text(s / "file", "mine");
    ASSERT_EQ(mckibben("run quick.yaml --out a", s).status, 0);
    write_text(s / "other.yaml", quick + "seed: 5\nrig: {muscle: {rest_radius: 8 mm}}\n");
    ASSERT_EQ(mckibben("run other.yaml --out b", s).status, 0);
    ASSERT_EQ(mckibben("dataset campaign.yaml --out data", s).status, 0);
    ASSERT_EQ(mckibben("calibrate data --out cal", s).status, 0);
  }
  static void TearDownTestSuite() { scratch.reset(); }
  static Said run(const std::string& arguments) { return mckibben(arguments, *scratch); }
  static std::unique_ptr<Scratch> scratch;
};
std::unique_ptr<Scratch> Contract::scratch;

struct Case {
  int status;
  const char* arguments;
};

constexpr Case cases[] = {
    {0, "run quick.yaml --out r1"},
    {0, "dataset campaign.yaml --out r2"},
    {0, "calibrate data --out r3"},
    {0, "map cal/calibration.yaml --load '14 kg' --ratios 2 --speeds 1 --out r5"},
    {0, "replay short --out r6"},
    {0, "diagnose short --time-limit '1 us' --out r7"},
    {0, "import short/r1.csv --out r14"},
    {0, "fmu thesis --out r15.fmu"},
    {0, "linearise thesis --at '10 mA' --out r18"},
    {0, "control bench.yaml --most-missed 1000 --out r16"},
    {0, "diff a b"},
    {0, "check quick.yaml campaign.yaml short"},
    {0, "effects"},
    {0, "schema rig"},
    {0, "init started.yaml"},
    {1, "run strict.yaml --out r8"},
    {1, "diff a b --tolerance 0"},
    {64, ""},
    {64, "fly"},
    {64, "run"},
    {64, "run quick.yaml --threads 0"},
    {64, "run quick.yaml more.yaml"},
    {64, "dataset campaign.yaml --seed -1"},
    {64, "calibrate data --load-order 4"},
    {64, "map cal/calibration.yaml --load 14"},
    {64, "map cal/calibration.yaml --load '14 m'"},
    {64, "replay --rig thesis"},
    {64, "diagnose short --seed 1.5"},
    {64, "diff a"},
    {64, "diff a b --tolerance much"},
    {64, "check"},
    {64, "effects nothing"},
    {64, "schema kitchen"},
    {64, "schema rig --json --format yaml"},
    {64, "schema all"},
    {64, "schema campaign --format yaml"},
    {64, "dataset campaign.yaml --keep summary --out r17"},
    {64, "init one.yaml two.yaml"},
    {64, "fmu thesis --fmi 1.0"},
    {64, "linearise thesis --friction none"},
    {64, "linearise thesis --at '10 kg'"},
    {64, "control bench.yaml --device hammer"},
    {65, "run bad.yaml"},
    {65, "dataset bad.yaml"},
    {65, "calibrate quick.yaml"},
    {65, "calibrate short"},
    {65, "map quick.yaml"},
    {65, "map cal/calibration.yaml --load '45 kg'"},
    {65, "replay quick.yaml"},
    {65, "fmu quick.yaml"},
    {65, "linearise bad.yaml"},
    {65, "linearise thesis --at 0.9"},
    {65, "control quick.yaml"},
    {65, "replay short --rig quick.yaml"},
    {65, "diagnose quick.yaml"},
    {65, "diff a file_with_wrong_json"},
    {65, "check bad.yaml"},
    {65, "check quick.yaml bad.yaml nowhere.yaml"},
    {66, "run nowhere.yaml"},
    {66, "dataset nowhere.yaml"},
    {66, "fmu nowhere.yaml"},
    {66, "linearise nowhere.yaml"},
    {66, "control nowhere.yaml"},
    {66, "live nowhere.yaml"},
    {66, "calibrate nowhere"},
    {66, "map nowhere.yaml"},
    {66, "replay nowhere"},
    {66, "replay short --rig nowhere.yaml"},
    {66, "diagnose nowhere"},
    {66, "diff a nowhere"},
    {66, "check nowhere.yaml"},
    {70, "run fall.yaml --out r9"},
    {70, "dataset falling_campaign.yaml --out r10"},
    {70, "linearise falling_rig.yaml --load '45 kg' --out r19"},
    {70, "replay heavy.yaml --out r11"},
    {70, "diagnose heavy.yaml --out r12"},
    {70,
     "map cal/calibration.yaml --rig falling_rig.yaml --load '45 kg' "
     "--extrapolate-load --ratios 1 --speeds 1 --out r13"},
    {74, "run quick.yaml --out file"},
    {74, "dataset campaign.yaml --out file"},
    {74, "calibrate data --out file/below"},
    {74, "map cal/calibration.yaml --out cal"},
    {74, "replay short --out short"},
    {74, "diagnose short --out file"},
    {74, "diagnose short --plan file --out r14"},
    {74, "diff a b --out a"},
    {74, "check quick.yaml --out file"},
    {74, "effects --out file"},
    {74, "linearise thesis --out file"},
    {74, "init file"},
};

/// `mckibben-WORD/1`
bool is_schema(const std::string& text) {
  return text.rfind("mckibben-", 0) == 0 && text.find('/') != std::string::npos;
}

/// Whether a result is printed: always if there is one, and by `check`, whose result is what is wrong.
bool prints(const Case& one) {
  const std::string arguments = one.arguments;
  if (arguments == "diagnose heavy.yaml --out r12") return false;  // nothing could be simulated
  if (arguments.starts_with("linearise falling_rig.yaml")) return false;
  if (one.status == 0 || one.status == 1 || one.status == 70) return true;
  return arguments.rfind("check", 0) == 0 && (one.status == 65 || one.status == 66);
}

TEST_F(Contract, ExitStatusesAndJsonOfEveryVerb) {
  fs::create_directory(*scratch / "file_with_wrong_json");
  write_text(*scratch / "file_with_wrong_json/run.json", "{}");
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  std::set<std::string> verbs, printed;
  for (const auto* verb : app.get_subcommands({})) verbs.insert(verb->get_name());
  for (const Case& one : cases) {
    const std::string arguments = one.arguments;
    const Said said = run(arguments + " --json");
    EXPECT_EQ(said.status, one.status) << arguments << "\n" << said.err;
    if (!prints(one)) {
      EXPECT_NE(said.err, "") << arguments;
      EXPECT_EQ(said.out, "") << arguments;
      continue;
    }
    const Json document = Json::parse(said.out, nullptr, false);
    ASSERT_FALSE(document.is_discarded()) << arguments << "\n" << said.out;
    EXPECT_TRUE(arguments == "schema rig" ? document.contains("$schema")
                                          : is_schema(document.value("schema", "")))
        << arguments;
    printed.insert(arguments.substr(0, arguments.find(' ')));
  }
  // It goes on until it is told to stop.
  const Said live = shell(
      "\"$M\" live thesis --json > page & until [ -s page ] || ! kill -0 $!; do sleep 0.05; done; kill -TERM "
      "$!; wait $!; "
      "status=$?; cat page; exit $status",
      *scratch);
  EXPECT_EQ(live.status, 0) << live.err;
  EXPECT_EQ(Json::parse(live.out).at("schema"), "mckibben-live/1");
  printed.insert("live");
  EXPECT_EQ(printed, verbs);
  EXPECT_EQ(read_text(*scratch / "file"), "mine");
}

TEST_F(Contract, WhatCannotBePrintedIs74) {
  for (const char* arguments :
       {"run quick.yaml", "replay short", "diagnose short --time-limit '1 us'", "diff a b",
        "check quick.yaml", "check quick.yaml --json", "effects", "schema", "schema --format markdown",
        "schema rig --format yaml", "init full.yaml"})
    EXPECT_EQ(run(std::string(arguments) + " > /dev/full; exit $?; true").status, 74) << arguments;
}

}  // namespace
}  // namespace mckibben::cli
