// The verb dataset from end to end: what is written and where, that an interruption leaves no trace, and that
// nothing of the user's is lost.
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/yaml_file.hpp>
#include <sim/output/campaign_folder.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

constexpr const char* small_campaign =
    "schema: mckibben-campaign/1\n"
    "rig: {gauge: {fitted: true}}\n"
    "loads: [11.138 kg, 23.406 kg]\n"
    "currents:\n"
    "  - {duration: 2.4 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}\n"
    "  - {name: up, duration: 1.2 s, current: {kind: step_current, start: 4 mA, "
    "moves: [{at: 0.3 s, to: 14 mA}]}}\n"
    "repeats: 2\n"
    "noise: {encoder_jitter: 1e-4, gauge: 4 mbar}\n";

/// Every file below a folder with its content.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).generic_string()] = read_text(entry.path());
  return files;
}

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

class Dataset : public testing::Test {
 protected:
  void SetUp() override { write_text(scratch / "small.yaml", small_campaign); }
  Said run(const std::string& arguments) { return mckibben(arguments, scratch); }
  bool exists(const std::string& name) { return fs::exists(scratch / name); }
  Scratch scratch;
};

TEST_F(Dataset, WritesMeasurementsAndApartTheTruth) {
  const auto said = run("dataset small.yaml");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("small: 2 loads x 2 currents x 2, 1200 rows, 14.4 s simulated"), std::string::npos)
      << said.out;
  EXPECT_FALSE(exists("out/small.unfinished"));
  const auto dataset = input::read_dataset(scratch / "out/small");
  ASSERT_EQ(dataset.runs.size(), 8u);
  EXPECT_EQ(dataset.runs[0].id, "m1_c01_r1");
  EXPECT_EQ(dataset.runs[7].id, "m2_up_r2");
  EXPECT_EQ(dataset.runs[7].load_kg, 23.406);
  EXPECT_EQ(dataset.runs[7].current_mA.size(), 100u);
  EXPECT_TRUE(dataset.runs[0].muscle_pressure_Pa);
  EXPECT_TRUE(dataset.rig.gauge.fitted);  // rig.yaml, because it is not the shipped rig
  EXPECT_TRUE(exists("out/small/rig.yaml"));
  for (const auto& run : dataset.runs) {
    EXPECT_EQ(read_text(scratch / "out/small-truth" / (run.id + ".csv"))
                  .rfind("time_s,current_mA,contraction_ratio,contraction_speed_per_s,valve_pressure_bar", 0),
              0u);
    EXPECT_TRUE(exists("out/small/thesis/" + run.id + ".txt"));
  }
  for (const auto& [name, text] : contents(scratch / "out/small")) {
    EXPECT_EQ(text.find("contraction_speed"), std::string::npos) << name;  // nothing true in it
    EXPECT_EQ(name.find("truth"), std::string::npos);
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
  EXPECT_EQ(document.at("input_files").at(0).at("file"), "small.yaml");
  EXPECT_GT(document.at("runs").at(0).at("solver").at("steps").get<long>(), 200);
  EXPECT_EQ(document.at("runs").at(1).at("rows"), 200);
}

TEST_F(Dataset, NamesTheShippedRigWhenItIsTheOne) {
  std::string text = small_campaign;
  text.replace(text.find("{gauge: {fitted: true}}"), 23, "thesis");
  write_text(scratch / "small.yaml", text);
  ASSERT_EQ(run("dataset small.yaml").status, 0);
  EXPECT_NE(read_text(scratch / "out/small/dataset.yaml").find("rig: thesis\n"), std::string::npos);
  EXPECT_FALSE(exists("out/small/rig.yaml"));
  EXPECT_FALSE(input::read_dataset(scratch / "out/small").runs[0].muscle_pressure_Pa);
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
      EXPECT_EQ(rows[k][1], each.contraction_ratio[k]);
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

/// Leaves OUT.unfinished as a campaign does that was stopped after `runs` runs.
void begin(const fs::path& out, const domain::Campaign& campaign, std::size_t runs,
           const std::vector<std::string>& formats = {}) {
  const output::CampaignFolder folder(out, campaign, formats, [](const std::string&) {});
  run::run_jobs(
      campaign, std::span(folder.jobs()).first(runs), 1, [&](const auto& run) { folder.put(run); },
      [](const auto&, auto, auto) {});
}

TEST_F(Dataset, AnInterruptedOneGoesOnAndItsFilesAreTheSame) {
  ASSERT_EQ(run("dataset small.yaml --out whole --format mat,netcdf").status, 0);
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 5, {"netcdf", "mat", "csv"});
  // One of them was killed before its last file; another left half a file that nobody waits for.
  fs::remove(scratch / "parts.unfinished/runs/m1_up_r2.json");
  fs::remove(scratch / "parts.unfinished/data/m1_up_r1.csv");
  write_text(scratch / "parts.unfinished/data/.mckibben-3", "time_s,curr");
  const auto finished = scratch / "parts.unfinished/data/m1_c01_r1.nc";
  const auto before = fs::last_write_time(finished);
  const auto said = run("dataset small.yaml --out parts --format mat,netcdf");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("3 of 8 runs are there already"), std::string::npos) << said.err;
  EXPECT_EQ(fs::last_write_time(scratch / "parts/m1_c01_r1.nc"), before);  // not made again
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
  EXPECT_EQ(contents(scratch / "whole-truth"), contents(scratch / "parts-truth"));
  EXPECT_FALSE(exists("parts.unfinished"));
}

