// Two muscles, given pressure and held length through the whole program: the trajectories of an independent
// program (tests/data/reference: fixed steps of 20 us, fourth order, same equations) replayed as
// measurements; a pair run; what is refused.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"
#include "table_of.hpp"

namespace mckibben::cli {
namespace {

using input::Json;

const std::string reference = MCKIBBEN_TEST_DATA "/reference/";

std::string first_line(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  return text.substr(0, text.find('\n'));
}

struct Columns {
  std::string names;  ///< separated by commas
  double most;
};

class Replayed : public InAFolder {
 protected:
  /// Replays runs that lie beside each other with a rig; returns the status.
  Said replay(const std::string& rig, const std::string& columns, const std::string& runs) {
    write_text(scratch / "dataset.yaml",
               "schema: mckibben-dataset/1\nrig: " + rig + "\n" + columns + "runs:\n" + runs);
    return mckibben("replay dataset.yaml --out out --threads 2", scratch);
  }
  void expect_near(const std::string& id, const std::string& name, const std::vector<Columns>& within) {
    const Table is = table_of(scratch / ("out/" + id + ".csv")), wanted = table_of(reference + name + ".csv");
    for (const auto& [names, most] : within)
      for (const std::string& column : cells_of(names)) {
        ASSERT_TRUE(is.contains(column)) << column;
        ASSERT_EQ(is.at(column).size(), wanted.at(column).size()) << column;
        double worst = 0.0;
        for (std::size_t k = 0; k < is.at(column).size(); ++k)
          worst = std::max(worst, std::abs(is.at(column)[k] - wanted.at(column)[k]));
        EXPECT_LT(worst, most) << id << " " << column;
      }
  }
  Json document() { return Json::parse(read_text(scratch / "out/run.json")); }
};

const std::string tightest = "integrator: {tolerance: 1e-12}}";
constexpr const char* bars =
    "valve_pressure_1_bar,muscle_pressure_1_bar,valve_pressure_2_bar,muscle_pressure_2_bar";

TEST_F(Replayed, PairsGoAsTheReferenceDoes) {
  std::string runs;
  const std::vector<std::string> names{"pair_opposed", "pair_steps", "pair_triangle"};
  for (const auto& name : names) runs += "  - {id: " + name + ", file: " + reference + name + ".csv}\n";
  const Said said = replay("thesis_pair", "", runs);
  ASSERT_EQ(said.status, 0) << said.err;
  for (const auto& name : names)
    expect_near(name, name,
                {{"time_s", 1e-12}, {"angle_rad", 2e-5}, {bars, 1e-4}, {"tension_1_N,tension_2_N", 0.05}});
  EXPECT_EQ(
      first_line(scratch / "out/pair_steps.csv")
          .find("time_s,current_1_mA,current_2_mA,angle_rad,angle_speed_rad_per_s,valve_pressure_1_bar,"
                "muscle_pressure_1_bar,valve_pressure_2_bar,muscle_pressure_2_bar,tension_1_N,tension_2_N,"
                "encoder_angle_rad"),
      0u);
  const Json gap = document().at("runs").at(0).at("gaps").at(0);
  EXPECT_EQ(gap.at("reading"), "angle");
  EXPECT_EQ(gap.at("unit"), "rad");
  EXPECT_LT(gap.at("largest_error").get<double>(), 2e-5);
  EXPECT_TRUE(holds(said.out, "pair_opposed  angle"));

  ASSERT_EQ(replay("{base: thesis_pair, " + tightest, "", runs).status, 0);
  for (const auto& name : names) expect_near(name, name, {{"angle_rad", 1e-7}});
}

TEST_F(Replayed, TheEncoderCountsQuarterDegrees) {
  ASSERT_EQ(replay("thesis_pair", "", "  - {id: a, file: " + reference + "pair_opposed.csv}\n").status, 0);
  const Table is = table_of(scratch / "out/a.csv");
  const double quarter_rad = 0.25 * std::acos(-1.0) / 180.0;
  for (std::size_t k = 0; k < is.at("time_s").size(); ++k)
    EXPECT_NEAR(is.at("encoder_angle_rad")[k], quarter_rad * std::floor(is.at("angle_rad")[k] / quarter_rad),
                1e-9);
}

TEST_F(Replayed, AGivenPressureLiftsTheLoadAsTheReferenceDoes) {
  const std::string columns =
      "columns: {muscle_pressure: {column: muscle_pressure_bar, unit: bar, as: input}}\n";
  const std::string runs = "  - {id: sine, file: " + reference +
                           "pressure_12.5kg_sine.csv, load: 12.5 kg}\n"
                           "  - {id: steps, file: " +
                           reference + "pressure_18.87kg_steps.csv, load: 18.87 kg}\n";
  ASSERT_EQ(replay("thesis", columns, runs).status, 0);
  const std::string head = first_line(scratch / "out/sine.csv");
  EXPECT_TRUE(lacks(head, "valve", "current", "force_N,enc"));
  expect_near("sine", "pressure_12.5kg_sine", {{"contraction_ratio", 2e-6}, {"muscle_pressure_bar", 1e-12}});
  expect_near("steps", "pressure_18.87kg_steps", {{"contraction_ratio", 2e-6}});
  ASSERT_EQ(replay("{base: thesis, " + tightest, columns, runs).status, 0);
  expect_near("sine", "pressure_12.5kg_sine", {{"contraction_ratio", 1e-8}});
  expect_near("steps", "pressure_18.87kg_steps", {{"contraction_ratio", 1e-8}});
}

TEST_F(Replayed, AHeldMuscleOnABenchPullsAsTheReferenceDoes) {
  const std::string columns =
      "columns:\n  muscle_pressure: {column: muscle_pressure_bar, unit: bar, as: input}\n"
      "  contraction: {column: contraction_ratio, unit: 1, as: input}\n  force: {column: force_N, unit: N}\n";
  const std::string runs = "  - {id: length, file: " + reference +
                           "held_length.csv}\n  - {id: moving, file: " + reference + "held_moving.csv}\n";
  for (const char* rig : {"thesis", "{base: thesis, mechanics: {kind: held_length}}"}) {
    ASSERT_EQ(replay(rig, columns, runs).status, 0);
    expect_near("length", "held_length", {{"force_N", 0.05}, {"contraction_ratio", 1e-12}});
    expect_near("moving", "held_moving", {{"force_N", 0.05}, {"contraction_ratio", 1e-12}});
  }
  const Json run = document().at("runs").at(1);
  EXPECT_EQ(run.at("gaps").size(), 1u);
  EXPECT_EQ(run.at("gaps").at(0).at("reading"), "force");
  EXPECT_GT(run.at("ledger").at("bench_work_J").get<double>(), 0.0);
  EXPECT_LT(run.at("ledger").at("unexplained_share").at("energy").get<double>(), 1e-5);
}

TEST_F(Replayed, StampsMayBeUnequalAndReadingsMissing) {
  write_text(scratch / "r.csv",
             "t,U,x,P\n0,6,0,\n12,6,,0.5\n30,9,0.1,nan\n31,9,0.2,1\n500,9,20,1.9\n2000,4,30,1.9\n");
  const std::string columns =
      "columns:\n  time: {column: t, unit: ms}\n  command: {column: U, unit: mA}\n"
      "  contraction: {column: x, unit: mm}\n  muscle_pressure: {column: P, unit: bar}\n";
  const Said said = replay("thesis", columns, "  - {id: r, file: r.csv, load: 11 kg}\n");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(table_of(scratch / "out/r.csv").at("time_s"),
            (std::vector<double>{0, 0.012, 0.03, 0.031, 0.5, 2}));
  const Json gaps = document().at("runs").at(0).at("gaps");
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps.at(0).at("rows"), 5);
  EXPECT_EQ(gaps.at(1).at("rows"), 4);
}

TEST_F(Replayed, ARunThatBeganOnItsWayIsFoundThere) {
  std::istringstream whole(read_text(reference + "pressure_12.5kg_sine.csv"));
  std::string line, cut;
  for (int row = -1; std::getline(whole, line); ++row)
    if (row < 0 || row >= 200) cut += line + '\n';  // from 2.4 s on: falling by 16 % a second
  write_text(scratch / "r.csv", cut);
  const auto largest_gap = [&](const std::string& start) {
    const std::string columns =
        start + "columns: {muscle_pressure: {column: muscle_pressure_bar, unit: bar, as: input}}\n";
    const Said said = replay("thesis", columns, "  - {id: r, file: r.csv, load: 12.5 kg}\n");
    EXPECT_EQ(said.status, 0) << said.err;
    EXPECT_EQ(table_of(scratch / "out/r.csv").at("time_s").size(), 550u);
    return document().at("runs").at(0).at("gaps").at(0).at("largest_error").get<double>();
  };
  EXPECT_LT(largest_gap("start: moving\nskip: 0.3 s\n"), 2e-5);
  EXPECT_GT(largest_gap("skip: 0.3 s\n"), 1e-3);
  EXPECT_GT(largest_gap("start: moving\n"), 2e-5);  // its threads settle first
  EXPECT_EQ(document().at("runs").at(0).at("gaps").at(0).at("rows"), 550);
}

TEST_F(Replayed, InputsHoldOrRunStraightOn) {
  write_text(scratch / "r.csv", "t,p,mA,x\n0,1,6,0\n0.5,1,6,0\n0.9,3,14,0\n1.3,3,14,0\n");
  const auto rises = [&](const std::string& hold, const std::string& input) {
    const std::string columns =
        hold + "columns: {time: {column: t, unit: s}, contraction: {column: x, unit: mm}, " + input + "}\n";
    const Said said = replay("thesis", columns, "  - {id: r, file: r.csv, load: 12 kg}\n");
    EXPECT_EQ(said.status, 0) << said.err;
    return table_of(scratch / "out/r.csv").at("contraction_ratio");
  };
  const std::string pressure = "muscle_pressure: {column: p, unit: bar, as: input}";
  const std::string current = "command: {column: mA, unit: mA}";
  const auto straight = rises("", pressure), held = rises("hold: previous\n", pressure);
  ASSERT_EQ(held.size(), 4u);
  EXPECT_EQ(rises("hold: linear\n", pressure), straight);
  EXPECT_GT(straight[2], 0.1);
  EXPECT_NEAR(held[2], held[1], 1e-4);  // until now
  EXPECT_GT(held[3], 0.1);
  const auto ramp = rises("hold: linear\n", current);
  EXPECT_EQ(rises("hold: previous\n", current), rises("", current));
  EXPECT_NEAR(rises("", current)[2], held[1], 0.1);
  EXPECT_GT(ramp[2], rises("", current)[2] + 0.02);
}

TEST_F(Replayed, VoltsAndBarDoWhatACurrentDoes) {
  write_text(scratch / "r.csv",
             "t,mA,V,kPa,x\n0,6,1.25,62.5,0\n0.1,6,1.25,62.5,0\n0.2,9,3.125,156.25,0.1\n0.9,20,10,500,5\n"
             "1.9,4,0,0,9\n");
  const auto replayed = [&](const std::string& valve, const std::string& command) {
    const std::string columns = "columns: {time: {column: t, unit: s}, command: " + command +
                                ", contraction: {column: x, unit: mm}}\n";
    return replay("{valve: " + valve + "}", columns, "  - {id: r, file: r.csv, load: 11 kg}\n");
  };
  const auto rises = [&] { return table_of(scratch / "out/r.csv").at("contraction_ratio"); };
  ASSERT_EQ(replayed("{}", "{column: mA, unit: mA}").status, 0);
  const std::vector<double> by_current = rises();
  const auto same = [&] {
    const std::vector<double> now = rises();
    ASSERT_EQ(now.size(), by_current.size());
    for (std::size_t k = 0; k < now.size(); ++k) EXPECT_NEAR(now[k], by_current[k], 1e-9) << k;
  };
  const std::string volts =
      "{zero_command: 0 V, span_command: 10 V, zero_pressure: 0.5 bar, span_pressure: 5 bar}";
  ASSERT_EQ(replayed(volts, "{column: V, unit: V}").status, 0);
  same();
  EXPECT_EQ(table_of(scratch / "out/r.csv").at("command_V"), (std::vector<double>{1.25, 1.25, 3.125, 10, 0}));
  EXPECT_TRUE(holds(read_text(scratch / "out/report.html"), "0 to 10 V for ",
                    "\"title\":\"Command\",\"unit\":\"V\""));
  EXPECT_EQ(document().at("rig").at("valve").at("span_command"), "10 V");
  EXPECT_EQ(document().at("rig").at("dac").at("largest_command"), "10 V");
  ASSERT_EQ(
      replayed("{zero_command: 0 bar, span_command: 5 bar, zero_pressure: 0.5 bar, span_pressure: 5 bar}",
               "{column: kPa, unit: kPa}")
          .status,
      0);
  same();
  const Said refused = replayed(volts, "{column: mA, unit: mA}");
  EXPECT_EQ(refused.status, 65);
  EXPECT_NE(refused.err.find("command: unit = mA: the rig's valve is commanded in V"), std::string::npos)
      << refused.err;
}

TEST_F(Replayed, BothValvesOfAPairTakeTheSame) {
  write_text(scratch / "r.csv", "time_s,I,V\n0,6,2\n0.2,8,4\n0.7,8,4\n");
  const std::string columns =
      "columns:\n  command_1: {column: I, unit: V}\n  command_2: {column: V, unit: V}\n";
  const std::string
      runs = "  - {id: r, file: r.csv}\n",
      volts =
          "{valve: {zero_command: 0 V, span_command: 10 V, zero_pressure: 0.5 bar, span_pressure: 5 bar}}";
  const Said other =
      replay("{base: thesis_pair, mechanics: {kind: pair, opposite: " + volts + "}}", columns, runs);
  EXPECT_NE(other.err.find("V is the wrong kind of unit; wanted is mA"), std::string::npos) << other.err;
  const Said both = replay("{base: thesis_pair, " + volts.substr(1), columns, runs);
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(table_of(scratch / "out/r.csv").at("command_2_V"), (std::vector<double>{2, 4, 4}));
}

TEST_F(Replayed, ASlackCordIsSaid) {
  write_text(scratch / "r.csv", "time_s,p,e\n0,3,0.1\n0.1,3,0.1\n0.2,1,0.35\n0.3,1,0.35\n");
  const std::string columns =
      "columns:\n  muscle_pressure: {column: p, unit: bar, as: input}\n"
      "  contraction: {column: e, unit: 1, as: input}\n";
  const Said said = replay("thesis", columns, "  - {id: r, file: r.csv}\n");
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string words = "the cord of muscle 1 would have to push, from 0.200 s on in 2 of 4 rows";
  EXPECT_TRUE(holds(said.err, words));
  for (const char* file : {"table.txt", "run.json", "report.html"})
    EXPECT_TRUE(holds(read_text(scratch / "out" / file), words)) << file;
  const Json slack = document().at("runs").at(0).at("slack").at(0);
  EXPECT_EQ(slack.at("muscle"), 1);
  EXPECT_LT(slack.at("lowest_N").get<double>(), 0.0);
}

TEST_F(Replayed, VerbsThatNeedTicksAndALoadRefuseTheRest) {
  ASSERT_EQ(replay("thesis_pair", "", "  - {id: a, file: " + reference + "pair_steps.csv}\n").status, 0);
  const Said said = mckibben("calibrate dataset.yaml --out other", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "dataset.yaml: error: calibrate cannot take it yet: the rig's two muscles"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "other"));
  EXPECT_EQ(mckibben("replay dataset.yaml --rig thesis", scratch).status, 65);
  EXPECT_EQ(mckibben("map '" MCKIBBEN_TEST_DATA "/calibration.yaml' --rig thesis_pair", scratch).status, 65);
  EXPECT_EQ(mckibben("check dataset.yaml", scratch).status, 0);
}

