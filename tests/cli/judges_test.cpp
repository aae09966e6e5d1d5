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
  std::vector<const char*> words{};
  bool refused = false;
  bool stamps = false;  ///< a clock of its own and a given pressure, not rows each tick with a gauge
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
    {.name = "nothing_in_ticks"},
    {.name = "nothing_with_stamps", .stamps = true},
    {.name = "a_dead_reading",
     .words = {"run m2", "contraction never moves", "columns: {contraction:"},
     .stamps = true,
     .row = dead},
    {.name = "a_dead_reading_in_ticks", .words = {"run m2", "contraction never moves"}, .row = dead},
    {.name = "no_reading_at_all",
     .words = {"contraction never moves", "columns: {contraction:"},
     .stamps = true,
     .row = all_dead,
     .unusable = true},
    {.name = "swings_when_it_should_rest",
     .words = {"still moves at", "a longer settling_time of the rig, or start: moving"},
     .stamps = true,
     .row = from_two_bar,
     .rig = "settling_time: 0.036 s\n"},
    {.name = "one_file_under_two_names",
     .words = {"holds the same rows as run m1", "name its own file"},
     .stamps = true,
     .loads_kg = {11.138, 11.138, 23.406},
     .files = {1, 1, 3}},
    {.name = "one_file_under_two_loads",
     .words = {"holds the same rows as run m1, under another load"},
     .files = {1, 1, 3}},
    {.name = "loads_a_tenth",
     .words = {"like a tenth of what hung", "load: 11.138 kg"},
     .refused = true,
     .stamps = true,
     .loads_kg = {1.1138, 1.6138, 2.3406}},
    {.name = "loads_a_thousandth",
     .words = {"kg that are written in g", "load: 11.138 kg"},
     .refused = true,
     .loads_kg = {0.011138, 0.016138, 0.023406}},
    {.name = "one_load_a_tenth",
     .words = {"is a point misplaced? m2 (1.6138 kg)", "write load: 16.138 kg"},
     .stamps = true,
     .loads_kg = {11.138, 1.6138, 23.406}},
    {.name = "loads_in_pounds",
     .words = {"pounds, not kg: write lb"},
     .refused = true,
     .loads_kg = {24.555, 35.578, 51.601}},
    {.name = "loads_exchanged",
     .words = {"write load: 11.138 kg for m1"},
     .stamps = true,
     .loads_kg = {23.406, 16.138, 11.138}},
    {.name = "a_given_pressure_in_psi",
     .words = {"as psi it would be", "unit: psi, as: input"},
     .refused = true,
     .stamps = true,
     .row = in_psi},
    {.name = "a_gauge_in_psi",
     .words = {"this looks like psi, not bar", "unit: psi, factor: 1}"},
     .refused = true,
     .row = in_psi},
    {.name = "an_absolute_given_pressure",
     .words = {"is it absolute?", "zero: 1.01325"},
     .stamps = true,
     .row = absolute_from_rest},
    {.name = "an_absolute_given_pressure_that_never_falls",
     .words = {"never comes below 1.", "is it absolute, or the muscle weaker", "zero: 1.01325"},
     .stamps = true,
     .row = absolute},
    {.name = "an_absolute_gauge",
     .words = {"one atmosphere too high", "zero: 1.01"},
     .refused = true,
     .row = absolute},
    {.name = "stamps_a_thousandth",
     .words = {"is its time in s, not in ms?", "unit: s, factor: 1}"},
     .refused = true,
     .stamps = true,
     .time_unit = "ms"},
    {.name = "stamps_thousandfold",
     .words = {"is its time in ms, not in s?", "unit: ms, factor: 1}"},
     .stamps = true,
     .row = times(1000.0),
     .most_rows = 60},
    {.name = "ticks_a_thousandth", .words = {"factor: 1000}"}, .refused = true, .row = times(0.001)},
    {.name = "ticks_thousandfold",
     .words = {"this looks like ms, not s", "unit: ms, factor: 1}"},
     .refused = true,
     .row = times(1000.0)},
    {.name = "half_a_millisecond",
     .words = {"lasts 0.49 ms"},
     .refused = true,
     .stamps = true,
     .row = times(0.01 / 12.0),
     .most_rows = 50},
    {.name = "a_gap",
     .words = {"no rows from 0.588 s to 1.2 s", "to: 0.588 s or from: 1.2 s"},
     .stamps = true,
     .gap = 50},
    {.name = "a_gap_in_ticks",
     .words = {"comes after a gap", "to: 0.588 s", "from: 1.2 s"},
     .refused = true,
     .gap = 50},
    {.name = "counts_halved",
     .words = {"0.50 times what pressure and load say", "factor: 2"},
     .stamps = true,
     .row = reads_half},
    {.name = "counts_halved_in_ticks",
     .words = {"0.50 times what pressure and load say", "factor: 2"},
     .row = reads_half},
    {.name = "a_coarse_grid", .words = {"is in steps", "resolution: 3 mm"}, .stamps = true, .row = coarse},
    {.name = "the_other_sign",
     .words = {"its sign is the other one", "factor: -1"},
     .refused = true,
     .stamps = true,
     .row = falls},
    {.name = "the_other_sign_in_ticks", .words = {"factor: -1"}, .refused = true, .row = falls},
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
    // What a diagnosis estimates itself, it tells at its end: of one that was cut, what was guessed before.
    for (const char* words : GetParam().words) EXPECT_TRUE(holds(before + said.out, words));
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