TEST_F(Dataset, OtherFormatsStartAnewAndNothingIsLeftOver) {
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 5, {"mat"});
  const auto said = run("dataset small.yaml --out parts");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("starting anew"), std::string::npos) << said.err;
  for (const auto& [name, text] : contents(scratch / "parts")) EXPECT_FALSE(name.ends_with(".mat")) << name;
  EXPECT_FALSE(exists("parts.unfinished.old-1"));
}

TEST_F(Dataset, RunsThatSomebodyChangedAreMadeAgain) {
  ASSERT_EQ(run("dataset small.yaml --out whole").status, 0);
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 7);
  const auto unfinished = scratch / "parts.unfinished";
  const auto spoil = [&](const std::string& name, const std::string& old, const std::string& with) {
    std::string text = read_text(unfinished / name);
    const auto at = text.find(old);
    ASSERT_NE(at, std::string::npos) << name;
    write_text(unfinished / name, text.replace(at, old.size(), with));
  };
  spoil("data/m1_c01_r1.csv", "0.012,", "0.013,");  // same size
  spoil("truth/m1_c01_r2.csv", "\n0.024,", "\n");   // shorter
  spoil("data/thesis/m1_up_r1.txt", "4", "4.0");    // longer
  spoil("runs/m1_up_r2.json", "\"rows\": ", "\"rows\": 1");
  write_text(unfinished / "runs/m2_c01_r1.json", "{}");
  const auto untouched = fs::last_write_time(unfinished / "data/m2_c01_r2.csv");
  const auto said = run("dataset small.yaml --out parts");
  ASSERT_EQ(said.status, 0) << said.err;
  for (const char* words :
       {"2 of 8 runs are there already", "5 runs are not as written, and made again: m1_c01_r1"})
    EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
  EXPECT_EQ(fs::last_write_time(scratch / "parts/m2_c01_r2.csv"), untouched);
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
  EXPECT_EQ(contents(scratch / "whole-truth"), contents(scratch / "parts-truth"));
}

TEST_F(Dataset, ACampaignThatChangedStartsAnew) {
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 5);
  const auto said = run("dataset small.yaml --out parts --seed 9");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("starting anew"), std::string::npos) << said.err;
  ASSERT_EQ(run("dataset small.yaml --out whole --seed 9").status, 0);
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
}

TEST_F(Dataset, AnotherRecordingIsAnotherCampaign) {
  const std::string head = "time_s,current_mA\n0,4\n";
  write_text(scratch / "given.csv", head + "0.012,8\n");
  write_text(scratch / "played.yaml",
             "schema: mckibben-campaign/1\nloads: [11 kg]\n"
             "currents: [{duration: 0.1 s, current: {kind: recorded_current, file: given.csv}}]\n");
  begin(scratch / "out", input::read_campaign(scratch / "played.yaml"), 1);
  write_text(scratch / "given.csv", head + "0.012,9\n");
  ASSERT_EQ(run("dataset played.yaml --out out").status, 0);
  EXPECT_EQ(input::read_dataset(scratch / "out").runs.at(0).current_mA.at(1), 9.0);
}

TEST_F(Dataset, NothingOfTheUsersIsLost) {
  ASSERT_EQ(run("dataset small.yaml --out r").status, 0);
  write_text(scratch / "r/thesis/notes.txt", "mine");
  fs::create_directories(scratch / "r.unfinished");
  write_text(scratch / "r.unfinished/plan.json", "mine too");
  const auto said = run("dataset small.yaml --out r");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(read_text(scratch / "r.old-1/thesis/notes.txt"), "mine");
  EXPECT_EQ(read_text(scratch / "r.unfinished.old-1/plan.json"), "mine too");
  EXPECT_FALSE(exists("r/thesis/notes.txt"));
  EXPECT_FALSE(exists("r-truth.old-1"));
  ASSERT_EQ(run("dataset small.yaml --out r").status, 0);  // only ours by now: replaced
  EXPECT_FALSE(exists("r.old-2"));
}

