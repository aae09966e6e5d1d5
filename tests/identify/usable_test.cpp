// What counts of measured data, and what is refused with the line that mends it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

#include <plant/constants.hpp>
#include <sim/data/finding.hpp>
#include <sim/data/judged.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/identify/usable.hpp>
#include <sim/run/exchanged.hpp>

#include "diagnose/bench.hpp"
#include "diagnose/joint.hpp"
#include "diagnose/load_cell.hpp"
#include "diagnose/planted.hpp"
#include "says.hpp"

namespace mckibben::identify {
namespace {

TEST(Usable, ForcesOfABenchInAnotherUnitAreRefused) {
  domain::Dataset data = diagnose::on_a_bench({}, 0.0);
  for (domain::Run& run : data.runs)
    for (double& force_N : run.judged().values) force_N *= 1e-3;
  EXPECT_THROW(usable(data, 1), data::UnfitData);
  for (domain::Run& run : data.runs)
    for (double& force_N : run.judged().values) force_N *= -1e3;
  EXPECT_THROW(usable(data, 1), data::UnfitData);
}

// The braid says how steeply force follows pressure; a radius that is a tenth off changes that by a fifth.
TEST(Usable, PressuresOfAHeldMuscleInASmallerUnitThanIsSaidAreRefused) {
  const auto refused_as = [](double factor, const std::vector<std::size_t>& runs) {
    domain::Dataset data = diagnose::on_a_bench({}, 0.0);
    data.columns["muscle_pressure"] = {.column = "p", .unit = "bar", .as = domain::Role::input};
    for (const std::size_t run : runs)
      for (double& pressure_Pa : data.runs[run].measured->give("muscle_pressure")) pressure_Pa *= factor;
    try {
      usable(data, 1);
    } catch (const data::UnfitData& unfit) {
      return std::string(unfit.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused_as(1.0, {}), "");
  EXPECT_EQ(refused_as(0.8, {0, 1, 2, 3, 4}), "");
  EXPECT_TRUE(holds(refused_as(0.1, {2}), "run r3: force follows muscle_pressure ",
                    "times as steeply as this braid would: the pressure looks like MPa, not bar; ",
                    "{column: p, unit: MPa, as: input"));
  EXPECT_TRUE(holds(refused_as(0.1, {0, 1, 2, 3, 4}), "all runs: force follows"));
}

TEST(Usable, RowsAtTheEndOfTheRangeDoNotCount) {
  plant::Rig rig;
  rig.sensors.position().kind = plant::SensorKind::laser;
  rig.sensors.position().resolution = 2e-4;
  rig.sensors.position().noise = 1e-4;
  rig.sensors.position().highest = 0.03;
  auto currents = diagnose::three_kinds();
  currents.resize(1);
  currents[0].duration_s = 2.5;
  domain::Dataset data = diagnose::planted(rig, {11.138, 16.138}, currents, 5, rig);
  const Usable found = usable(data, 2);
  std::ptrdiff_t ended = 0;
  for (const double ratio : data.runs[0].judged().values)
    ended += ratio * rig.muscle.rest_length_m > 0.0299 ? 1 : 0;
  ASSERT_GT(ended, 10);
  EXPECT_GE(std::ranges::count(found.masked[0], true), ended);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_TRUE(holds(found.warnings[0], "at the end of the sensor's range"));
}

// A load that is held long is no reason to leave its run out: friction that the model lacks holds one too.
TEST(Usable, RowsInWhichALoadIsHeldDoNotCount) {
  auto currents = diagnose::three_kinds();
  currents.resize(1);
  currents[0].duration_s = 8.0;
  domain::Dataset data = diagnose::planted({}, {11.138, 16.138, 18.87}, currents, 5);
  domain::Run moved = data.runs[1];
  const auto stuck = moved.current_mA.begin() + 260;
  std::fill(stuck, stuck + 140, *stuck);
  const diagnose::Loaded hanging{data.rig, moved.load_kg};
  data.runs[1].judged().values = diagnose::predict(moved, {&hanging, 1}).front().judged();
  const double count = run::contraction_per_count(data.rig);
  for (double& ratio : data.runs[1].judged().values) ratio = count * std::floor(ratio / count);
  const Usable found = usable(data, 2);
  EXPECT_EQ(found.runs.size(), 3U);
  EXPECT_TRUE(found.masked[1][320]);
  EXPECT_FALSE(found.masked[1][200] || found.masked[1][412]);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_TRUE(holds(found.warnings[0],
                    "where the rig as described moves: a stuck valve, something that held it, or friction "
                    "that the rig file lacks; these readings are not used"))
      << found.warnings[0];
}

/// The words that the data are refused with; empty if they are not.
std::string refusal(domain::Dataset data) {
  try {
    data = data::with_rows(std::move(data));
    usable(data, 2);
  } catch (const data::UnfitData& unfit) {
    return unfit.what();
  }
  return "";
}

domain::Dataset forces_times(double factor) {
  domain::Dataset data = diagnose::with_a_cell({});
  for (domain::Run& run : data.runs)
    for (double& force_N : run.measured->take("force")) force_N *= factor;
  return data;
}

TEST(Usable, ForcesOfALoadCellInAnotherUnitOrOfAnotherSignAreRefused) {
  EXPECT_EQ(refusal(forces_times(1.0)), "");
  EXPECT_NE(refusal(forces_times(1e-3)).find("kN"), std::string::npos);
  EXPECT_NE(refusal(forces_times(1.0 / plant::gravity_m_per_s2)).find("kg"), std::string::npos);
  EXPECT_NE(refusal(forces_times(-1.0)).find("factor: -1"), std::string::npos);
}

std::string refused(domain::Dataset data, const std::function<void(domain::Run& run)>& spoil) {
  for (domain::Run& run : data.runs) spoil(run);
  return refusal(std::move(data));
}

TEST(Usable, AnglesAndPressuresThatAreNotWhatTheirColumnsSayAreRefusedWithTheLineToWrite) {
  domain::Dataset data = diagnose::of_a_joint(plant::thesis_pair());
  const auto times = [](double factor) {
    return [factor](domain::Run& run) {
      for (double& angle_rad : run.judged().values) angle_rad *= factor;
    };
  };
  EXPECT_EQ(refused(data, times(1.0)), "");
  EXPECT_EQ(refused(data, times(0.7)), "");
  EXPECT_NE(refused(data, times(-1.0))
                .find("write columns: {angle: {column: angle_rad, unit: rad, factor: -1}}, "
                      "or exchange muscle 1 and muscle 2"),
            std::string::npos)
      << refused(data, times(-1.0));
  EXPECT_NE(refused(data, times(1.0 / plant::degree_rad))
                .find("{angle: {column: angle_rad, unit: deg, factor: 1}}"),
            std::string::npos);
  data.columns["angle"] = {.column = "elbow", .unit = "deg"};
  EXPECT_NE(refused(data, times(plant::degree_rad)).find("{angle: {column: elbow, unit: rad, factor: 1}}"),
            std::string::npos);
  const auto exchange = [](domain::Run& run) {
    run.measured->take("muscle_pressure", 1).swap(run.measured->take("muscle_pressure", 2));
  };
  EXPECT_NE(refused(data, exchange).find("exchange muscle 1 and muscle 2"), std::string::npos);
}

TEST(Usable, TensionsOfTheOtherMuscleAreAskedAbout) {
  domain::Dataset data = diagnose::of_a_joint(plant::thesis_pair(), false);
  const diagnose::Loaded pair{data.rig};
  for (domain::Run& run : data.runs) {
    for (const std::size_t muscle : {1U, 2U}) run.read("force", {}, muscle);
    const diagnose::Readings readings = diagnose::predict(run, {&pair, 1}).front();
    for (const std::size_t muscle : {1U, 2U}) run.readings[muscle].values = readings.readings[muscle];
  }
  const auto said = [&] {
    std::string all;
    for (const std::string& warning : usable(data, 2).warnings) all += warning;
    return all;
  };
  EXPECT_EQ(said().find("exchanged"), std::string::npos);
  for (domain::Run& run : data.runs) run.readings[1].values.swap(run.readings[2].values);
  EXPECT_NE(said().find("with tension_1 and tension_2 exchanged"), std::string::npos) << said();
  EXPECT_NE(said().find("tension_1: {column: tension_2_N, unit: N}"), std::string::npos) << said();
}

// Without gauges the other sign of the angle would say the same.
TEST(Usable, CommandsOfTheOtherMuscleAreToldByTheGauges) {
  domain::Dataset data = diagnose::of_a_joint(plant::thesis_pair(), true);
  const diagnose::Loaded pair{data.rig};
  data.rows_of_stamps.reset();
  data.columns["angle"] = {"elbow", "rad"};
  for (const char* side : {"1", "2"}) {
    data.columns[std::string("command_") + side] = {std::string("I") + side, "mA"};
    data.columns[std::string("muscle_pressure_") + side] = {std::string("p") + side, "bar"};
  }
  for (domain::Run& run : data.runs) {
    for (const std::size_t muscle : {1U, 2U}) run.read("muscle_pressure", {}, muscle);
    const diagnose::Readings readings = diagnose::predict(run, {&pair, 1}).front();
    run.measured->take("angle") = run.judged().values;
    for (const std::size_t muscle : {1U, 2U})
      run.measured->take("muscle_pressure", muscle) = readings.readings[muscle];
    run.measured->rows.clear();
    run.readings.clear();
    run.time_s.clear();
  }
  EXPECT_FALSE(run::exchanged_columns(data));
  for (domain::Run& run : data.runs) {
    std::vector<double> first = run.measured->given("command", 1);
    run.measured->give("command", 1) = run.measured->given("command", 2);
    run.measured->give("command", 2) = std::move(first);
  }
  const auto found = run::exchanged_columns(data);
  ASSERT_TRUE(found);
  EXPECT_TRUE(holds(found->message, "command_1 and command_2 look exchanged",
                    "{command_1: {column: I2, unit: mA}, command_2: {column: I1, unit: mA}}"));
}

}  // namespace
}  // namespace mckibben::identify
