// Agreement with trajectories of an independent program: fixed steps of 20 us, fourth order, same equations.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rig_on_bench.hpp"

namespace mckibben::engine {
namespace {

struct Row {
  double current_mA, e, valve_bar, muscle_bar;
};

std::vector<Row> read_reference(const std::string& name) {
  std::ifstream file(std::string(MCKIBBEN_TEST_DATA "/reference/") + name + ".csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line.rfind("time_s,current_mA,contraction_ratio,contraction_speed_per_s,valve_pressure_bar", 0),
            0u);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::array<double, 6> cells{};
    const char* at = line.data();
    for (auto& cell : cells) at = std::from_chars(at, line.data() + line.size(), cell).ptr + 1;
    rows.push_back({cells[1], cells[2], cells[4], cells[5]});
  }
  return rows;
}

struct Case {
  const char* name;
  double load_kg;
};

class Reference : public testing::TestWithParam<std::tuple<Case, Method>> {
 protected:
  struct Errors {
    double e = 0.0, bar = 0.0;
  };
  Errors errors_at(double tolerance) {
    const auto [c, method] = GetParam();
    const auto rows = read_reference(c.name);
    EXPECT_GT(rows.size(), 500u);
    RigOnBench bench(plant::Rig{}, c.load_kg, {method, tolerance});
    bench.start(rows.front().current_mA);
    bench.tick = -167;  // settling
    bench.hold(rows.front().current_mA, 167);
    Errors worst;
    for (const auto& row : rows) {
      const auto& state = bench.flow.state;
      worst.e = std::max(worst.e, std::abs(state.joint.contraction_ratio - row.e));
      worst.bar = std::max({worst.bar, std::abs(state.side.valve_pressure_Pa / 1e5 - row.valve_bar),
                            std::abs(state.side.muscle_pressure_Pa / 1e5 - row.muscle_bar)});
      bench.hold(row.current_mA);
    }
    return worst;
  }
};

TEST_P(Reference, AgreesAtTheDefaultTolerance) {
  const auto worst = errors_at(Settings{}.tolerance);
  EXPECT_LT(worst.e, 2e-6);
  EXPECT_LT(worst.bar, 1e-4);
}

TEST_P(Reference, AgreesCloselyAtTheTightestTolerance) {
  EXPECT_LT(errors_at(solver::tightest_tolerance).e, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Trajectories, Reference,
                         testing::Combine(testing::Values(Case{"m11.138_sine-200-3", 11.138},
                                                          Case{"m13.870_chirp-0.1-1.5-12", 13.870},
                                                          Case{"m16.138_steps-7-0.6-16", 16.138},
                                                          Case{"m18.870_tri-11-4-20-3", 18.870},
                                                          Case{"m23.406_sine-400-2", 23.406}),
                                          testing::Values(Method::erk, Method::cvode)),
                         [](const auto& p) {
                           std::string name =
                               std::get<0>(p.param).name +
                               (std::get<1>(p.param) == Method::erk ? std::string("_erk") : "_cvode");
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace mckibben::engine
