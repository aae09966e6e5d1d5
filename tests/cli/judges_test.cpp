// What cannot be in measured data: `check`, `replay` and `diagnose` say it in the same words, with the line
// to write, and `diagnose` before it fits anything.
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/domain/number.hpp>

#include "program.hpp"

namespace mckibben::cli::judges {
namespace {

constexpr const char* base =
    "schema: mckibben-campaign/1\nrig: {gauge: {fitted: true}}\nloads: [11.138 kg, 16.138 kg, 23.406 kg]\n"
    "currents: [{duration: 2.4 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}]\n"
    "noise: {encoder_jitter: 1e-4, gauge: 4 mbar}\n";

struct Row {
  double time_s, current_mA, ratio, pressure_bar;
};

/// How a sound data set is spoilt, and what is said of it.
struct Spoilt {
  const char* name;
  std::vector<const char*> words;
  bool refused;
  bool stamps;  ///< a clock of its own and a given pressure, not rows each tick with a gauge
  std::function<void(Row&, int run, std::size_t row)> row = [](Row&, int, std::size_t) {};
  std::vector<double> loads_kg{11.138, 16.138, 23.406};
  const char* time_unit = "s";
  std::vector<int> files{1, 2, 3};
  std::size_t most_rows = 1000, gap = 0;
  bool unusable = false;  ///< diagnose alone refuses
  const char* rig = "";   ///< a line of its file
};

const auto reads_half = [](Row& row, int, std::size_t) { row.ratio *= 0.5; };
const auto in_psi = [](Row& row, int, std::size_t) { row.pressure_bar *= 14.503774; };
const auto falls = [](Row& row, int, std::size_t) { row.ratio *= -1.0; };
const auto dead = [](Row& row, int run, std::size_t) { row.ratio = run == 2 ? 0.05 : row.ratio; };
const auto all_dead = [](Row& row, int, std::size_t) { row.ratio = 0.05; };
const auto from_two_bar = [](Row& row, int, std::size_t) { row.pressure_bar += 2.0; };
const auto coarse = [](Row& row, int, std::size_t) { row.ratio = std::round(row.ratio * 100.0) / 100.0; };
const auto absolute = [](Row& row, int, std::size_t) { row.pressure_bar += 1.01325; };
const auto absolute_from_rest = [](Row& row, int, std::size_t) { row.pressure_bar += 1.01325 - 0.5; };
const auto times = [](double factor) {
  return [factor](Row& row, int, std::size_t) { row.time_s *= factor; };
};

const Spoilt spoilt[] = {
    {"nothing_in_ticks", {}, false, false},
    {"nothing_with_stamps", {}, false, true},
    {"a_dead_reading", {"run m2", "contraction never moves", "columns: {contraction:"}, false, true, dead},
    {"a_dead_reading_in_ticks", {"run m2", "contraction never moves"}, false, false, dead},
    {"no_reading_at_all",
     {"contraction never moves", "columns: {contraction:"},
     false,
     true,
     all_dead,
     {11.138, 16.138, 23.406},
     "s",
     {1, 2, 3},
     1000,
     0,
     true},
    {"swings_when_it_should_rest",
     {"still moves at", "a longer settling_time of the rig, or start: moving"},
     false,
     true,
     from_two_bar,
     {11.138, 16.138, 23.406},
     "s",
     {1, 2, 3},
     1000,
     0,
     false,
     "settling_time: 0.036 s\n"},
    {"one_file_under_two_names",
     {"holds the same rows as run m1", "name its own file"},
     false,
     true,
     {},
     {11.138, 11.138, 23.406},
     "s",
     {1, 1, 3}},
    {"one_file_under_two_loads",
     {"holds the same rows as run m1, under another load"},
     false,
     false,
     {},
     {11.138, 16.138, 23.406},
     "s",
     {1, 1, 3}},
    {"loads_a_tenth",
     {"like a tenth of what hung", "load: 11.138 kg"},
     true,
     true,
     {},
     {1.1138, 1.6138, 2.3406}},
    {"loads_a_thousandth",
     {"kg that are written in g", "load: 11.138 kg"},
     true,
     false,
     {},
     {0.011138, 0.016138, 0.023406}},
    {"one_load_a_tenth",
     {"is a point misplaced? m2 (1.6138 kg)", "write load: 16.138 kg"},
     false,
     true,
     {},
     {11.138, 1.6138, 23.406}},
    {"loads_in_pounds", {"pounds, not kg: write lb"}, true, false, {}, {24.555, 35.578, 51.601}},
    {"loads_exchanged", {"write load: 11.138 kg for m1"}, false, true, {}, {23.406, 16.138, 11.138}},
    {"a_given_pressure_in_psi", {"as psi it would be", "unit: psi, as: input"}, true, true, in_psi},
    {"a_gauge_in_psi", {"this looks like psi, not bar", "unit: psi, factor: 1}"}, true, false, in_psi},
    {"an_absolute_given_pressure", {"is it absolute?", "zero: 1.01325"}, false, true, absolute_from_rest},
    {"an_absolute_given_pressure_that_never_falls",
     {"never comes below 1.", "is it absolute, or the muscle weaker", "zero: 1.01325"},
     false,
     true,
     absolute},
    {"an_absolute_gauge", {"one atmosphere too high", "zero: 1.01"}, true, false, absolute},
    {"stamps_a_thousandth",
     {"is its time in s, not in ms?", "unit: s, factor: 1}"},
     true,
     true,
     {},
     {11.138, 16.138, 23.406},
     "ms"},
    {"stamps_thousandfold",
     {"is its time in ms, not in s?", "unit: ms, factor: 1}"},
     false,
     true,
     times(1000.0),
     {11.138, 16.138, 23.406},
     "s",
     {1, 2, 3},
     60},
    {"ticks_a_thousandth", {"factor: 1000}"}, true, false, times(0.001)},
    {"ticks_thousandfold", {"this looks like ms, not s", "unit: ms, factor: 1}"}, true, false, times(1000.0)},
    {"half_a_millisecond",
     {"lasts 0.49 ms"},
     true,
     true,
     times(0.01 / 12.0),
     {11.138, 16.138, 23.406},
     "s",
     {1, 2, 3},
     50},
    {"a_gap",
     {"no rows from 0.588 s to 1.2 s", "to: 0.588 s or from: 1.2 s"},
     false,
     true,
     {},
     {11.138, 16.138, 23.406},
     "s",
     {1, 2, 3},
     1000,
     50},
    {"a_gap_in_ticks",
     {"comes after a gap", "to: 0.588 s", "from: 1.2 s"},
     true,
     false,
     {},
     {11.138, 16.138, 23.406},
     "s",
     {1, 2, 3},
     1000,
     50},
    {"counts_halved", {"0.50 times what pressure and load say", "factor: 2"}, false, true, reads_half},
    {"counts_halved_in_ticks",
     {"0.50 times what pressure and load say", "factor: 2"},
     false,
     false,
     reads_half},
    {"a_coarse_grid", {"is in steps", "resolution: 3 mm"}, false, true, coarse},
    {"the_other_sign", {"its sign is the other one", "factor: -1"}, true, true, falls},
    {"the_other_sign_in_ticks", {"factor: -1"}, true, false, falls},
};

class Judges : public InAFolder, public testing::WithParamInterface<Spoilt> {
 protected:
  void SetUp() override {
    write_text(scratch / "base.yaml", base);
    ASSERT_EQ(run("dataset base.yaml --out sound").status, 0);
    std::filesystem::create_directory(scratch / "d");
    std::string rig = read_text(scratch / "sound/rig.yaml");
    if (const std::size_t at = rig.find("settling_time"); at != std::string::npos && *GetParam().rig != 0)
      rig.erase(at, rig.find('\n', at) + 1 - at);
    write_text(scratch / "d/rig.yaml", rig + GetParam().rig);
    std::string runs;
    for (int i = 1; i <= 3; ++i) {
      write_run(i);
      const auto at = static_cast<std::size_t>(i - 1);
      runs += fmt::format("  - {{id: m{}, file: m{}.csv, load: {} kg}}\n", i, GetParam().files[at],
                          domain::write_number(GetParam().loads_kg[at]));
    }
    const std::string columns = fmt::format(
        "start: settled\ncolumns:\n  time: {{column: t, unit: {}}}\n  muscle_pressure: {{column: "
        "muscle_pressure_bar, unit: bar, as: input}}\n  contraction: {{column: contraction_ratio, unit: "
        "1}}\n",
        GetParam().time_unit);
    write_text(scratch / "d/dataset.yaml", "schema: mckibben-dataset/1\nrig: rig.yaml\n" +
                                               (GetParam().stamps ? columns : "") + "runs:\n" + runs);
  }

