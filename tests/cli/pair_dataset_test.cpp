// The verb dataset with two muscles on one joint.
#include <string>

#include <gtest/gtest.h>

#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>

#include "dataset.hpp"

namespace mckibben::cli {
namespace {

using input::Json;

class PairDataset : public Dataset {
 protected:
  void SetUp() override {
    write_text(
        scratch / "leaky.yaml",
        "schema: mckibben-rig/1\nbase: thesis_pair\ngauge: {fitted: true}\n"
        "effects: {viscous_damping: {damping: 40 N.s/m}}\n"
        "mechanics: {kind: pair, opposite: {effects: {muscle_leak: {conductance: 3e-10 m3/(s.Pa)}}}}\n");
    write_text(scratch / "pair.yaml", text);
  }
  const std::string text =
      "schema: mckibben-campaign/1\nrig: leaky.yaml\n"
      "currents:\n"
      "  - {name: against, duration: 1.2 s, current_1: {kind: sine_current, low: 6 mA, high: 16 mA, period: "
      "1.2 s}, current_2: {kind: triangle_current, low: 6 mA, high: 16 mA, period: 0.8 s}}\n"
      "  - {duration: 0.6 s, current_1: {kind: step_current, start: 12 mA, moves: [{at: 0.2 s, to: 9 mA}]}, "
      "current_2: {kind: step_current, start: 10 mA, moves: []}}\n"
      "repeats: 2\nnoise: {encoder_jitter: 1e-4, gauge: 4 mbar}\n";
};

TEST_F(PairDataset, HasTwoCommandsAnAngleAndGaugesAndHidesWhatEitherSideHas) {
  const auto said = run("dataset pair.yaml --json");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read_text(scratch / "out/pair/campaign.json"), said.out);
  const Json document = Json::parse(said.out);
  const Json& entry = document.at("runs").at(1);
  EXPECT_EQ(entry.at("id"), "against_r2");
  EXPECT_EQ(entry.at("rows"), 100);
  EXPECT_FALSE(entry.contains("load_kg"));
  EXPECT_LT(entry.at("angle_rad").at("lowest"), -0.1);
  const auto dataset = input::read_dataset(scratch / "out/pair");
  ASSERT_EQ(dataset.runs.size(), 4u);
  EXPECT_EQ(dataset.runs[2].id, "c02_r1");
  const domain::Measurement& measured = dataset.runs[0].measured.value();
  EXPECT_TRUE(measured.counted);
  EXPECT_EQ(measured.read("angle").size(), 100u);
  EXPECT_EQ(measured.read("muscle_pressure", 2).size(), 100u);
  EXPECT_TRUE(dataset.rig.effects.absent());
  EXPECT_TRUE(dataset.rig.pair()->opposite.effects.absent());
  for (const auto& [name, content] : contents(scratch / "out/pair")) {
    EXPECT_TRUE(lacks(content, "muscle_leak")) << name;
    EXPECT_TRUE(lacks(content, "tension_1_N")) << name;  // nothing true in it
    EXPECT_TRUE(lacks(name, "thesis"));
  }
  const std::string truth = read_text(scratch / "out/pair-truth/truth.yaml");
  EXPECT_TRUE(holds(truth, "muscle_leak", "damping: 40 N.s/m"));
  EXPECT_TRUE(holds(read_text(scratch / "out/pair-truth/against_r1.csv"), ",gauge_pressure_2_bar\n"));
  EXPECT_TRUE(holds(read_text(scratch / "out/pair/report.html"), "commanded pressure 2 in bar"));
}

TEST_F(PairDataset, ReplayedOnItsTrueRigItIsRightToACount) {
  write_text(scratch / "quiet.yaml", text.substr(0, text.find("noise:")));
  ASSERT_EQ(run("dataset quiet.yaml").status, 0);
  const auto said = run("replay out/quiet --rig leaky.yaml --out back --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  for (const auto& entry : document.at("runs")) {
    ASSERT_EQ(entry.at("gaps").size(), 3u);
    EXPECT_LT(entry.at("gaps").at(0).at("largest_error"), 4.5e-3);  // 0.25 deg
    EXPECT_LT(entry.at("gaps").at(2).at("largest_error"), 1e-5);
  }
}

TEST_F(PairDataset, HalvedCountsOfItsAngleAreTold) {
  ASSERT_EQ(run("dataset pair.yaml").status, 0);
  EXPECT_TRUE(lacks(run("check out/pair").err, "halved"));
  std::string columns = read_text(scratch / "out/pair/dataset.yaml");
  const std::size_t factor = columns.find("factor: ");
  columns.replace(factor, columns.find('\n', factor) - factor, "factor: 114.59");  // of 229.18 counts per rad
  write_text(scratch / "out/pair/dataset.yaml", columns);
  const auto said = run("check out/pair");
  EXPECT_TRUE(holds(said.err, "angle is 0.", "are counts per turn halved",
                    "columns: {angle: {column: angle_rad, ", "factor: 229.18}"))
      << columns;
}

TEST_F(PairDataset, AnInterruptedOneGoesOnAndItsFilesAreTheSame) {
  ASSERT_EQ(run("dataset pair.yaml --out whole --format mat --threads 2").status, 0);
  begin(scratch / "parts", input::read_campaign(scratch / "pair.yaml"), 3, {"mat"});
  const auto said = run("dataset pair.yaml --out parts --format mat --threads 1");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "3 of 4 runs are there already"));
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
  EXPECT_EQ(contents(scratch / "whole-truth"), contents(scratch / "parts-truth"));
}

TEST_F(PairDataset, ACordThatWouldHaveToPushIsSaid) {
  write_text(scratch / "slack.yaml",
             "schema: mckibben-campaign/1\n"
             "rig: {base: thesis_pair, effects: {bladder_elasticity: {stiffness: 8000 N/m}}}\n"
             "currents: [{name: slack, duration: 0.6 s, current_1: {kind: step_current, moves: []}, "
             "current_2: {kind: step_current, moves: []}}]\n");
  const auto said = run("dataset slack.yaml");
  ASSERT_EQ(said.status, 0) << said.err;
  for (const std::string& told : {said.out, said.err, read_text(scratch / "out/slack/report.html")})
    EXPECT_TRUE(holds(told, "the cord of muscle 2 would have to push")) << told.substr(0, 2000);
}

}  // namespace
}  // namespace mckibben::cli
