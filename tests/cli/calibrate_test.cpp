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

TEST(Calibrate, RefusesTooFewLoadsAndSaysWhatHelps) {
  const Scratch scratch;
  write_text(scratch / "small.yaml", campaign_of_sines("[11.138 kg, 14 kg]"));
  ASSERT_EQ(mckibben("dataset small.yaml --out data", scratch).status, 0);
  const Said said = mckibben("calibrate data --out cal", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "needs 4 loads, and there are 2"));
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
