// What a data set may give in place of a command or a load, through the whole program: the pressure between
// valve and hose, a force or a torque from outside; and a gauge on the valve as a reading.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"
#include "table_of.hpp"

namespace mckibben::cli {
namespace {

using input::Json;

constexpr double weight_N = 5.0 * 9.80665;

/// Data sets of one run, replayed one after the other.
class Given : public testing::Test {
 protected:
  Said replay(const std::string& rig, const std::string& keys, const std::string& run,
              const std::string& out = "out") {
    write_text(scratch / "dataset.yaml", "schema: mckibben-dataset/1\nrig: " + rig + "\n" + keys +
                                             "runs:\n  - {id: r1, " + run + "}\n");
    return mckibben("replay dataset.yaml --out " + out + " --threads 1", scratch);
  }
  /// A load of 5 kg under a current that swings; its truth is out/r1.csv, a row each 2 ms.
  void swing() {
    std::string text = "time_s,current_mA\n";
    for (int k = 0; k <= 1000; ++k)
      text += fmt::format("{},{}\n", 0.002 * k, 12.0 + 3.0 * std::sin(0.006 * k));
    write_text(scratch / "command.csv", text);
    const Said said = replay("thesis", "start: settled\n", "file: command.csv, load: 5 kg");
    ASSERT_EQ(said.status, 0) << said.err;
  }
  /// For two seconds a current of 12 mA, and a column beside it that says the same in every row.
  void write_constant(const std::string& name, const std::string& currents, double value) {
    std::string text = "time_s," + currents + "," + name + "\n";
    for (int k = 0; k <= 100; ++k)
      text += fmt::format("{},{},{}\n", 0.02 * k, currents == "current_mA" ? "12" : "12,11", value);
    write_text(scratch / "constant.csv", text);
  }
  Json gap(const std::string& reading, const std::string& out = "out") {
    const Json document = Json::parse(read_text(scratch / (out + "/run.json")));
    for (const Json& one : document.at("runs").at(0).at("gaps"))
      if (one.at("reading") == reading) return one;
    return {{"rmse", std::nan("")}, {"mean_error", std::nan("")}};
  }
  double last(const std::string& column, const std::string& out = "out") {
    return table_of(scratch / (out + "/r1.csv")).at(column).back();
  }

  /// By the cord, at the end.
  double carried_N(const std::string& out) {
    return last("braid_force_N", out) + last("friction_force_N", out);
  }

