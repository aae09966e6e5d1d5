// Tables in which rows are not simply those of one run: long ones, and several runs in one, told apart by
// words, numbers or marks. What `import` writes of them is what the reader then gets right.
#include <cmath>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/output/recognised.hpp>
#include <sim/recognise/recognise.hpp>

#include "scratch.hpp"

namespace mckibben::output {
namespace {

constexpr int rows_of_a_run = 60;

double rise(int k) {
  return 0.5 - 0.5 * std::cos(0.07 * k);
}
double pressure_of(int run, int k) {
  return 0.4 + 2.5 * rise(k) + 0.01 * run;
}

/// A table: `line(run, k)` is one or two lines of row k of a run.
struct Layout {
  const char *name, *heading;
  int runs;
  std::function<std::string(int run, int k)> line;
  const char* load = "FILL_IN";  ///< of the last run
  bool stacked = false;          ///< what `line` writes in two lines stands in two halves
};

std::string plain(int run, int k, const std::string& label, double begin_s = 0.0) {
  return fmt::format("{},{:.3f},{:.4f},{:.3f}\n", label, begin_s + 0.02 * k, pressure_of(run, k),
                     25 * rise(k));
}
std::string turned(int run, int k, const char* pressure, const char* rise_name, double later_s = 0.0) {
  return fmt::format("{0:.3f},{1},{2:.4f}\n{3:.3f},{4},{5:.3f}\n", 0.02 * k, pressure, pressure_of(run, k),
                     0.02 * k + later_s, rise_name, 25 * rise(k));
}

const Layout layouts[] = {
    {"one_reading_a_row", "t_s,signal,value\n", 1,
     [](int run, int k) { return turned(run, k, "pressure_bar", "laser_mm"); }},
    {"readings_at_times_of_their_own", "t_s,channel,value\n", 1,
     [](int run, int k) { return turned(run, k, "p_bar", "x_mm", 0.007); }},
    {"one_reading_below_the_other", "t_s,variable,value\n", 1,
     [](int run, int k) { return turned(run, k, "p_bar", "x_mm"); }, "FILL_IN", true},
    {"as_a_database_writes_it", ",result,table,_time,_value,_field,_measurement\n", 1,
     [](int run, int k) {
       const auto line = [&](int table, const char* field, double value) {
         return fmt::format(",_result,{},2024-05-03T14:22:{:06.3f}Z,{:.4f},{},rig\n", table, 0.02 * k, value,
                            field);
       };
       return line(0, "pressure_bar", pressure_of(run, k)) + line(1, "position_mm", 25 * rise(k));
     },
     "FILL_IN", true},
    {"a_clock_that_begins_again_in_a_long_table", "t_s,signal,value\n", 2,
     [](int run, int k) { return turned(run, k, "p_bar", "x_mm"); }},
    {"a_run_in_words", "trial,t_s,p_bar,x_mm\n", 3,
     [](int run, int k) { return plain(run, k, fmt::format("{}kg_a", 5 + run), 2.0 * run); }, "7 kg"},
    {"a_column_of_masses", "load_kg,t_s,p_bar,x_mm\n", 3,
     [](int run, int k) { return plain(run, k, fmt::format("{}", 5 + 2.5 * run), 2.0 * run); }, "10 kg"},
    {"masses_and_trials", "mass [kg],trial,t_s,p_bar,x_mm\n", 4,
     [](int run, int k) { return plain(run, k, fmt::format("{},{}", 5 + run / 2, 1 + run % 2)); }, "6 kg"},
    {"blocks_of_words", "muscle,t_s,p_bar,x_mm\n", 2,
     [](int run, int k) { return plain(run, k, run == 0 ? "A" : "B", 2.0 * run); }},
    {"a_mark_in_the_first_row", "cycle_start,t_s,p_bar,x_mm\n", 3,
     [](int run, int k) { return plain(run, k, k == 0 ? "1" : "0", 2.0 * run); }},
    {"a_number_that_comes_again", "cycle,t_s,p_bar,x_mm\n", 4,
     [](int run, int k) { return plain(run, k, fmt::format("{}", 1 + run % 2), 2.0 * run); }},
    {"phases_are_not_runs", "phase,t_s,p_bar,x_mm\n", 1,
     [](int run, int k) { return plain(run, k, (k / 15) % 2 == 0 ? "fill" : "vent"); }},
    {"a_trigger_is_no_run", "trigger,t_s,p_bar,x_mm\n", 1,
     [](int run, int k) { return plain(run, k, k % 10 == 0 ? "1" : "0"); }},
    {"notes_are_no_runs", "comment,t_s,p_bar,x_mm\n", 1,
     [](int run, int k) { return plain(run, k, k == 0 ? "begin" : ""); }},
};

std::string table_of(const Layout& layout) {
  std::string text = layout.heading, below;
  for (int run = 0; run < layout.runs; ++run)
    for (int k = 0; k < rows_of_a_run; ++k) {
      const std::string lines = layout.line(run, k);
      const std::size_t first = layout.stacked ? lines.find('\n') + 1 : lines.size();
      text += lines.substr(0, first);
      below += lines.substr(first);
    }
  return text + below;
}

class Layouts : public ::testing::TestWithParam<Layout> {};

TEST_P(Layouts, ImportWritesWhatReadsRight) {
  const Layout& layout = GetParam();
  const Scratch folder;
  folder.write("all.csv", table_of(layout));
  folder.write("rig.yaml", "schema: mckibben-rig/1\nbase: festo_dmsp_10\ntick: 20 ms\n");
  const recognise::Recognised found = recognise::recognise({folder / "all.csv"}, true);
  std::string dataset = dataset_yaml(found, std::filesystem::path(folder), "rig.yaml");
  ASSERT_EQ(found.runs.size(), static_cast<std::size_t>(layout.runs)) << dataset;
  EXPECT_EQ(found.runs.back().load->value, layout.load) << dataset;
  dataset = std::regex_replace(dataset, std::regex("load: FILL_IN"), "load: 5 kg");
  if (dataset.find("start:") == std::string::npos) dataset += "start: settled\n";
  folder.write("dataset.yaml", dataset);
  const input::Dataset data = input::read_dataset(folder);
  for (int run = 0; run < layout.runs; ++run) {
    const domain::Measurement& measured = *data.runs[static_cast<std::size_t>(run)].measured;
    const std::vector<double>& pressure_Pa = measured.given("muscle_pressure");
    int k = 0;
    for (std::size_t row = 0; row < measured.time_s.size(); ++row) {
      const double at_s = measured.time_s[row] - measured.time_s[0];
      if (std::abs(at_s - 0.02 * k) > 1e-6) continue;  // a stamp of the other reading
      EXPECT_NEAR(pressure_Pa[row], 1e5 * pressure_of(run, k), 10.0) << run << ' ' << k << '\n' << dataset;
      ++k;
    }
    EXPECT_EQ(k, rows_of_a_run) << dataset;
    const std::vector<double>& ratio = measured.read("contraction");
    EXPECT_EQ(std::ranges::count_if(ratio, [](double one) { return !std::isnan(one); }),
              measured.time_s.size() > rows_of_a_run ? rows_of_a_run - 1 : rows_of_a_run);
  }
}
INSTANTIATE_TEST_SUITE_P(Each, Layouts, ::testing::ValuesIn(layouts),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(ImportLayouts, SensorsOfUnknownKindAreAsked) {
  const Scratch folder;
  std::string text = "t_s,sensor,value\n";
  for (int k = 0; k < 60; ++k) text += turned(0, k, "0", "1");
  folder.write("all.csv", text);
  const recognise::Recognised found = recognise::recognise({folder / "all.csv"}, true);
  const std::string dataset = dataset_yaml(found, std::filesystem::path(folder), "rig.yaml");
  EXPECT_NE(dataset.find("contraction: {column: value, unit: FILL_IN, where: {sensor: FILL_IN}"),
            std::string::npos)
      << dataset;
  EXPECT_NE(dataset.find("perhaps one of: where: {sensor: 0}"), std::string::npos) << dataset;
}

TEST(ImportLayouts, RowsWithoutWhatDrivesAreCutOffOrBridged) {
  const Scratch folder;
  std::string text = "t_s,p_bar,x_mm\n";
  for (int k = 0; k < 60; ++k)
    text += fmt::format(
        "{:.3f},{},{:.3f}\n", 0.02 * k,
        k < 3 || (k > 20 && k < 40) || k == 59 ? "" : fmt::format("{:.4f}", pressure_of(0, k)), 25 * rise(k));
  folder.write("5kg.csv", text);
  folder.write("rig.yaml", "schema: mckibben-rig/1\nbase: festo_dmsp_10\ntick: 20 ms\n");
  const recognise::Recognised found = recognise::recognise({folder / "5kg.csv"}, true);
  const std::string dataset = dataset_yaml(found, std::filesystem::path(folder), "rig.yaml");
  EXPECT_NE(dataset.find("    from: 0.06 s\n    to: 1.16 s\n"), std::string::npos) << dataset;
  folder.write("dataset.yaml", std::regex_replace(dataset, std::regex("zero: FILL_IN"), "zero: 0"));
  EXPECT_EQ(input::read_dataset(folder).runs[0].measured->time_s.size(), 56u) << dataset;
}

}  // namespace
}  // namespace mckibben::output
