// Tables and data sets that are fine: columns in any order, quotes, line ends, byte order mark, gauges.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/readers.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view both_columns[] = {"time_s", "current_mA"};
constexpr std::string_view optional[] = {"gauge"};

TEST(Csv, AnyOrderExtraColumnsQuotesCrlfAndByteOrderMark) {
  const Source source("a.csv",
                      "\xEF\xBB\xBF\"note\",current_mA, \"time_s\"\r\n"
                      "\"a, \"\"b\"\"\",4, 0 \r\n"
                      ",4.5,0.012\r\n",
                      "");
  Problems problems;
  TableProblems found(source, problems);
  const Table table = read_table(source, both_columns, optional, found);
  check_ticks(table, 0.012, found);
  EXPECT_EQ(found.count(), 0u);
  EXPECT_EQ(table.find("current_mA")->values, (std::vector<double>{4.0, 4.5}));
  EXPECT_EQ(table.find("gauge"), nullptr);
  EXPECT_EQ(table.place(source, *table.find("time_s"), 1).column, 6u);
}

TEST(Csv, SemicolonsTabsAndDecimalCommasAreRead) {
  for (const char* text : {"time_s;current_mA;\"a; b, c\"\n0;4;x\n0,012;4,5;\n",
                           "time_s\tcurrent_mA\tp [bar, gauge]\n0\t4\tx\n0.012\t4.5\t\n"}) {
    const Source source("a.csv", text, "");
    Problems problems;
    TableProblems found(source, problems);
    const Table table = read_table(source, both_columns, optional, found);
    check_ticks(table, 0.012, found);
    EXPECT_EQ(found.count(), 0u) << text;
    ASSERT_NE(table.find("current_mA"), nullptr);
    EXPECT_EQ(table.find("current_mA")->values, (std::vector<double>{4.0, 4.5}));
    EXPECT_EQ(table.place(source, *table.find("current_mA"), 1).column, 7u);
  }
}

/// What is said of a CSV file whose decimal signs or columns are not what they should be.
std::string said_of(const char* text) {
  const Source source("a.csv", text, "");
  Problems problems;
  {
    TableProblems found(source, problems);
    read_table(source, both_columns, optional, found);
  }
  return to_text(problems.sorted());
}

TEST(Csv, DecimalSignsThatCannotBeAreSaid) {
  EXPECT_TRUE(holds(said_of("time_s,current_mA\n0,012,4,5\n"),
                    "this row has 4 cells; the header has 2; with decimal "
                    "commas columns must stand between semicolons or tabs"));
  EXPECT_TRUE(holds(said_of("time_s;current_mA\n0,012;4.5\n"), "the decimal sign of this file is a comma"));
}

TEST(Csv, TimesWithinAMicrosecondAreTicks) {
  const Source source("a.csv", "time_s,current_mA\n0,4\n0.0120009,4\n0.0239992,4\n", "");
  Problems problems;
  TableProblems found(source, problems);
  check_ticks(read_table(source, both_columns, optional, found), 0.012, found);
  EXPECT_EQ(found.count(), 0u);
}

TEST(Csv, RangeIsCheckedRowByRow) {
  const Source source("a.csv", "time_s,current_mA\n0,4\n0.012,21\n", "");
  Problems problems;
  TableProblems found(source, problems);
  const Table table = read_table(source, both_columns, optional, found);
  check_range(table, *table.find("current_mA"), 0.0, 20.0, "DAC", found);
  ASSERT_EQ(problems.errors(), 1u);
  EXPECT_EQ(problems.sorted()[0].place.line, 3u);
  EXPECT_EQ(problems.sorted()[0].place.column, 7u);
}

constexpr const char* good_lvm =
    "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\nX_Columns\tMulti\n"
    "***End_of_Header***\t\n\t\n"
    "Channels\t2\nX_Dimension\tTime\tTime\nX0\t0,0\t0,0\n***Start_Special***\nx\n***End_Special***\n"
    "***End_of_Header***\t\t\nX_Value\tI\tX_Value\tratio\tComment\n"
    "0,0\t4\t0,0\t0,1\n0,012\t4,5\t0,012\t0,1\tso\n\n"
    "Channels\t2\nX0\t0,0\t0,0\n***End_of_Header***\nX_Value\tI\tX_Value\tratio\n0,024\t4\t0,024\t0,1\n";
constexpr const char* good_ascii = "# made by hand\n0 4 0.1\n 0.012 ; 4.5\t0.2\n0.024 4 0.1 \n\n";

/// Reads a text as a run; the problems, and whether the table is sound: rows in step, numbers finite.
std::pair<std::size_t, bool> read_as_run(const std::string& text, bool lvm) {
  const Source source(lvm ? "a.lvm" : "a.txt", text, "");
  Problems problems;
  TableProblems found(source, problems);
  const std::vector<WantedColumn> channels{
      {"time_s", ""}, {"current_mA", "I"}, {"contraction_ratio", "ratio"}};
  const std::vector<WantedColumn> numbers{{"time_s", "1"}, {"current_mA", "2"}, {"contraction_ratio", "3"}};
  const Table table = lvm ? read_lvm(source, channels, 0, found) : read_text(source, numbers, found);
  check_ticks(table, 0.012, found);
  bool sound = !table.columns.empty();
  for (const auto& column : table.columns)
    sound =
        sound && column.values.size() == table.lines.size() &&
        std::all_of(column.values.begin(), column.values.end(), [](double x) { return std::isfinite(x); });
  return {found.count(), sound};
}