  Scratch scratch;
};

const std::string read_columns =
    "  contraction: {column: contraction_ratio, unit: 1}\n"
    "  muscle_pressure: {column: muscle_pressure_bar, unit: bar}\n";

TEST_F(Given, TheValvesPressureFillsTheMuscleAsTheValveDid) {
  swing();
  const std::string columns =
      "columns:\n  valve_pressure: {column: valve_pressure_bar, unit: bar, as: input}\n" + read_columns;
  const Said said = replay("{base: thesis, valve: {conductance: 2.5e-10 m3/(s.Pa)}}", columns,
                           "file: out/r1.csv, load: 5 kg", "again");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_LT(gap("contraction", "again").at("largest_error").get<double>(), 5e-5);
  EXPECT_LT(gap("muscle_pressure", "again").at("largest_error").get<double>(), 1e-3);
  const auto table = table_of(scratch / "again/r1.csv");
  EXPECT_FALSE(table.contains("current_mA"));
  EXPECT_TRUE(table.contains("valve_pressure_bar"));
  EXPECT_NE(read_text(scratch / "again/report.html").find("\"valve_pressure\":"), std::string::npos);
  const std::string tracking = read_text(scratch / "again/tracking.svg");
  EXPECT_TRUE(
      holds(tracking, ">measured<", "<path class='given' d='M", "<path class='run c0 d0' data-run='0'"));
  EXPECT_EQ(mckibben("check dataset.yaml", scratch).status, 0);
  const Said diagnosed = mckibben("diagnose dataset.yaml --out other", scratch);
  EXPECT_EQ(diagnosed.status, 0) << diagnosed.err;
  EXPECT_TRUE(read_text(scratch / "other/before_after.svg").starts_with("<svg xmlns="));
  EXPECT_TRUE(holds(diagnosed.out, "the valve's pressure is the input: valve and supply are out of sight",
                    "one run: parts of it, r1-1 to r1-4"))
      << diagnosed.out;
}

// What is proposed to a run that does not begin at rest is what the reader takes.
TEST_F(Given, SettledPointsAreNotToldToStartMoving) {
  const std::string rig = "{base: thesis, settling_time: 20 ms}", command = "command: {column: i, unit: mA}";
  write_text(scratch / "a.csv", "t,i\n0,8\n0.3,8.5\n0.6,9\n");
  const auto said = [&](const std::string& clock) {
    return replay(rig, "columns: {" + clock + ", " + command + "}\n", "file: a.csv, load: 5 kg").err;
  };
  EXPECT_TRUE(holds(said("time: {column: t, unit: s}"), "still moves at ", "or start: moving"));
  const std::string of_points = said("settled: {each: 0.3 s}");
  EXPECT_TRUE(holds(of_points, "still moves at ", "a longer settling_time of the rig"));
  EXPECT_EQ(of_points.find("start: moving"), std::string::npos) << of_points;
}

TEST_F(Given, AGaugeOnTheValveIsComparedWithTheValve) {
  swing();
  const std::string gauge = "  valve_pressure: {column: valve_pressure_bar, unit: bar, zero: 0.1}\n";
  const Said said = replay("thesis", "start: settled\ncolumns:\n" + gauge + read_columns,
                           "file: out/r1.csv, load: 5 kg", "again");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NEAR(gap("valve_pressure", "again").at("mean_error").get<double>(), 0.1, 1e-6);
  EXPECT_EQ(gap("valve_pressure", "again").at("unit"), "bar");
  EXPECT_LT(gap("muscle_pressure", "again").at("rmse").get<double>(), 1e-6);
  EXPECT_NE(said.out.find("valve_pressure"), std::string::npos) << said.out;
  const std::string page = read_text(scratch / "again/report.html");
  EXPECT_NE(page.find("\"valve_pressure_error\":"), std::string::npos);
  EXPECT_NE(page.find("\"given_valve_pressure\":"), std::string::npos);
  // A column that has our name by chance is none.
  ASSERT_EQ(replay("thesis", "start: settled\n", "file: out/r1.csv, load: 5 kg", "third").status, 0);
  EXPECT_TRUE(std::isnan(gap("valve_pressure", "third").at("rmse").get<double>()));
}

TEST_F(Given, AForceFromOutsideIsALoadWithoutMass) {
  write_constant("F", "current_mA", weight_N);
  const std::string columns = "columns: {joint_force: {column: F, unit: N}}\n";
  const Said said = replay("thesis", columns, "file: constant.csv", "force");
  ASSERT_EQ(said.status, 0) << said.err;
  ASSERT_EQ(replay("thesis", "start: settled\n", "file: constant.csv, load: 5 kg", "load").status, 0);
  EXPECT_NEAR(carried_N("force"), weight_N, 0.1);
  EXPECT_NEAR(carried_N("load"), weight_N, 0.1);
  EXPECT_EQ(last("joint_force_N", "force"), weight_N);
  EXPECT_FALSE(table_of(scratch / "load/r1.csv").contains("joint_force_N"));
  // Beside the load.
  ASSERT_EQ(replay("thesis", columns, "file: constant.csv, load: 5 kg", "both").status, 0);
  EXPECT_NEAR(carried_N("both"), 2.0 * weight_N, 0.1);
  EXPECT_LT(last("contraction_ratio", "both"), last("contraction_ratio", "load") - 1e-3);
}

TEST_F(Given, ATorqueFromOutsideTurnsAPairAsMuscle1Does) {
  for (const double torque_N_m : {0.0, 1.5}) {
    write_constant("M", "current_1_mA,current_2_mA", torque_N_m);
    const Said said = replay("thesis_pair", "columns: {joint_torque: {column: M, unit: N.m}}\n",
                             "file: constant.csv", fmt::format("by{}", torque_N_m));
    ASSERT_EQ(said.status, 0) << said.err;
  }
  EXPECT_GT(last("angle_rad", "by1.5"), last("angle_rad", "by0") + 0.02);
  EXPECT_EQ(last("joint_torque_Nm", "by1.5"), 1.5);
  const double weight_N_m = 2.0 * 9.80665 * 0.25 * std::sin(last("angle_rad", "by1.5"));
  EXPECT_NEAR(0.03 * (last("tension_1_N", "by1.5") - last("tension_2_N", "by1.5")) + 1.5, weight_N_m, 1e-2);
}

// 204 ms times 0.001 is 0.20400000000000001 s.
TEST_F(Given, StampsInMillisecondsAreWrittenAsTheyAre) {
  std::string text = "t,I\n";
  for (int k = 0; k <= 60; ++k) text += fmt::format("{},{}\n", 34 * k, 12.0);
  write_text(scratch / "a.csv", text);
  const Said said = replay(
      "thesis", "columns:\n  time: {column: t, unit: ms}\n  current: {column: I, unit: mA}\nstart: settled\n",
      "file: a.csv, load: 5 kg");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(read_text(scratch / "out/r1.csv"), "\n0.204,"));
}

}  // namespace
}  // namespace mckibben::cli