TEST_F(Replayed, FoldersAreComparedAsThoseOfOneMuscleAre) {
  ASSERT_EQ(replay("thesis_pair", "", "  - {id: a, file: " + reference + "pair_steps.csv}\n").status, 0);
  EXPECT_EQ(mckibben("diff out out", scratch).status, 0);
}

TEST_F(Replayed, BothMusclesAreDrivenAlikeToBeDiagnosed) {
  const std::string columns =
      "columns:\n  muscle_pressure_1: {column: muscle_pressure_1_bar, unit: bar, as: input}\n";
  ASSERT_EQ(replay("thesis_pair", columns, "  - {id: a, file: " + reference + "pair_steps.csv}\n").status, 0);
  const Said said = mckibben("diagnose dataset.yaml --out other", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "in run a the pressure of one muscle is given, and that of the other is not"));
}

TEST(Pair, IsDiagnosedByItsAngleAndItsGauges) {
  const Scratch scratch;
  const auto current = [](const std::string& name, const char* one, const char* two) {
    return "  - name: " + name +
           "\n    current_1: {kind: sine_current, low: 6 mA, high: 18 mA, period: " + one +
           " s}\n    current_2: {kind: sine_current, low: 8 mA, high: 16 mA, period: " + two + " s}\n";
  };
  write_text(scratch / "truth.yaml", "schema: mckibben-pair/1\nduration: 1.2 s\ncurrents:\n" +
                                         current("a", "0.7", "1.1") + current("b", "1.3", "0.8") +
                                         current("c", "0.9", "1.2"));
  ASSERT_EQ(mckibben("run truth.yaml --out truth", scratch).status, 0);
  std::string data = "schema: mckibben-dataset/1\nrig: thesis_pair\nruns:\n";
  for (const std::string id : {"a", "b", "c"}) data += "  - {id: " + id + ", file: truth/" + id + ".csv}\n";
  write_text(scratch / "dataset.yaml", data);
  const Said said = mckibben("diagnose dataset.yaml --out found --threads 2", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "errors are joint angles in deg"));
  const Json found = Json::parse(read_text(scratch / "found/diagnosis.json"));
  EXPECT_EQ(found.at("verdict"), "nothing_missing") << found.at("because");
  EXPECT_EQ(found.at("gap").at("reading"), "angle");
  EXPECT_EQ(found.at("gap").at("unit"), "rad");
  const std::string page = read_text(scratch / "found/report.html");
  EXPECT_TRUE(holds(page, "Joint angle, measured and by each rig", "given_muscle_pressure_2",
                    "pressure of muscle 2", "two muscles turn the joint", "towards muscle 1"));
  EXPECT_TRUE(lacks(page, "contraction ratio</label>"));  // no lengths to choose the unit of
  EXPECT_EQ(mckibben("replay dataset.yaml --rig found/rig.yaml --out again", scratch).status, 0);
}