TEST(Tables, MutilatedOnesAreReadWholeOrRefused) {
  std::mt19937 random(1);
  const char* pieces[] = {
      "\t", ",", ";", "\n", "Channels\t", "***End_of_Header***", "LabVIEW Measurement\n", "\"", "-", "1e999"};
  for (const bool lvm : {true, false}) {
    const std::string good = lvm ? good_lvm : good_ascii;
    EXPECT_EQ(read_as_run(good, lvm), (std::pair<std::size_t, bool>{0, true}));
    std::size_t refused = 0;
    for (int n = 0; n < 1500; ++n) {
      std::string text = good;
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random() % 128);
          break;
        case 1:
          text.erase(at, random() % 20);
          break;
        case 2:
          text.insert(at, pieces[random() % std::size(pieces)]);
          break;
        default:
          text.resize(at);
      }
      const auto [problems, sound] = read_as_run(text, lvm);
      EXPECT_TRUE(problems > 0 || sound) << text;
      refused += problems > 0 ? 1 : 0;
    }
    EXPECT_GT(refused, 500u);
  }
}

TEST(Tables, AnLvmWhoseLastRowIsCutOffIsReadWithoutIt) {
  const std::string good = good_lvm;
  EXPECT_EQ(read_as_run(good.substr(0, good.rfind('\t')) + "\n\n", true),
            (std::pair<std::size_t, bool>{0, true}));
  std::string inside = good;
  inside.erase(inside.find("\t0,1\n"), 4);
  EXPECT_GT(read_as_run(inside, true).first, 0U) << "not the last";
}

class DatasetFolder : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }

  Scratch folder_;
};

TEST_F(DatasetFolder, RunsWithAndWithoutGauge) {
  write("dataset.yaml",
        "schema: mckibben-dataset/1\nrig: my_rig.yaml\nruns:\n"
        "  - {id: r01, file: one.csv, load: 11.138 kg}\n  - {id: r02, file: two.csv, load: 5000 g}\n");
  write("my_rig.yaml", "schema: mckibben-rig/1\ndac: {largest_command: 25 mA}\n");
  write("one.csv", "contraction_ratio,time_s,current_mA\n0.001,0,4\n0.002,0.012,24\n");
  write("two.csv", "time_s,current_mA,contraction_ratio,muscle_pressure_bar\n0,4,0,0.5\n");
  for (const fs::path& path : {fs::path(folder_), folder_ / "dataset.yaml"}) {
    const Dataset dataset = read_dataset(path);
    EXPECT_EQ(dataset.rig.dac.largest_command, 25.0);
    ASSERT_EQ(dataset.runs.size(), 2u);
    EXPECT_EQ(dataset.runs[0].current_mA, (std::vector<double>{4.0, 24.0}));
    EXPECT_EQ(dataset.runs[0].judged().values, (std::vector<double>{0.001, 0.002}));
    EXPECT_EQ(dataset.runs[0].find("muscle_pressure"), nullptr);
    EXPECT_EQ(dataset.runs[1].load_kg, 5.0);
    EXPECT_EQ(dataset.runs[1].find("muscle_pressure")->values, (std::vector<double>{50000.0}));
  }
}

TEST_F(DatasetFolder, MissingFilesAreMissingInput) {
  EXPECT_THROW(read_dataset(folder_), MissingInput);
  EXPECT_THROW(read_dataset(folder_ / "other.yaml"), MissingInput);
}

TEST_F(DatasetFolder, AKeyOfTheWholeDataSetIsSentToTheTop) {
  write("dataset.yaml",
        "schema: mckibben-dataset/1\nruns:\n"
        "  - {id: r01, file: one.csv, load: 1 kg, start: moving, kilo: 1}\n");
  write("one.csv", "time_s,current_mA,contraction_ratio\n0,4,0\n");
  try {
    read_dataset(folder_);
    FAIL();
  } catch (const BadInput& error) {
    const std::string said = error.what();
    EXPECT_TRUE(said.find("unknown key start (allowed: id, ") != std::string::npos) << said;
    EXPECT_TRUE(said.find("; start goes at the top of the file, not here") != std::string::npos) << said;
    EXPECT_TRUE(said.find("kilo goes") == std::string::npos) << said;
  }
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

TEST(Dataset, ADutyThatOnlyFillsIsNotedBesideOneThatIsNotRead) {
  const Scratch scratch;
  const auto remarks = [&](const char* ports, const std::string& called, int least) {
    std::string rows = "t_s," + called + ",duty_vent,x_mm\n";
    for (int k = 0; k < 40; ++k)
      rows += std::to_string(0.01 * k) + ',' + std::to_string(k < 20 ? 50 : least) + ",0,1\n";
    scratch.write("a.csv", rows);
    scratch.write("dataset.yaml",
                  std::string("schema: mckibben-dataset/1\nrig: {valve: {kind: on_off, ports: ") + ports +
                      ", zero_command: 0 V, span_command: 10 V}}\ncolumns:\n  time: {column: t_s, unit: s}\n"
                      "  command: {column: " +
                      called +
                      ", unit: V, zero: -100, factor: 0.05}\n"
                      "  contraction: {column: x_mm, unit: mm}\nruns: [{id: a, file: a.csv, load: 5 kg}]\n");
    const auto all = read_dataset(scratch / "dataset.yaml").remarks;
    return all.empty() ? "" : all.front();
  };
  EXPECT_TRUE(holds(remarks("2/2", "duty_fill", 0),
                    "a.csv:2:1: duty_fill never vents, and duty_vent is not read",
                    "one column duty of both, duty_fill less duty_vent"));
  EXPECT_EQ(remarks("2/2", "duty_fill", -30), "") << "it vents";
  EXPECT_EQ(remarks("2/2", "u", 0), "") << "no duty";
  EXPECT_EQ(remarks("3/2", "duty_fill", 0), "") << "one valve";
}

}  // namespace
}  // namespace mckibben::input
