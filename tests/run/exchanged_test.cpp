// Columns of one muscle that are each other's are told by simulating with each pair exchanged.
#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include <sim/run/exchanged.hpp>

#include "measured_on.hpp"
#include "says.hpp"

namespace mckibben::run {
namespace {

/// The data with stamps.
domain::Dataset stamped(domain::Dataset data = sound()) {
  data.own_clock = true;
  data.columns["command"] = {"U", "mA"};
  data.columns["contraction"] = {"x", "mm"};
  data.columns["muscle_pressure"] = {"p", "bar"};
  for (domain::Run& run : data.runs) {
    run.ratio_per_unit = 1e-3 / data.rig.muscle.rest_length_m;
    domain::Measurement measured;
    for (std::size_t k = 0; k < run.rows(); ++k)
      measured.time_s.push_back(static_cast<double>(k) * data.rig.tick_s);
    measured.give("command") = run.current_mA;
    measured.take("contraction") = run.values("contraction");
    measured.take("muscle_pressure") = run.values("muscle_pressure");
    run.measured = std::move(measured);
    run.readings.clear();
    run.current_mA.clear();
  }
  return data;
}

/// With two of the columns holding each other's numbers, in the runs from `first` to before `end`.
domain::Dataset exchanged(std::size_t one, std::size_t other, domain::Dataset data, std::size_t first,
                          std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    domain::Run& run = data.runs[i];
    const double size[] = {data.columns["command"].factor, run.ratio_per_unit, plant::Pa_per_bar};
    auto& columns = run.measured->columns;
    for (std::size_t k = 0; k < run.measured->time_s.size(); ++k) {
      double &a = columns[one].values[k], &b = columns[other].values[k];
      a /= size[one];
      b /= size[other];
      std::swap(a, b);
      a *= size[one];
      b *= size[other];
    }
  }
  return data;
}

/// What is said where all do.
std::string told(std::size_t one, std::size_t other, domain::Dataset data = stamped()) {
  const std::size_t runs = data.runs.size();
  const auto found = exchanged_columns(exchanged(one, other, std::move(data), 0, runs));
  return found ? found->message : "";
}

TEST(Exchanged, InSomeRunsAloneTheyAreTold) {
  for (const auto& [one, other] : std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}, {1, 2}, {0, 1}}) {
    const auto found = exchanged_columns(exchanged(one, other, stamped(), 2, 4));
    ASSERT_TRUE(found) << one << " " << other;
    EXPECT_EQ(found->runs, (std::vector<std::size_t>{2, 3}));
  }
}

TEST(Exchanged, WhatNeverMovesIsNotInARunAlone) {
  domain::Dataset data = stamped();
  data.runs.resize(2);
  data.rig.mechanics = plant::HeldLength{};
  data.columns["force"] = {"F", "N"};
  for (domain::Run& run : data.runs) {
    const std::vector<double> pressure_Pa = run.measured->read("muscle_pressure");
    domain::Measurement held;
    held.time_s = run.measured->time_s;
    held.give("muscle_pressure") = pressure_Pa;
    held.give("contraction").assign(pressure_Pa.size(), &run == &data.runs.front() ? 0.0 : 0.1);
    held.take("force").assign(pressure_Pa.size(), 1.0);  // of a table that was to be filled
    run.measured = std::move(held);
  }
  EXPECT_FALSE(exchanged_columns(data));
}

TEST(Exchanged, EveryPairOfColumnsIsTold) {
  EXPECT_TRUE(
      holds(told(0, 2), "command and muscle_pressure look exchanged",
            "write columns: {command: {column: p, unit: mA}, muscle_pressure: {column: U, unit: bar}}"));
  EXPECT_TRUE(holds(told(1, 2), "contraction and muscle_pressure look exchanged"));
  EXPECT_TRUE(holds(told(0, 1), "command and contraction look exchanged"));
}

TEST(Exchanged, APressureThatWasSetAndTheOneThatFollowedItAreTold) {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::regulator;
  rig.valve.zero_command = rig.valve.zero_pressure_Pa = 0.0;
  rig.valve.time_constant_s = 0.05;
  rig.sensors.put(plant::gauge());
  domain::Dataset data = stamped(measured_on(rig, {11.138, 16.138, 23.406}, rig));
  data.columns["command"].factor = 4.0;  // mA in the file's number of bar
  EXPECT_FALSE(exchanged_columns(data));
  EXPECT_TRUE(holds(told(0, 2, std::move(data)), "command and muscle_pressure look exchanged"));
}

TEST(Exchanged, ColumnsThatAreRightOrWrongOtherwiseAreNot) {
  domain::Dataset data = stamped();
  EXPECT_FALSE(exchanged_columns(data));
  for (domain::Run& run : data.runs)
    for (double& ratio : run.measured->take("contraction")) ratio *= -10.0;
  EXPECT_FALSE(exchanged_columns(data));
}

}  // namespace
}  // namespace mckibben::run