TEST(Pair, FollowsItsTargetsUnderControllers) {
  const Scratch scratch;
  write_text(
      scratch / "arm.yaml",
      "schema: mckibben-pair/1\nduration: 1.2 s\n"
      "currents:\n  - {name: up, current_1: {kind: step_current, moves: []}, "
      "current_2: {kind: step_current, moves: []}}\n"
      "targets:\n  - name: sine\n    angle: {kind: sine, mean: 0 deg, amplitude: 10 deg, period: 1.2 s}\n"
      "    stiffness: {kind: steps, start: 13 N.m/rad, moves: []}\n"
      "hand: {loads: [0 kg, 0.5 kg]}\n"
      "controllers:\n  - {kind: pid, proportional: 30 mA/rad, integral_time: 0.1 s, derivative_time: "
      "0.08 s}\n  - {kind: model_inverse_feedback}\n"
      "criteria: [{controller: pid, rmse_below: 0.01 deg}]\n");
  ASSERT_EQ(mckibben("check arm.yaml", scratch).status, 0);
  const Said said = mckibben("run arm.yaml", scratch);
  ASSERT_EQ(said.status, 1) << said.err;
  EXPECT_TRUE(holds(said.out, "sine_0.5kg_pid: rmse =", "under given currents",
                    "  sine   0.5     model_inverse_feedback"));
  const Json document = Json::parse(read_text(scratch / "out/arm/run.json"));
  ASSERT_EQ(document.at("runs").size(), 5u);
  const Json& run = document.at("runs").at(1);
  EXPECT_EQ(run.at("controller"), "pid");
  EXPECT_LT(run.at("rmse_rad").get<double>(), 0.1);
  EXPECT_NEAR(run.at("stiffness_N_m_per_rad").at("asked").get<double>(), 13.0, 1e-9);
  EXPECT_NEAR(run.at("stiffness_N_m_per_rad").at("had").get<double>(), 13.0, 1.0);
  const Table is = table_of(scratch / "out/arm/sine_0kg_pid.csv");
  EXPECT_NEAR(is.at("target_angle_rad")[25], 10.0 * std::acos(-1.0) / 180.0, 1e-9);
  EXPECT_EQ(is.at("target_stiffness_Nm_per_rad").front(), 13.0);
  EXPECT_FALSE(table_of(scratch / "out/arm/up.csv").contains("target_angle_rad"));
  const Json package = Json::parse(read_text(scratch / "out/arm/datapackage.json"));
  const auto columns = [&](std::size_t i) {
    return package.at("resources").at(i).at("schema").at("fields").size();
  };
  EXPECT_EQ(columns(1), is.size());
  EXPECT_EQ(columns(0) + 2, columns(1));
  const std::string html = read_text(scratch / "out/arm/report.html");
  EXPECT_TRUE(holds(html, "sine, 0.5 kg in the hand", "given_stiffness",
                    "Joint angle and torque of both muscles", "Pressure and contraction of muscle 2",
                    "angle less target"));
  EXPECT_TRUE(holds(read_text(scratch / "out/arm/tracking.svg"), ">sine, 0.5 kg: joint angle [deg]<"));
}

