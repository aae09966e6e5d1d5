// The verb diagnose: what it refuses, and that it then leaves nothing behind; data with a clock of their own.
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

TEST(Diagnose, RefusesWhatIsNotADataSet) {
  const Scratch scratch;
  const std::string bad = MCKIBBEN_SOURCE_DIR "/tests/bad/";
  for (const std::string name : {"dataset_gap", "dataset_nan", "dataset_current_range", "dataset_no_runs"}) {
    const Said said = mckibben("diagnose " + bad + name + ".yaml --out found", scratch);
    EXPECT_EQ(said.status, 65) << name;
    EXPECT_TRUE(holds(said.err, ": error: "));
    EXPECT_EQ(said.out, "");
  }
  EXPECT_EQ(mckibben("diagnose nowhere", scratch).status, 66);
  EXPECT_EQ(mckibben("diagnose", scratch).status, 64);
  EXPECT_EQ(mckibben("diagnose nowhere --seed 0x1", scratch).status, 64);
  EXPECT_FALSE(std::filesystem::exists(scratch / "found"));
}

/// One run of half a second.
std::string rise() {
  std::string table = "time_s,current_mA,contraction_ratio\n";
  for (int k = 0; k < 40; ++k)
    table += fmt::format("{:.3f},{:.1f},{:.4f}\n", 0.012 * k, 4 + 0.2 * k, 0.002 * k);
  return table;
}

TEST(Diagnose, WritesOverNothingThatItDidNotMake) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "data");
  write_text(scratch / "data/r01.csv", rise());
  const std::string data_set =
      "schema: mckibben-dataset/1\nruns:\n  - {id: r01, file: r01.csv, load: 11.138 kg}\n";
  write_text(scratch / "data/dataset.yaml", data_set);
  EXPECT_EQ(mckibben("diagnose data --out data", scratch).status, 74);
  const Said plan = mckibben("diagnose data --plan data/dataset.yaml", scratch);
  EXPECT_EQ(plan.status, 74);
  EXPECT_TRUE(holds(plan.err, "not an earlier plan"));
  EXPECT_EQ(read_text(scratch / "data/dataset.yaml"), data_set);
  // A pipe that nobody writes to would be read for ever.
  const Said pipe = shell("mkfifo p; \"$M\" diagnose data --plan p", scratch);
  EXPECT_EQ(pipe.status, 74);
  EXPECT_TRUE(holds(pipe.err, "not an earlier plan"));
  EXPECT_TRUE(std::filesystem::is_fifo(scratch / "p"));
  EXPECT_EQ(mckibben("diagnose data --rig nothing_like_it", scratch).status, 66);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

/// One recorded run counts as one, though its parts are predicted from each other; two count as two.
TEST(Diagnose, OfTooFewRunsRulesNoEffectOutAndPlansWhatTheVerdictAsksFor) {
  const Scratch scratch;
  const auto sine = [](const char* period) {
    return fmt::format(
        "  - {{name: p{0}, duration: 4.8 s, current: {{kind: sine_current, low: 0 mA, high: 20 mA, period: "
        "2.{0} s}}}}\n",
        period);
  };
  const std::string one =
      "schema: mckibben-campaign/1\nrig: thesis\nloads: [11.138 kg]\ncurrents:\n" + sine("4");
  write_text(scratch / "one.yaml", one);
  write_text(scratch / "two.yaml", one + sine("9"));
  for (const std::string runs : {"one", "two"}) {
    ASSERT_EQ(mckibben("dataset " + runs + ".yaml --out " + runs, scratch).status, 0);
    const Said said = mckibben("diagnose " + runs + " --plan plan.yaml", scratch);
    ASSERT_EQ(said.status, 0) << said.err;
    const std::string help = "at least four runs would help, with two loads and two kinds of current.";
    EXPECT_TRUE(holds(said.out, "cannot_tell: These data do not decide", help));
    EXPECT_TRUE(holds(said.err, "no plan written. These data do not decide: " + help));
    EXPECT_TRUE(holds(said.out, runs == "one" ? ": 1 run in 4 parts, " : ": 2 runs, "));
    EXPECT_FALSE(std::filesystem::exists(scratch / "plan.yaml"));
  }
}

