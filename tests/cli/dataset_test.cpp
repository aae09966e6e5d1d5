// The verb dataset from end to end: what is written and where. Interrupted: dataset_again_test.cpp; of a pair
// of muscles: pair_dataset_test.cpp.
#include "dataset.hpp"

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::cli {
namespace {

using input::Json;

std::vector<std::vector<double>> numbers(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (double value = 0.0; cells >> value;) rows.back().push_back(value);
  }
  return rows;
}

// Whoever gets the data is to find what is hidden.
TEST_F(Dataset, NothingInTheDataHoldsTheCampaignsName) {
  write_text(scratch / "leak_of_40.yaml", small_campaign);
  ASSERT_EQ(run("dataset leak_of_40.yaml --out homework --format netcdf").status, 0);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch / "homework")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_TRUE(lacks(read_text(entry.path()), "leak_of_40")) << entry.path();
  }
  EXPECT_GT(files, 10U);
  ASSERT_EQ(run("dataset leak_of_40.yaml --out homework --seed 9").status, 0);
  EXPECT_FALSE(exists("homework.old-1")) << "it was known as its own";
}

TEST_F(Dataset, BothFoldersNameTheCommandThatWroteThem) {
  ASSERT_EQ(run("dataset small.yaml --out d").status, 0);
  EXPECT_TRUE(holds(run("replay d-truth").err, "written by `mckibben dataset small.yaml`"));
  EXPECT_TRUE(holds(run("run d").err, "written by `mckibben dataset`"));
}

TEST_F(Dataset, AndCheckAskAboutALoadThatIsNeverLifted) {
  std::string heavy = small_campaign;
  heavy.replace(heavy.find("11.138"), 6, "111.38");
  write_text(scratch / "small.yaml", heavy);
  const char* const words =
      "small.yaml:3:9: warning: loads: 111.38 kg is more than the muscle lifts, about 10";
  EXPECT_TRUE(holds(run("check small.yaml").err, words));
  const auto said = run("dataset small.yaml");
  ASSERT_EQ(said.status, 0);
  EXPECT_TRUE(holds(said.err, words)) << said.err;
  EXPECT_TRUE(holds(run("check out/small").err, "the load hardly leaves its stop: load = 111.38 kg is more"));
}

TEST_F(Dataset, WritesMeasurementsAndApartTheTruth) {
  const auto said = run("dataset small.yaml");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "small: 2 loads x 2 currents x 2, 1200 rows, 14.4 s simulated"));
  EXPECT_FALSE(exists("out/small.unfinished"));
  const auto dataset = input::read_dataset(scratch / "out/small");
  ASSERT_EQ(dataset.runs.size(), 8u);
  EXPECT_EQ(dataset.runs[0].id, "m1_c01_r1");
  EXPECT_EQ(dataset.runs[7].id, "m2_up_r2");
  EXPECT_EQ(dataset.runs[7].load_kg, 23.406);
  EXPECT_EQ(dataset.runs[7].current_mA.size(), 100u);
  EXPECT_NE(dataset.runs[0].find("muscle_pressure"), nullptr);
  EXPECT_NE(dataset.rig.sensors.of(plant::Sensed::muscle_pressure),
            nullptr);  // rig.yaml, because it is not the shipped rig
  EXPECT_TRUE(exists("out/small/rig.yaml"));
  for (const auto& run : dataset.runs) {
    EXPECT_EQ(read_text(scratch / "out/small-truth" / (run.id + ".csv"))
                  .rfind("time_s,current_mA,contraction_ratio,contraction_speed_per_s,valve_pressure_bar", 0),
              0u);
    EXPECT_TRUE(exists("out/small/thesis/" + run.id + ".txt"));
  }
  for (const auto& [name, text] : contents(scratch / "out/small")) {
    EXPECT_TRUE(lacks(text, "contraction_speed")) << name;  // nothing true in it
    EXPECT_TRUE(lacks(name, "truth"));
  }
  const auto truth = input::load_yaml(scratch / "out/small-truth/truth.yaml");
  EXPECT_EQ(truth.root.find("runs")->children.size(), 8u);
  EXPECT_EQ(truth.root.find("rig")->find("friction")->find("f0")->text, "4.6937");
}

