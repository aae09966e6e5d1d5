// Tables that are larger than what is kept: every n-th row, at its own time and place.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/thinned.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::input {
namespace {

class ThinnedTable : public ::testing::Test {
 protected:
  static constexpr int rows = 4'100'000, bad_row = 2'999'999;  // in line 3 000 001

  void write(const char* bad) const {
    std::string text = "t,p,x\n";
    for (int k = 0; k < rows; ++k) text += fmt::format("{},{},2\n", k, k == bad_row ? bad : "1.5");
    place_.write("r.csv", text);
  }
  std::string read(const std::string& columns, const std::string& more) {
    place_.write(
        "dataset.yaml",
        "schema: mckibben-dataset/1\nrig: thesis\n" + more + "columns: {" + columns +
            "muscle_pressure: {column: p, unit: bar, as: input}, contraction: {column: x, unit: mm}}\n"
            "runs: [{id: r, file: r.csv, load: 5 kg}]\n");
    try {
      data_ = read_dataset(place_);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "";
  }

  Scratch place_;
  Dataset data_;
};

constexpr const char* by_stamps = "time: {column: t, unit: ms}, ";

TEST_F(ThinnedTable, StampsStayThose) {
  write("1.5");
  EXPECT_EQ(read(by_stamps, ""), "");
  const auto& time_s = data_.runs.at(0).measured->time_s;
  EXPECT_LT(time_s.size(), 1'000'000u);
  EXPECT_GT(time_s.size(), 800'000u);
  EXPECT_NEAR(time_s.back() - time_s[time_s.size() - 2], 0.005, 1e-9);
  EXPECT_NEAR(time_s.back(), 1e-3 * rows, 0.005);
  ASSERT_EQ(data_.remarks.size(), 1u);
  EXPECT_TRUE(
      holds(data_.remarks[0],
            "4100001 lines, with those of the other files, are more than are read at once: 1 in 5 is"));
  EXPECT_EQ(data_.inputs.back().sha256, Source::load(place_ / "r.csv", 1U << 30U).sha256());
  EXPECT_TRUE(holds(read("rows_are_ticks: true, ", ""), "put each run into a file of its own"));
  EXPECT_EQ(load_thinned(place_ / "dataset.yaml"), std::nullopt);
}

TEST_F(ThinnedTable, FilesShareWhatIsRead) {
  std::string text = "t,p,x\n", runs;
  for (int k = 0; k < rows / 4; ++k) text += fmt::format("{},1.5,2\n", k);
  for (const char* name : {"a", "b", "c", "d"}) {
    place_.write(fmt::format("{}.csv", name), text);
    runs += fmt::format("  - {{id: {0}, file: {0}.csv, load: 5 kg}}\n", name);
  }
  place_.write("dataset.yaml",
               std::string("schema: mckibben-dataset/1\nrig: thesis\ncolumns: {") + by_stamps +
                   "muscle_pressure: {column: p, unit: bar, as: input}, contraction: {column: x, unit: "
                   "mm}}\nruns:\n" +
                   runs);
  data_ = read_dataset(place_);
  std::size_t kept = 0;
  for (const auto& run : data_.runs) kept += run.measured->time_s.size();
  EXPECT_LT(kept, 1'020'000u);
  EXPECT_GT(kept, 700'000u);
  EXPECT_NEAR(data_.runs[3].measured->time_s.back(), 1e-3 * rows / 4, 0.006);
  ASSERT_EQ(data_.remarks.size(), 1u);
  EXPECT_TRUE(holds(data_.remarks[0], "a.csv:2:1: 1025001 lines, with those of the other files",
                    "likewise in 3 other places"));
}

TEST_F(ThinnedTable, SensorsThatTakeTurnsAreBothRead) {
  std::string text = "t,sensor,value\n";
  for (int k = 0; k < rows; ++k)
    text += fmt::format("{},{},{}\n", k / 6, k % 6 == 0 ? "p" : "x", k % 6 == 0 ? "1.5" : "2");
  place_.write("r.csv", text);
  place_.write("dataset.yaml",
               "schema: mckibben-dataset/1\nrig: thesis\ncolumns: {time: {column: t, unit: ms}, "
               "muscle_pressure: {column: value, unit: bar, as: input, where: {sensor: p}}, contraction: "
               "{column: value, unit: mm, where: {sensor: x}}}\nruns: [{id: r, file: r.csv, load: 5 kg}]\n");
  data_ = read_dataset(place_);
  EXPECT_NEAR(data_.runs[0].measured->time_s.back(), 1e-3 * rows / 6, 0.1);
}

TEST_F(ThinnedTable, PlacesAreThoseOfTheFile) {
  write("oops");
  EXPECT_TRUE(holds(read(by_stamps, ""), "r.csv:3000001:", "oops"));
}

}  // namespace
}  // namespace mckibben::input
