// The verb calibrate from end to end: a campaign simulated, calibrated, its files; and data that are too few.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

TEST(Calibrate, TurnsADataSetIntoAFileForControllersAndFigures) {
  const Scratch scratch;
  write_text(scratch / "small.yaml", campaign_of_sines());
  ASSERT_EQ(mckibben("dataset small.yaml --out data", scratch).status, 0);
  const Said said = mckibben("calibrate data --out cal --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const std::filesystem::path folder = scratch / "cal";
  const auto document = input::Json::parse(said.out);
  EXPECT_EQ(document.at("schema"), "mckibben-calibration-report/1");
  EXPECT_EQ(document.at("loads_kg").size(), 4u);
  EXPECT_EQ(said.out, read_text(folder / "calibration.json"));
  EXPECT_TRUE(holds(read_text(folder / "report.txt"), "spread (standard deviation over mean)"));
  for (const char* place : {"report.txt", "calibration.yaml", "calibration.json"}) {
    const std::string text = read_text(folder / place);
    EXPECT_TRUE(holds(text, "the thesis reports below 10 % (T 5)")) << place;
    EXPECT_TRUE(holds(text, "pressure in relaxation: ")) << place;
  }
  for (int figure = 2; figure <= 49; ++figure) {
    const std::string name = fmt::format("figures/figure_4_{:02}", figure);
    EXPECT_TRUE(std::filesystem::exists(folder / (name + ".csv"))) << name;
    EXPECT_EQ(read_text(folder / (name + ".svg")).rfind("<svg", 0), 0u) << name;
  }
  const Said checked = mckibben("check cal/calibration.yaml", scratch);
  EXPECT_EQ(checked.status, 0) << checked.err;

  const Said kgf = mckibben("calibrate data --out kgf --kgf", scratch);
  ASSERT_EQ(kgf.status, 0);
  EXPECT_TRUE(
      holds(kgf.err,
            "next: mckibben map kgf/calibration.yaml\n"
            "or of a scenario: controllers: [{kind: feedforward_pid, calibration: kgf/calibration.yaml}]\n"));
  EXPECT_EQ(read_text(scratch / "kgf" / "calibration.yaml"), read_text(folder / "calibration.yaml"));
  EXPECT_TRUE(holds(read_text(scratch / "kgf" / "figures/figure_4_35.csv"), "kgf_per_m2"));
}

TEST(Calibrate, WarnsOfFitsThatCannotBeUsed) {
  const Scratch scratch;
  write_text(scratch / "noisy.yaml", campaign_of_sines() + "noise: {encoder_jitter: 5e-3}\n");
  ASSERT_EQ(mckibben("dataset noisy.yaml --out data", scratch).status, 0);
  const Said said = mckibben("calibrate data --out cal", scratch);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "mckibben: warning: friction in relaxation is not usable"));
  EXPECT_TRUE(holds(said.out, "not usable (above 100 %)"));
  const auto document = input::Json::parse(read_text(scratch / "cal" / "calibration.json"));
  EXPECT_GT(document.at("friction").at("relaxation").at("spread").get<double>(), 1.0);
}

TEST(Calibrate, RefusesAValveThatSetsAFlowBeforeAllElse) {
  const Scratch scratch;
  write_text(scratch / "small.yaml", campaign_of_sines());
  ASSERT_EQ(mckibben("dataset small.yaml --out data", scratch).status, 0);
  write_text(scratch / "data/dataset.yaml",
             read_text(scratch / "data/dataset.yaml") +
                 "columns: {current: {column: current_mA, unit: mA, factor: 0.001}}\n");
  write_text(scratch / "shut.yaml", "schema: mckibben-rig/1\nvalve: {kind: on_off}\n");
  const Said said = mckibben("calibrate data --rig shut.yaml", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "the rig's valve is on_off, which sets a flow"));
  EXPECT_TRUE(lacks(said.err, "amperes")) << "found by simulating all runs";
}

TEST(Calibrate, SaysAllThatIsWrongAtOnce) {
  const Scratch scratch;
  write_text(scratch / "small.yaml", campaign_of_sines());
  ASSERT_EQ(mckibben("dataset small.yaml --out data", scratch).status, 0);
  write_text(scratch / "longer.yaml", "schema: mckibben-rig/1\nmuscle: {rest_length: 311 mm}\n");
  const Said runs = mckibben("calibrate data --pressure gauge --rig longer.yaml", scratch);
  EXPECT_EQ(runs.status, 65);
  EXPECT_TRUE(holds(runs.err, "all runs: contraction ratios are no multiples of this rig's encoder count"));
  EXPECT_TRUE(holds(runs.err, "all runs: no column muscle_pressure_bar"));

  const std::string good = read_text(scratch / "data/dataset.yaml");
  write_text(scratch / "data/dataset.yaml",
             good + "columns: {current: {column: current_mA, unit: mA, factor: 0.001}}\n");
  EXPECT_TRUE(holds(mckibben("check data", scratch).err, "this looks like amperes, not mA"));
  EXPECT_TRUE(holds(mckibben("calibrate data", scratch).err, "this looks like amperes, not mA"));

  write_text(scratch / "data/dataset.yaml", good + "speed: 3\n");
  write_text(scratch / "bad.yaml", "schema: mckibben-rig/1\nmuscle: {rest_length: 9 kg, radius: 6 mm}\n");
  const Said files = mckibben("calibrate data --rig bad.yaml", scratch);
  EXPECT_EQ(files.status, 65);
  for (const char* part :
       {"data/dataset.yaml:", "unknown key speed", "bad.yaml:2:23: error: rest_length = 9 kg",
        "bad.yaml:2:29: error: unknown key radius"})
    EXPECT_TRUE(holds(files.err, part)) << files.err;
  const Said missing = mckibben("replay nowhere --rig bad.yaml", scratch);
  EXPECT_TRUE(holds(missing.err, "nowhere: error: nowhere: cannot be opened"));
  EXPECT_TRUE(holds(missing.err, "bad.yaml:2:29: error: unknown key radius"));
}

TEST(Calibrate, RefusesTooFewLoadsAndSaysWhatHelps) {
  const Scratch scratch;
  write_text(scratch / "small.yaml", campaign_of_sines("[11.138 kg, 14 kg]"));
  ASSERT_EQ(mckibben("dataset small.yaml --out data", scratch).status, 0);
  const Said said = mckibben("calibrate data --out cal", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err,
                    "calibrate needs 4 loads and, with each, 3 speeds of the current. There are 2 loads "
                    "(11.138, 14 kg). Measure more loads, or set --load-order 1\n"));
  EXPECT_TRUE(lacks(said.err, "warning")) << "said before anything is simulated";
  EXPECT_FALSE(std::filesystem::exists(scratch / "cal"));
  EXPECT_EQ(mckibben("calibrate data --out cal --load-order 1", scratch).status, 0);
  const std::string data_set = read_text(scratch / "data" / "dataset.yaml");
  EXPECT_EQ(mckibben("calibrate data --out data --load-order 1", scratch).status, 74);  // would replace it
  EXPECT_EQ(read_text(scratch / "data" / "dataset.yaml"), data_set);
  EXPECT_EQ(mckibben("calibrate data --pressure truth", scratch).status, 64);
  EXPECT_EQ(mckibben("calibrate nowhere", scratch).status, 66);
}

}  // namespace
}  // namespace mckibben::cli
