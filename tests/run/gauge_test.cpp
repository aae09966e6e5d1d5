// What is said of a gauge that reads many times, or a part of, what the rig would do.
#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include <sim/data/gains.hpp>
#include <sim/data/units.hpp>

#include "measured_on.hpp"
#include "says.hpp"

namespace mckibben::run {
namespace {

TEST(Gauge, AFactorIsToldOnlyIfAllRunsAgreeOnIt) {
  const auto told = [](double first, double others) {
    auto data = sound();
    data.columns["muscle_pressure"] = {"p_bar", "bar"};
    for (domain::Run& run : data.runs)
      for (double& pressure_Pa : run.find("muscle_pressure")->values)
        pressure_Pa *= &run == &data.runs.front() ? first : others;
    std::string all;
    for (const std::string& one : said(data)) all += one + "\n";
    return all;
  };
  EXPECT_TRUE(holds(told(0.4, 0.4), "all runs: muscle_pressure is 0.", "is a factor of its gauge"));
  EXPECT_TRUE(lacks(told(0.4, 1.0), "is a factor of its gauge"));
  EXPECT_TRUE(lacks(told(0.25, 0.4), "is a factor of its gauge")) << "a leak may do so";
  const std::string span = told(0.6, 0.6);
  EXPECT_TRUE(holds(span, "all runs: muscle_pressure is 0.6 times what the valve would give",
                    "is span_pressure of the rig's valve 3.", "not 5 bar?",
                    "{muscle_pressure: {column: p_bar, unit: bar, factor: 1.6"));
  EXPECT_TRUE(lacks(span, "zero", "load", "contraction"));
  EXPECT_TRUE(lacks(told(0.6, 0.7), "span_pressure"));
  EXPECT_TRUE(lacks(told(0.95, 0.95), "span_pressure")) << "gauges do so";
}

TEST(Gauge, MoreThanTheSupplyHasIsToldFirst) {
  const auto told = [](double factor, std::size_t runs, bool follows) {
    auto data = sound();
    data.columns["muscle_pressure"] = {"p", "bar"};
    for (std::size_t run = 0; run < runs; ++run) {
      auto& values = data.runs[run].find("muscle_pressure")->values;
      if (!follows) std::ranges::reverse(values);
      for (double& pressure_Pa : values) pressure_Pa *= factor;
    }
    return said(data);
  };
  for (const auto& [runs, who] : {std::pair<std::size_t, const char*>{6, "all runs"}, {1, "run r01"}})
    for (const bool follows : {true, false})
      EXPECT_TRUE(holds(told(14.5, runs, follows).front(), "error: ", who, "muscle_pressure is up to ",
                        "write columns: {muscle_pressure: {column: p, unit: psi, factor: 1}}"));
  EXPECT_TRUE(holds(told(3.0, 1, true).front(), "warning: run r01: muscle_pressure is up to ",
                    " bar, and the rig's supply has 6 bar: are unit, zero and factor of its gauge right",
                    "or set valve.supply_pressure of the rig"));
  for (const std::string& one : told(1.1, 6, true)) EXPECT_TRUE(lacks(one, "supply has"));
}

TEST(Gauge, AUnitThatTheHeadingSaysIsDoubtedOnlyWhereAnotherFits) {
  const std::vector<data::Unit> units{{"mm", 1.0}, {"%", 2.5}};
  data::Compared rows;
  for (int k = 0; k < 100; ++k) {
    rows.measured.push_back(1.0 * k);
    rows.model.push_back(2.5 * k + (k % 2 == 0 ? 50.0 : -50.0));
  }
  EXPECT_EQ(data::unit_that_fits(rows, {"x", "mm"}, units).value_or(data::FittingUnit{}).name, "%");
  EXPECT_FALSE(data::unit_that_fits(rows, {"Pos (mm)", "mm"}, units));
  for (int k = 0; k < 100; ++k) rows.model[static_cast<std::size_t>(k)] = 2.5 * k;
  EXPECT_TRUE(data::unit_that_fits(rows, {"Pos (mm)", "mm"}, units));
  EXPECT_TRUE(data::names_unit("Linear pos (mm)", "mm"));
  EXPECT_FALSE(data::names_unit("comment", "mm"));
}

}  // namespace
}  // namespace mckibben::run