TEST_F(Dataset, TellsWhatItDidInCampaignJson) {
  const auto said = run("dataset small.yaml --json --seed 5");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read_text(scratch / "out/small/campaign.json"), said.out);
  const Json document = Json::parse(said.out);
  EXPECT_EQ(document.at("schema"), "mckibben-campaign-run/1");
  EXPECT_EQ(document.at("seed"), 5);
  EXPECT_EQ(document.at("campaign").at("repeats"), 2);
  EXPECT_FALSE(document.contains("input_files"));  // a name may tell what is hidden
  EXPECT_TRUE(holds(read_text(scratch / "out/small-truth/truth.yaml"), "input_files", "file: small.yaml"));
  EXPECT_GT(document.at("runs").at(0).at("solver").at("steps").get<long>(), 200);
  EXPECT_EQ(document.at("runs").at(1).at("rows"), 200);
}

TEST_F(Dataset, NamesTheShippedRigWhenItIsTheOne) {
  std::string text = small_campaign;
  text.replace(text.find("{gauge: {fitted: true}}"), 23, "thesis");
  write_text(scratch / "small.yaml", text);
  ASSERT_EQ(run("dataset small.yaml").status, 0);
  EXPECT_TRUE(holds(read_text(scratch / "out/small/dataset.yaml"), "rig: thesis\n"));
  EXPECT_FALSE(exists("out/small/rig.yaml"));
  EXPECT_EQ(input::read_dataset(scratch / "out/small").runs[0].find("muscle_pressure"), nullptr);
}

TEST_F(Dataset, KeepsTheEffectsOfItsBase) {
  std::string text = small_campaign;
  text.replace(text.find("{gauge: {fitted: true}}"), 23,
               "{base: festo_dmsp_20, effects: {muscle_leak: {conductance: 1e-10 m3/(s.Pa)}}}");
  write_text(scratch / "small.yaml", text);
  const auto said = run("dataset small.yaml");
  ASSERT_EQ(said.status, 0);
  EXPECT_TRUE(holds(said.err,
                    "hidden: muscle_leak; known from dataset.yaml (rig: festo_dmsp_20): "
                    "bladder_elasticity\n"));
  EXPECT_FALSE(exists("out/small/rig.yaml"));
  EXPECT_TRUE(holds(read_text(scratch / "out/small/dataset.yaml"), "rig: festo_dmsp_20\n"));
  EXPECT_TRUE(holds(read_text(scratch / "out/small-truth/truth.yaml"), "bladder_elasticity", "muscle_leak"));
}

TEST_F(Dataset, SaysWhatIsHiddenByValue) {
  int made = 0;
  const auto said_of = [&](const std::string& rig) {
    std::string text = small_campaign;
    text.replace(text.find("{gauge: {fitted: true}}"), 23, rig);
    write_text(scratch / "small.yaml", text);
    return run("dataset small.yaml --out out/" + std::to_string(++made)).err;
  };
  EXPECT_TRUE(
      holds(said_of("{base: festo_dmsp_20, joint: {load_offset: 0.5 kg}}"),
            "hidden: joint.load_offset; known from dataset.yaml (rig: festo_dmsp_20): bladder_elasticity\n"));
  EXPECT_TRUE(holds(said_of("{base: festo_dmsp_20, gauge: {fitted: true}, joint: {load_offset: 0.5 kg}}"),
                    "hidden: joint.load_offset; known from rig.yaml: bladder_elasticity\n"));
  EXPECT_TRUE(exists("out/2/rig.yaml"));
  EXPECT_TRUE(holds(said_of("{base: festo_dmsp_20, effects: {bladder_elasticity: {force: 333 N}}}"),
                    "hidden: bladder_elasticity\n"));
  EXPECT_TRUE(holds(said_of("{base: festo_dmsp_20, effects: {bladder_elasticity: {force: 0 N}}}"),
                    "hidden: no bladder_elasticity\n"));
  EXPECT_TRUE(holds(said_of("thesis"), "hidden: nothing\n"));
}

TEST_F(Dataset, ALoadOfNothingIsWrittenToo) {
  std::string text = small_campaign;
  text.replace(text.find("{gauge: {fitted: true}}"), 23, "{joint: {moving_mass: 11 kg}}");
  text.replace(text.find("11.138 kg"), 9, "0 kg");
  write_text(scratch / "small.yaml", text);
  const auto said = run("dataset small.yaml");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(input::read_dataset(scratch / "out/small").runs[0].load_kg, 0.0);
}

