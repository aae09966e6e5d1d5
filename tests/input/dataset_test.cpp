// Tables and data sets that are fine: columns in any order, quotes, line ends, byte order mark, gauges.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <sim/input/csv.hpp>
#include <sim/input/dataset.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view required[] = {"time_s", "current_mA"};
constexpr std::string_view optional[] = {"gauge"};

TEST(Csv, AnyOrderExtraColumnsQuotesCrlfAndByteOrderMark) {
  const Source source("a.csv",
                      "\xEF\xBB\xBF\"note\",current_mA, \"time_s\"\r\n"
                      "\"a, \"\"b\"\"\",4, 0 \r\n"
                      ",4.5,0.012\r\n",
                      "");
  Problems problems;
  TableProblems found(source, problems);
  const Table table = read_table(source, required, optional, found);
  check_ticks(table, 0.012, found);
  EXPECT_EQ(found.count(), 0u);
  EXPECT_EQ(table.find("current_mA")->values, (std::vector<double>{4.0, 4.5}));
  EXPECT_EQ(table.find("gauge"), nullptr);
  EXPECT_EQ(table.place(source, *table.find("time_s"), 1).column, 6u);
}

TEST(Csv, TimesWithinAMicrosecondAreTicks) {
  const Source source("a.csv", "time_s,current_mA\n0,4\n0.0120009,4\n0.0239992,4\n", "");
  Problems problems;
  TableProblems found(source, problems);
  check_ticks(read_table(source, required, optional, found), 0.012, found);
  EXPECT_EQ(found.count(), 0u);
}

TEST(Csv, RangeIsCheckedRowByRow) {
  const Source source("a.csv", "time_s,current_mA\n0,4\n0.012,21\n", "");
  Problems problems;
  TableProblems found(source, problems);
  const Table table = read_table(source, required, optional, found);
  check_range(table, *table.find("current_mA"), 0.0, 20.0, "DAC", found);
  ASSERT_EQ(problems.errors(), 1u);
  EXPECT_EQ(problems.sorted()[0].place.line, 3u);
  EXPECT_EQ(problems.sorted()[0].place.column, 7u);
}

/// A folder of its own, removed at the end.
class DatasetFolder : public testing::Test {
 protected:
  DatasetFolder()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("mckibben_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~DatasetFolder() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  fs::path folder_;
};

TEST_F(DatasetFolder, RunsWithAndWithoutGauge) {
  write("dataset.yaml",
        "schema: mckibben-dataset/1\nrig: my_rig.yaml\nruns:\n"
        "  - {id: r01, file: one.csv, load: 11.138 kg}\n  - {id: r02, file: two.csv, load: 5000 g}\n");
  write("my_rig.yaml", "schema: mckibben-rig/1\ndac: {largest_current: 25 mA}\n");
  write("one.csv", "contraction_ratio,time_s,current_mA\n0.001,0,4\n0.002,0.012,24\n");
  write("two.csv", "time_s,current_mA,contraction_ratio,muscle_pressure_bar\n0,4,0,0.5\n");
  for (const fs::path& path : {folder_, folder_ / "dataset.yaml"}) {
    const Dataset dataset = read_dataset(path);
    EXPECT_EQ(dataset.rig.dac.largest_current_mA, 25.0);
    ASSERT_EQ(dataset.runs.size(), 2u);
    EXPECT_EQ(dataset.runs[0].current_mA, (std::vector<double>{4.0, 24.0}));
    EXPECT_EQ(dataset.runs[0].contraction_ratio, (std::vector<double>{0.001, 0.002}));
    EXPECT_FALSE(dataset.runs[0].muscle_pressure_Pa);
    EXPECT_EQ(dataset.runs[1].load_kg, 5.0);
    EXPECT_EQ(dataset.runs[1].muscle_pressure_Pa.value(), (std::vector<double>{50000.0}));
  }
}

TEST_F(DatasetFolder, MissingFilesAreMissingInput) {
  EXPECT_THROW(read_dataset(folder_), MissingInput);
  EXPECT_THROW(read_dataset(folder_ / "other.yaml"), MissingInput);
}

TEST_F(DatasetFolder, ProblemsOfAllTablesAtOnce) {
  write("dataset.yaml",
        "schema: mckibben-dataset/1\nruns:\n"
        "  - {id: r01, file: one.csv, load: 1 kg}\n  - {id: r02, file: two.csv, load: 1 kg}\n");
  write("one.csv", "time_s,current_mA,contraction_ratio\n0,x,0\n");
  write("two.csv", "time_s,current_mA,contraction_ratio\n0,4,y\n");
  try {
    read_dataset(folder_);
    FAIL();
  } catch (const BadInput& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_TRUE(error.problems()[0].file.ends_with("one.csv"));
    EXPECT_TRUE(error.problems()[1].file.ends_with("two.csv"));
  }
}

}  // namespace
}  // namespace mckibben::input
