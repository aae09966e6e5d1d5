// The verb map from end to end: a campaign, its calibration, its maps; and loads that cannot be mapped.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"
#include "words_fit.hpp"

namespace mckibben::cli {
namespace {

class Map : public InAFolder {
 protected:
  void SetUp() override {
    write_text(scratch / "small.yaml", campaign_of_sines());
    ASSERT_EQ(mckibben("dataset small.yaml --out data", scratch).status, 0);
    ASSERT_EQ(mckibben("calibrate data --out cal", scratch).status, 0);
  }
  Said run(const std::string& arguments) {
    return mckibben("map cal/calibration.yaml " + arguments, scratch);
  }
};

TEST_F(Map, CoversTargetsAndDrawsThem) {
  const Said said = run("--load '14 kg' --load 18.87kg --ratios 12 --speeds 3 --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const std::filesystem::path folder = scratch / "out" / "cal-map";
  const auto document = input::Json::parse(said.out);
  EXPECT_EQ(said.out, read_text(folder / "map.json"));
  EXPECT_EQ(document.at("schema"), "mckibben-map/1");
  EXPECT_EQ(document.at("target_ratios").size(), 12u);
  ASSERT_EQ(document.at("loads").size(), 2u);
  for (const auto& load : document.at("loads")) {
    EXPECT_LT(std::abs(load.at("weighing_error").get<double>()), 0.15);  // T 5
    ASSERT_EQ(load.at("branches").size(), 2u);
    for (const auto& branch : load.at("branches")) {
      const auto &within = branch.at("within_reach"), &beyond = branch.at("beyond_reach");
      EXPECT_EQ(within.at("targets").get<int>() + beyond.at("targets").get<int>(), 36);
      // T 5: errors are large where the speed cannot be reached.
      EXPECT_GT(beyond.at("speed_rms_per_s").get<double>(), within.at("speed_rms_per_s").get<double>());
    }
  }
  const std::string csv = read_text(folder / "map.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2 * 36);
  EXPECT_TRUE(holds(read_text(folder / "table.txt"), "18.87"));
  for (const char* name : {"map_14kg.svg", "map_18.87kg.svg"}) {
    const std::string svg = read_text(folder / name);
    EXPECT_EQ(svg.rfind("<svg", 0), 0u) << name;
    EXPECT_TRUE(holds(svg, "class='border'")) << name;
    EXPECT_TRUE(lacks(svg, "nan")) << name;
  }
}

TEST_F(Map, ThePictureOfOneBranchHoldsItsWords) {
  ASSERT_EQ(run("--load '14 kg' --ratios 3 --speeds 2 --up --out up").status, 0);
  EXPECT_TRUE(words_fit(read_text(scratch / "up" / "map_14kg.svg")));
}

TEST_F(Map, ARigWithATubeIsCalibratedAndMappedWithIt) {
  const std::string rig =
      "schema: mckibben-rig/1\nbase: thesis\neffects: {bladder_elasticity: {variant: saturating, force: 80 "
      "N, "
      "ratio: 0.02}}\n";
  write_text(scratch / "tube.yaml", rig);
  write_text(scratch / "small.yaml", campaign_of_sines() + "rig: tube.yaml\n");
  const Said made = mckibben("dataset small.yaml --out with", scratch);
  ASSERT_EQ(made.status, 0) << made.err;
  const Said said = mckibben("calibrate with --rig tube.yaml --out of_tube", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(read_text(scratch / "of_tube/calibration.yaml"), "tube_pull:"));
  const Said other = mckibben("map of_tube/calibration.yaml --ratios 1 --speeds 1", scratch);
  EXPECT_EQ(other.status, 65);
  EXPECT_TRUE(holds(other.err, "the rig file of its data has a bladder_elasticity, and this rig has none"))
      << other.err;
  const Said mapped = mckibben(
      "map of_tube/calibration.yaml --rig tube.yaml --load '14 kg' --ratios 2 --speeds 1 --json", scratch);
  ASSERT_EQ(mapped.status, 0) << mapped.err;
  const auto load = input::Json::parse(mapped.out).at("loads")[0];
  EXPECT_LT(std::abs(load.at("weighing_error").get<double>()), 0.15);
}

TEST_F(Map, OneBranchAloneAndOneTarget) {
  const Said said = run("--load '14 kg' --down --ratios 1 --speeds 1 --fastest '0.1 1/s' --out one");
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string csv = read_text(scratch / "one" / "map.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
  EXPECT_TRUE(holds(csv, "\n14,", ",down,"));
}

TEST_F(Map, LoadsBeyondTheCalibrationOnlyWhenAskedFor) {
  const Said refused = run("--load '8.87 kg'");
  EXPECT_EQ(refused.status, 65);
  EXPECT_TRUE(holds(refused.err, "11.138 to 23.406 kg", "8.87 kg lies outside", "--extrapolate-load"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));

  const Said allowed = run("--load '8.87 kg' --ratios 4 --speeds 2 --extrapolate-load");
  EXPECT_EQ(allowed.status, 0) << allowed.err;
  EXPECT_TRUE(holds(allowed.out, "8.87 kg: extrapolated"));

  const Said usual = run("--ratios 2 --speeds 1 --out usual");
  EXPECT_EQ(usual.status, 0) << usual.err;
  EXPECT_TRUE(holds(usual.err, "8.87 kg"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "usual" / "map_8.87kg.svg"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "usual" / "map_23.406kg.svg"));
}

TEST_F(Map, CalibrationForOtherLoadsIsMappedAtItsOwn) {
  std::string text = read_text(scratch / "cal/calibration.yaml");
  for (const auto& [was, is] : {std::pair{"lowest_load: 11.138 kg", "lowest_load: 12 kg"},
                                std::pair{"highest_load: 23.406 kg", "highest_load: 13 kg"}}) {
    ASSERT_TRUE(holds(text, was));
    text.replace(text.find(was), std::string(was).size(), is);
  }
  write_text(scratch / "other.yaml", text);
  const Said said = mckibben("map other.yaml --up --ratios 1 --speeds 1 --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(lacks(said.err, "8.87"));
  std::vector<double> loads_kg;
  const auto document = input::Json::parse(said.out);
  for (const auto& load : document.at("loads")) loads_kg.push_back(load.at("load_kg").get<double>());
  EXPECT_EQ(loads_kg, (std::vector<double>{12.0, 12.5, 13.0}));
}

TEST_F(Map, BadInput) {
  EXPECT_TRUE(holds(mckibben("map --help", scratch).out, "Example"));
  for (const char* arguments : {"--load '0 kg'", "--load '-3 kg'", "--load 16", "--load '16 m'",
                                "--load '501 kg'", "--ratios 0", "--fastest '0 1/s'", "--fastest '1 m'"}) {
    const Said said = run(arguments);
    EXPECT_EQ(said.status, 64) << arguments << said.err;
    EXPECT_NE(said.err, "") << arguments;
  }
  EXPECT_TRUE(holds(run("--load '0 kg'").err, "above 0 and at most 500 kg"));
  EXPECT_EQ(mckibben("map nowhere.yaml", scratch).status, 66);
  EXPECT_EQ(mckibben("map small.yaml", scratch).status, 65);
  const std::string before = read_text(scratch / "cal" / "calibration.yaml");
  EXPECT_EQ(run("--load '14 kg' --out cal").status, 74);  // would replace what is read
  EXPECT_EQ(read_text(scratch / "cal" / "calibration.yaml"), before);
  const Said heavy = run("--load '14 kg' --load '120 kg' --extrapolate-load --ratios 2 --speeds 1");
  EXPECT_EQ(heavy.status, 70);
  EXPECT_TRUE(holds(heavy.out, "120 kg: no map: weighing"));
}

}  // namespace
}  // namespace mckibben::cli
