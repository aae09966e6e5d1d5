// Agreement with trajectories of an independent program: fixed steps of 20 us, fourth order, same equations.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "rig_on_bench.hpp"
#include "table_of.hpp"

namespace mckibben::engine {
namespace {

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
    const Table rows = table_of(std::string(MCKIBBEN_TEST_DATA "/reference/") + c.name + ".csv");
    const auto& current_mA = rows.at("current_mA");
    EXPECT_GT(current_mA.size(), 500u);
    RigOnBench bench(plant::Rig{}, c.load_kg, {method, tolerance});
    bench.start(current_mA.front());
    bench.tick = -167;  // settling
    bench.hold(current_mA.front(), 167);
    Errors worst;
    for (std::size_t k = 0; k < current_mA.size(); ++k) {
      const auto& state = bench.flow.state;
      const auto off = [&](const char* column, double value) { return std::abs(value - rows.at(column)[k]); };
      worst.e = std::max(worst.e, off("contraction_ratio", state.joint.contraction_ratio));
      worst.bar = std::max({worst.bar, off("valve_pressure_bar", state.side.valve_pressure_Pa / 1e5),
                            off("muscle_pressure_bar", state.side.muscle_pressure_Pa / 1e5)});
      bench.hold(current_mA[k]);
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