TEST(Pair, RunsUnderTwoCurrents) {
  const Scratch scratch;
  std::string file = read_text(MCKIBBEN_SOURCE_DIR "/scenarios/pair.yaml");
  write_text(scratch / "pair.yaml", file.substr(0, file.find("targets:")));
  const Said said = mckibben("run pair.yaml --format mat", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read_text(scratch / "out/pair/table.txt"), said.out);
  const Json document = Json::parse(read_text(scratch / "out/pair/run.json"));
  EXPECT_EQ(document.at("schema"), "mckibben-run/1");
  ASSERT_EQ(document.at("runs").size(), 2u);
  const Table is = table_of(scratch / "out/pair/steps.csv");
  EXPECT_EQ(is.at("time_s").size(), 500u);
  EXPECT_EQ(is.at("time_s")[1], 0.012);
  EXPECT_NEAR(is.at("angle_rad").front(), 0.0, 1e-6);  // the same current on both sides
  EXPECT_GT(is.at("angle_rad")[280], 0.2);             // muscle 1 is the stronger
  EXPECT_LT(is.at("angle_rad").back(), -0.2);
  EXPECT_LT(document.at("runs").at(0).at("ledger").at("unexplained_share").at("energy").get<double>(), 1e-5);
  const std::string html = read_text(scratch / "out/pair/report.html");
  EXPECT_TRUE(holds(html, "PairPicture", "Joint angle"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/pair/triangle.mat"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/pair/tracking.svg")) << "nothing is followed";
  EXPECT_TRUE(holds(read_text(scratch / "out/pair/loops.svg"), ">steps, muscle 1<", ">triangle, muscle 2<"));

  // What was simulated is found again by a replay.
  write_text(scratch / "dataset.yaml",
             "schema: mckibben-dataset/1\nrig: thesis_pair\nruns:\n  - {id: r, file: out/pair/steps.csv}\n");
  ASSERT_EQ(mckibben("replay dataset.yaml --out again", scratch).status, 0);
  const Json gaps = Json::parse(read_text(scratch / "again/run.json")).at("runs").at(0).at("gaps");
  for (const Json& gap : gaps)
    EXPECT_LT(gap.at("largest_error").get<double>(), gap.at("unit") == "N" ? 1e-7 : 1e-9) << gap.dump();
}

}  // namespace
}  // namespace mckibben::cli