  void write_run(int i) {
    std::istringstream lines(read_text(scratch / fmt::format("sound/m{}_c01.csv", i)));
    std::string line, text;
    std::getline(lines, line);
    text = (GetParam().stamps ? "t" + line.substr(line.find(',')) : line) + "\n";
    for (std::size_t k = 0; std::getline(lines, line) && k < GetParam().most_rows; ++k) {
      Row row{};
      char comma = 0;
      std::istringstream(line) >> row.time_s >> comma >> row.current_mA >> comma >> row.ratio >> comma >>
          row.pressure_bar;
      if (GetParam().gap > 0 && k >= GetParam().gap && k < 2 * GetParam().gap) continue;
      if (GetParam().row) GetParam().row(row, i, k);
      text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", row.time_s, row.current_mA, row.ratio,
                          row.pressure_bar);
    }
    write_text(scratch / fmt::format("d/m{}.csv", i), text);
  }
};

TEST_P(Judges, SayTheSame) {
  for (const char* verb : {"check d", "replay d", "diagnose d --time-limit '1 ms'"}) {
    SCOPED_TRACE(verb);
    const Said said = run(verb);
    const bool diagnoses = verb[0] == 'd';
    EXPECT_EQ(said.status, GetParam().refused || (GetParam().unusable && diagnoses) ? 65 : 0) << said.err;
    if (GetParam().unusable) {
      const bool said_so = bool(holds(said.err + said.out, "no run is usable: mend what is said of each"));
      EXPECT_EQ(said_so, verb[0] != 'r') << said.err;
    }
    const std::string before = said.err.substr(0, said.err.find("trying"));
    for (const char* words : GetParam().words) EXPECT_TRUE(holds(before, words));
    if (GetParam().words.empty()) {
      EXPECT_TRUE(lacks(before, "error", "warning"));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Each, Judges, testing::ValuesIn(spoilt),
                         [](const auto& each) { return std::string(each.param.name); });

class JudgedLoads : public InAFolder {};

// By 9 kg alike: 0.4 kg move like 8 kg, which a point misplaced by one digit would do, too.
TEST_F(JudgedLoads, AZeroElsewhereIsNoMisplacedPoint) {
  std::string campaign = base;
  campaign.replace(campaign.find("11.138 kg, 16.138"), 17, "0.4 kg, 11.138");
  write_text(scratch / "base.yaml", campaign);
  ASSERT_EQ(run("dataset base.yaml --out d").status, 0);
  write_text(scratch / "d/other.yaml",
             "schema: mckibben-dataset/1\nrig: rig.yaml\nstart: settled\ncolumns:\n"
             "  time: {column: time_s, unit: s}\n"
             "  muscle_pressure: {column: muscle_pressure_bar, unit: bar, as: input}\n"
             "  contraction: {column: contraction_ratio, unit: 1, zero: 0.05}\nruns:\n"
             "  - {id: m1, file: m1_c01.csv, load: 0.4 kg}\n  - {id: m2, file: m2_c01.csv, load: 11.138 kg}\n"
             "  - {id: m3, file: m3_c01.csv, load: 23.406 kg}\n");
  const auto said = run("check d/other.yaml");
  EXPECT_TRUE(lacks(said.err, "misplaced", "write load"));
  EXPECT_TRUE(
      holds(said.err, "m1 (0.4 kg) moves like", "is the zero of contraction what it reads at rest length"));
}

}  // namespace
}  // namespace mckibben::cli::judges
