// The verb diagnose: what it refuses, and that it then leaves nothing behind.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "program.hpp"

namespace mckibben::cli {
namespace {

TEST(Diagnose, RefusesWhatIsNotADataSet) {
  const Scratch scratch;
  const std::string bad = MCKIBBEN_SOURCE_DIR "/tests/bad/";
  for (const std::string name : {"dataset_gap", "dataset_nan", "dataset_current_range", "dataset_no_runs"}) {
    const Said said = mckibben("diagnose " + bad + name + ".yaml --out found", scratch);
    EXPECT_EQ(said.status, 65) << name;
    EXPECT_NE(said.err.find(": error: "), std::string::npos) << said.err;
    EXPECT_EQ(said.out, "");
  }
  EXPECT_EQ(mckibben("diagnose nowhere", scratch).status, 66);
  EXPECT_EQ(mckibben("diagnose", scratch).status, 64);
  EXPECT_EQ(mckibben("diagnose nowhere --seed 0x1", scratch).status, 64);
  EXPECT_FALSE(std::filesystem::exists(scratch / "found"));
}

/// One still run of half a second.
std::string still() {
  std::string table = "time_s,current_mA,contraction_ratio\n";
  for (int k = 0; k < 40; ++k) table += std::to_string(0.012 * k) + ",4,0.01\n";
  return table;
}

TEST(Diagnose, WritesOverNothingThatItDidNotMake) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "data");
  write_text(scratch / "data/r01.csv", still());
  const std::string data_set =
      "schema: mckibben-dataset/1\nruns:\n  - {id: r01, file: r01.csv, load: 11.138 kg}\n";
  write_text(scratch / "data/dataset.yaml", data_set);
  EXPECT_EQ(mckibben("diagnose data --out data", scratch).status, 74);
  const Said plan = mckibben("diagnose data --plan data/dataset.yaml", scratch);
  EXPECT_EQ(plan.status, 74);
  EXPECT_NE(plan.err.find("not an earlier plan"), std::string::npos) << plan.err;
  EXPECT_EQ(read_text(scratch / "data/dataset.yaml"), data_set);
  // A pipe that nobody writes to would be read for ever.
  const Said pipe = shell("mkfifo p; \"$M\" diagnose data --plan p", scratch);
  EXPECT_EQ(pipe.status, 74);
  EXPECT_NE(pipe.err.find("not an earlier plan"), std::string::npos) << pipe.err;
  EXPECT_TRUE(std::filesystem::is_fifo(scratch / "p"));
  EXPECT_EQ(mckibben("diagnose data --rig nothing_like_it", scratch).status, 66);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace mckibben::cli