TEST_F(Dataset, CtrlCEndsWith130AndSaysHowToGoOn) {
  std::string text = small_campaign;
  text.replace(text.find("repeats: 2"), 10, "repeats: 5000");
  write_text(scratch / "long.yaml", text);
  write_text(scratch / "stop.sh",
             "'" MCKIBBEN_PROGRAM
             "' dataset long.yaml --threads 1 > said 2> err & pid=$!\n"
             "until ls out/long.unfinished/runs/*.json || ! kill -0 $pid; do sleep 0.02; done > ls 2>&1\n"
             "kill -INT $pid; wait $pid\n");
  const std::string command = "cd '" + (scratch / "").string() + "' && sh stop.sh";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const std::string err = read_text(scratch / "err");
  EXPECT_NE(err.find("interrupted; "), std::string::npos) << err;
  EXPECT_NE(err.find("The same command goes on"), std::string::npos) << err;
  EXPECT_FALSE(exists("out/long"));
  EXPECT_TRUE(exists("out/long.unfinished/plan.json"));
}

TEST_F(Dataset, ARunThatFailsIs70AndTheOthersAreThere) {
  write_text(scratch / "fall.yaml",
             "schema: mckibben-campaign/1\nrig: {muscle: {stop_stiffness: 1e5 N/m},"
             " effects: {residual_law: {terms: [{of: m g, coefficient: -400 N}]}}}\n"
             "loads: [45 kg, 11.138 kg]\n"
             "currents: [{duration: 1 s, current: {kind: step_current, moves: []}}]\n");
  const auto said = run("dataset fall.yaml");
  EXPECT_EQ(said.status, 70);
  EXPECT_NE(said.out.find("m1_c01: "), std::string::npos) << said.out;
  const auto dataset = input::read_dataset(scratch / "out/fall");
  ASSERT_EQ(dataset.runs.size(), 1u);
  EXPECT_EQ(dataset.runs[0].id, "m2_c01");
}

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
  EXPECT_EQ(measured.angle_rad.size(), 100u);
  EXPECT_EQ(measured.sides[1].muscle_pressure_Pa.size(), 100u);
  EXPECT_TRUE(dataset.rig.effects.absent());
  EXPECT_TRUE(dataset.rig.pair()->opposite.effects.absent());
  for (const auto& [name, content] : contents(scratch / "out/pair")) {
    EXPECT_EQ(content.find("muscle_leak"), std::string::npos) << name;
    EXPECT_EQ(content.find("tension_1_N"), std::string::npos) << name;  // nothing true in it
    EXPECT_EQ(name.find("thesis"), std::string::npos);
  }
  const std::string truth = read_text(scratch / "out/pair-truth/truth.yaml");
  for (const char* words : {"muscle_leak", "damping: 40 N.s/m"})
    EXPECT_NE(truth.find(words), std::string::npos) << truth;
  EXPECT_NE(read_text(scratch / "out/pair-truth/against_r1.csv").find(",gauge_pressure_2_bar\n"),
            std::string::npos);
  EXPECT_NE(read_text(scratch / "out/pair/report.html").find("pressure asked of valve 2 in bar"),
            std::string::npos);
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

TEST_F(PairDataset, AnInterruptedOneGoesOnAndItsFilesAreTheSame) {
  ASSERT_EQ(run("dataset pair.yaml --out whole --format mat --threads 2").status, 0);
  begin(scratch / "parts", input::read_campaign(scratch / "pair.yaml"), 3, {"mat"});
  const auto said = run("dataset pair.yaml --out parts --format mat --threads 1");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("3 of 4 runs are there already"), std::string::npos) << said.err;
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
    EXPECT_NE(told.find("the cord of muscle 2 would have to push"), std::string::npos)
        << told.substr(0, 2000);
}

TEST_F(PairDataset, AStudyOfTheThesissRigRefusesIt) {
  const auto said = run("study lag pair.yaml");
  EXPECT_EQ(said.status, 65);
  EXPECT_NE(said.err.find("pair.yaml: error: study cannot take it yet: the rig's two muscles"),
            std::string::npos)
      << said.err;
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