/// Stamps of its own, jittered, in ms; a pressure up and down.
std::string given_pressure(int run) {
  std::string table = "t,p,x\n";
  for (int k = 0; k < 400; ++k)
    table += std::to_string(5.0 * k + (k * 37 % 11) * 0.1) + ',' +
             std::to_string(2.0 - (1.0 + 0.2 * run) * std::cos(0.03 * k)) + ",0\n";
  return table;
}

TEST(Diagnose, TakesAGivenPressureAndALaser) {
  const Scratch scratch;
  std::string runs;
  for (int run = 0; run < 3; ++run) {
    const std::string id = "r" + std::to_string(run);
    write_text(scratch / (id + ".csv"), given_pressure(run));
    runs += "  - {id: " + id + ", file: " + id + ".csv, load: " + std::to_string(9 + 3 * run) + " kg}\n";
  }
  const std::string columns =
      "columns:\n  time: {column: t, unit: ms}\n  muscle_pressure: {column: p, unit: bar, as: input}\n"
      "  contraction: {column: x, unit: mm";
  const std::string heading = "schema: mckibben-dataset/1\nrig: thesis\n" + columns;
  write_text(scratch / "dataset.yaml", heading + "}\nruns:\n" + runs);
  const Said simulated = mckibben("replay dataset.yaml --out truth", scratch);
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  for (int run = 0; run < 3; ++run) {  // what it did is what the laser saw
    const std::string file = "r" + std::to_string(run) + ".csv";
    std::istringstream is(read_text(scratch / ("truth/" + file))), was(read_text(scratch / file));
    std::string row, table, line;
    std::getline(is, row);
    std::getline(was, line);
    table = line + '\n';
    for (int k = 0; std::getline(is, row) && std::getline(was, line); ++k) {
      const double ratio = std::stod(row.substr(row.find(',') + 1)) + 1e-4 * ((k * 61 % 17) / 8.0 - 1.0);
      table += line.substr(0, line.rfind(',')) + ',' + std::to_string(412.5 - 300.0 * ratio) + '\n';
    }
    write_text(scratch / file, table);
  }
  write_text(scratch / "dataset.yaml",
             heading + ", zero: 412.5, factor: -1}\nstart: moving\nskip: 0.1 s\nruns:\n" + runs);
  const Said checked = mckibben("check dataset.yaml", scratch);
  EXPECT_EQ(checked.status, 0) << checked.err;
  const Said said = mckibben("diagnose dataset.yaml --out found", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const auto document = input::Json::parse(read_text(scratch / "found/diagnosis.json"));
  EXPECT_EQ(document.at("verdict"), "nothing_missing") << document.at("because");
  EXPECT_EQ(document.at("rows").at("stamps"), 1200);
  EXPECT_FALSE(document.at("recalibrated").contains("valve_conductance"));
  EXPECT_TRUE(holds(document.at("warnings").dump(), "out of sight"));
  for (const auto& one : document.at("ranking")) EXPECT_NE(one.at("name"), "muscle_leak");
  EXPECT_TRUE(holds(read_text(scratch / "found/report.html"), "out of sight"));
}

TEST(Diagnose, SaysWhereAWrongLoadIsWrittenBeforeAReplay) {
  const Scratch scratch;
  write_text(
      scratch / "c.yaml",
      "schema: mckibben-campaign/1\nrig: thesis\nloads: [11.138 kg, 16.138 kg, 23.406 kg]\ncurrents:\n"
      "  - {name: a, duration: 3 s, current: {kind: triangle_current, low: 6 mA, high: 14 mA, period: 3 s}}\n"
      "  - {name: b, duration: 3 s, current: {kind: sine_current, low: 6 mA, high: 14 mA, period: 1.5 s}}\n"
      "noise: {encoder_jitter: 5e-5}\n");
  ASSERT_EQ(mckibben("dataset c.yaml", scratch).status, 0);
  std::string written = read_text(scratch / "out/c/dataset.yaml");
  written.replace(written.find("load: 16.138", written.find("m2_b")), 12, "load: 13.138");
  write_text(scratch / "out/c/dataset.yaml", written);
  const Said said = mckibben("diagnose out/c", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string next = said.err.substr(said.err.find("next: "));
  EXPECT_TRUE(holds(next, "next: write in out/c/dataset.yaml load: 16.1",
                    " kg in line 15, then mckibben replay out/c "))
      << next;
  EXPECT_TRUE(
      holds(read_text(scratch / "out/c-diagnose/report.html"), "\"name\":\"corrected\"", "kg as written)"));
}

}  // namespace
}  // namespace mckibben::cli
