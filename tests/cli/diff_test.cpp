// The verb diff: the same folder twice, a change that is seen in inputs, metrics and trajectories, and what
// is no run folder.
#include <algorithm>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

class Diff : public InAFolder {
 protected:
  void SetUp() override {
    write_text(scratch / "quick.yaml", quick_scenario);
    ASSERT_EQ(run("run quick.yaml --out a").status, 0);
  }
  /// A scenario with something else in one place, simulated into `folder`.
  void run_changed(const std::string& what, const std::string& by, const std::string& folder) {
    write_text(scratch / "quick.yaml", std::regex_replace(quick_scenario, std::regex(what), by));
    ASSERT_EQ(run("run quick.yaml --out " + folder).status, 0);
  }
};

TEST_F(Diff, OfTheSameFindsNothing) {
  const Said said = run("diff a a --tolerance 0");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "The inputs are the same.", "All 4 runs are the same to the last digit."));
  const Json document = Json::parse(run("diff a a --json").out);
  EXPECT_EQ(document.at("same_inputs"), true);
  EXPECT_EQ(document.at("same_runs"), true);
  EXPECT_EQ(document.at("runs")[0].at("columns").at("muscle_pressure_bar").at("largest"), 0.0);
}

TEST_F(Diff, TellsWhichInputDiffersAndWhatItDid) {
  run_changed("assumed_load: 14 kg", "assumed_load: 15 kg", "b");
  const Said said = run("diff a b --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  ASSERT_EQ(document.at("inputs").size(), 2u) << said.out;
  EXPECT_EQ(document.at("inputs")[0].at("key"), "scenario.controllers[static_inverse].assumed_load");
  EXPECT_EQ(document.at("inputs")[0].at("left"), "14 kg");
  EXPECT_EQ(document.at("inputs")[0].at("right"), "15 kg");
  EXPECT_EQ(document.at("inputs")[1].at("key"), "input_files[quick.yaml].sha256");
  ASSERT_EQ(document.at("runs").size(), 4u);
  const Json& waveform = document.at("runs")[0];
  EXPECT_EQ(waveform.at("run"), "11.138 kg sine_current");
  EXPECT_EQ(waveform.at("same"), true);
  const Json& inverse = document.at("runs")[1];
  EXPECT_EQ(inverse.at("run"), "11.138 kg static_inverse");
  const Json& ratio = inverse.at("columns").at("contraction_ratio");
  const double largest = ratio.at("largest"), rms = ratio.at("rms");
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(rms, largest);
  EXPECT_GT(rms, 0.0);
  const Json left = Json::parse(read_text(scratch / "a/run.json")),
             right = Json::parse(read_text(scratch / "b/run.json"));
  for (const Json& metric : inverse.at("metrics"))
    if (metric.at("key") == "rmse") {
      EXPECT_EQ(metric.at("left"), left.at("runs")[1].at("rmse"));
      EXPECT_EQ(metric.at("right"), right.at("runs")[1].at("rmse"));
    }
  const std::string text = run("diff a b").out;
  EXPECT_TRUE(holds(text, "14 kg", "15 kg", "11.138 kg static_inverse", "rmse"));
  EXPECT_TRUE(lacks(text, "sine_current")) << "what is the same is not listed";
  const double of_all = std::max(
      largest, document.at("runs")[3].at("columns").at("contraction_ratio").at("largest").get<double>());
  EXPECT_EQ(run("diff a b --tolerance " + std::to_string(0.9 * of_all)).status, 1);
  EXPECT_EQ(run("diff a b --tolerance " + std::to_string(1.1 * of_all)).status, 0);
}

TEST_F(Diff, NamesRunsThatOnlyOneHasAndRowsThatAreMissing) {
  run_changed("loads: .11.138 kg, 16.138 kg", "loads: [11.138 kg, 20 kg", "b");
  const Json other = Json::parse(run("diff a b --json").out);
  EXPECT_EQ(other.at("only_left")[0], "16.138 kg sine_current");
  EXPECT_EQ(other.at("only_right")[0], "20 kg sine_current");
  EXPECT_EQ(run("diff a b --tolerance 1").status, 1) << "a run that is missing is no agreement";
  run_changed("duration: 1 s", "duration: 0.9 s", "c");
  const Json shorter = Json::parse(run("diff a c --json").out);
  EXPECT_EQ(shorter.at("runs")[0].at("note"), "83 and 75 rows; the first 75 are compared");
  EXPECT_EQ(shorter.at("runs")[0].at("columns").at("contraction_ratio").at("largest"), 0.0);
  EXPECT_EQ(run("diff a c --tolerance 1").status, 1);
}

TEST_F(Diff, OfReplays) {
  write_text(
      scratch / "dataset.yaml",
      "schema: mckibben-dataset/1\nruns: [{id: r1, file: a/11.138kg_sine_current.csv, load: 11.138 kg}]\n");
  write_text(scratch / "thin.yaml", "schema: mckibben-rig/1\nmuscle: {rest_radius: 7 mm}\n");
  ASSERT_EQ(run("replay dataset.yaml --out p").status, 0);
  ASSERT_EQ(run("replay dataset.yaml --rig thin.yaml --out q").status, 0);
  const Json document = Json::parse(run("diff p q --json --out d").out);
  EXPECT_EQ(document.at("inputs")[0].at("key"), "rig.muscle.rest_radius");
  EXPECT_EQ(document.at("runs")[0].at("run"), "r1");
  EXPECT_GT(document.at("runs")[0].at("columns").at("contraction_ratio").at("largest"), 1e-3);
  EXPECT_EQ(Json::parse(read_text(scratch / "d/diff.json")), document);
  const Said mixed = run("diff a p");
  EXPECT_EQ(mixed.status, 65);
  EXPECT_TRUE(holds(mixed.err, "another kind, mckibben-replay/1"));
  EXPECT_EQ(run("diff p q --out p").status, 74);
}

TEST_F(Diff, RefusesWhatIsNoRunFolder) {
  fs::create_directory(scratch / "empty");
  EXPECT_EQ(run("diff a nowhere").status, 66);
  EXPECT_EQ(run("diff a quick.yaml").status, 66);
  const Said empty = run("diff a empty");
  EXPECT_EQ(empty.status, 66);
  EXPECT_TRUE(holds(empty.err, "empty: is not a folder that run or replay wrote"));
  for (const char* text :
       {"{\n\"schema\": ", "[]", "{\"schema\": \"mckibben-map/1\"}", "{\"schema\": 3}",
        "{\"schema\": \"mckibben-run/1\", \"runs\": [{}]}", "{\"schema\": \"mckibben-run/1\"}"}) {
    write_text(scratch / "empty/run.json", text);
    for (const char* order : {"diff a empty", "diff empty a"}) {
      const Said said = run(order);
      EXPECT_EQ(said.status, 65) << text << said.err;
      EXPECT_EQ(said.out, "");
      EXPECT_TRUE(holds(said.err, "run.json:"));
    }
  }
  EXPECT_EQ(run("diff a").status, 64);
  EXPECT_EQ(run("diff a a --tolerance -1").status, 64);
  fs::copy(scratch / "a", scratch / "torn");
  const std::string csv = read_text(scratch / "a/11.138kg_sine_current.csv");
  write_text(scratch / "torn/11.138kg_sine_current.csv", csv.substr(0, csv.size() / 2));
  EXPECT_EQ(run("diff a torn").status, 65);
  fs::remove(scratch / "torn/11.138kg_sine_current.csv");
  EXPECT_EQ(run("diff a torn").status, 66);
}

}  // namespace
}  // namespace mckibben::cli