TEST_F(Dataset, ReplayedItIsRightToACount) {
  std::string text = small_campaign;
  write_text(scratch / "quiet.yaml", text.erase(text.find("noise:")));
  ASSERT_EQ(run("dataset quiet.yaml").status, 0);
  const auto said = run("replay out/quiet --out back --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  ASSERT_EQ(document.at("runs").size(), 8u);
  for (const auto& entry : document.at("runs")) {
    EXPECT_LT(entry.at("largest_error").get<double>(), 4.4e-4);
    EXPECT_LT(entry.at("pressure_rmse_bar").get<double>(), 5e-6);  // the tolerance: replayed one by one
  }
}

// T 3.3: speed and acceleration are calculated from counts, pressure from the current.
TEST_F(Dataset, ThesisFilesFollowFromTheirFirstTwoColumns) {
  ASSERT_EQ(run("dataset small.yaml").status, 0);
  const auto dataset = input::read_dataset(scratch / "out/small");
  for (const auto& each : dataset.runs) {
    const auto rows = numbers(read_text(scratch / "out/small/thesis" / (each.id + ".txt")));
    ASSERT_EQ(rows.size(), each.current_mA.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      ASSERT_EQ(rows[k].size(), 5u);
      EXPECT_EQ(rows[k][0], each.current_mA[k]);
      EXPECT_EQ(rows[k][1], each.judged().values[k]);
      const double before = k > 0 ? rows[k - 1][1] : rows[k][1];
      const double speed_before = k > 0 ? rows[k - 1][2] : 0.0;
      EXPECT_NEAR(rows[k][2], (rows[k][1] - before) / 0.012, 1e-10);
      EXPECT_NEAR(rows[k][3], (rows[k][2] - speed_before) / 0.012, 1e-8);
      EXPECT_NEAR(rows[k][4], rows[k][0] <= 4.0 ? 0.5 : 0.5 + 4.5 * (rows[k][0] - 4.0) / 16.0, 1e-12);
    }
  }
}

TEST_F(Dataset, ThreadsDoNotMatter) {
  ASSERT_EQ(run("dataset small.yaml --out one --threads 1").status, 0);
  ASSERT_EQ(run("dataset small.yaml --out four --threads 4").status, 0);
  EXPECT_EQ(contents(scratch / "one"), contents(scratch / "four"));
  EXPECT_EQ(contents(scratch / "one-truth"), contents(scratch / "four-truth"));
  EXPECT_EQ(contents(scratch / "one").size(), 8u + 8u + 6u);  // with report, datapackage and list of files
}

TEST_F(Dataset, ARunThatFailsIs70AndTheOthersAreThere) {
  write_text(scratch / "fall.yaml",
             "schema: mckibben-campaign/1\nrig: {muscle: {stop_stiffness: 1e5 N/m},"
             " effects: {residual_law: {terms: [{of: m g, coefficient: -400 N}]}}}\n"
             "loads: [45 kg, 11.138 kg]\n"
             "currents: [{duration: 1 s, current: {kind: step_current, moves: []}}]\n");
  const auto said = run("dataset fall.yaml");
  EXPECT_EQ(said.status, 70);
  EXPECT_TRUE(holds(said.out, "m1_c01: "));
  const auto dataset = input::read_dataset(scratch / "out/fall");
  ASSERT_EQ(dataset.runs.size(), 1u);
  EXPECT_EQ(dataset.runs[0].id, "m2_c01");
}

TEST_F(Dataset, BadInputAndBadPlaces) {
  write_text(scratch / "bad.yaml", std::string(small_campaign) + "loads: [1 kg]\n");
  EXPECT_EQ(run("dataset bad.yaml").status, 65);
  EXPECT_EQ(run("dataset nowhere.yaml").status, 66);
  EXPECT_FALSE(exists("out"));
  write_text(scratch / "file", "mine");
  EXPECT_EQ(run("dataset small.yaml --out file").status, 74);
  EXPECT_EQ(run("dataset small.yaml --out file/below").status, 74);
  EXPECT_EQ(read_text(scratch / "file"), "mine");
  EXPECT_EQ(run("check small.yaml").out, "small.yaml: ok\n");
}

}  // namespace
}  // namespace mckibben::cli
