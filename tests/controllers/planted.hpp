// A calibration with known coefficients, and data sheets, for the tests of what is built on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/calibrated.hpp>

namespace mckibben::controllers {

inline constexpr double planted_load_kg = 16.0;

inline Calibration planted_calibration() {
  Calibration c;
  c.contraction_friction = {0.040, 2e-5, -0.12, 0.004};
  c.relaxation_friction = {0.030, 1e-5, -0.10, 0.003};
  c.contraction = {.a0 = {3e3, 2e4},
                   .a1_0 = {10.0, 2e3},
                   .a1_1 = {2e4, 1e5},
                   .a2_0 = {1.0, 20.0},
                   .a2_1 = {500.0, 1e3},
                   .a3 = {-0.1, 12.0},
                   .a4 = {200.0, 1e3}};
  c.relaxation = {.b0_0 = {-50.0, -500.0},
                  .b0_1 = {2e3, 2e4},
                  .b1 = {2e4, 8e4},
                  .b2 = {400.0, 800.0},
                  .b3 = {-0.1, 13.0},
                  .b4_0 = {5.0, 0.0},
                  .b4_1 = {-20.0, 100.0},
                  .b4_2 = {100.0, 2e3}};
  c.range = {.lowest_ratio = 0.02,
             .highest_ratio = 0.20,
             .lowest_load_kg = 11.0,
             .highest_load_kg = 23.5,
             .lowest_speed_mA_per_s = 5.0,
             .highest_speed_mA_per_s = 17.0};
  return c;
}

inline Knowledge data_sheets(std::vector<double> target) {
  Knowledge knowledge;
  knowledge.contraction_per_count = 4.363e-4;
  knowledge.tick_s = 0.012;
  knowledge.largest_current_mA = 20.0;
  knowledge.target = std::move(target);
  knowledge.model = {7.5e-3, 0.3, 20.0 * std::numbers::pi / 180.0, 1.3};
  knowledge.valve = {4.0, 20.0, 0.5e5, 5.0e5};
  return knowledge;
}

/// Loads from 1 to 100 kg alike: up at 0.5 /s, down at 0.25 /s, between 0.03 and 0.2; no lag.
inline Reach even_reach() {
  Reach reach;
  reach.ratio = {0.0, 0.1, 0.3};
  ReachOfLoad load;
  load.lowest_rising = 0.01;
  load.lowest_falling = 0.03;
  load.highest = 0.2;
  load.rising_per_s = {0.5, 0.5, 0.5};
  load.falling_per_s = {0.25, 0.25, 0.25};
  load.rising_lag_s = load.falling_lag_s = {0.0, 0.0, 0.0};
  reach.loads = {load, load};
  reach.loads[0].load_kg = 1.0;
  reach.loads[1].load_kg = 100.0;
  return reach;
}

/// Data sheets of a rig whose lag makes up for the half tick that a current is old.
inline Knowledge without_lag(std::vector<double> target) {
  Knowledge knowledge = data_sheets(std::move(target));
  knowledge.reach = even_reach();
  for (auto& load : knowledge.reach.loads) load.rising_lag_s = load.falling_lag_s = {-0.006, -0.006, -0.006};
  return knowledge;
}

/// Settings with the planted calibration and no weighing.
template <class Settings>
Settings with_planted_load() {
  Settings settings;
  settings.calibration = "planted";
  settings.model = planted_calibration();
  settings.assumed_load_kg = planted_load_kg;
  return settings;
}

inline double finding(const Controller& controller, const std::string& name) {
  for (const Finding& one : controller.findings())
    if (one.name == name) return one.value;
  ADD_FAILURE() << "no finding " << name;
  return NAN;
}

inline std::vector<double> play(Controller& controller, std::size_t ticks) {
  controller.rest();
  std::vector<double> currents_mA;
  for (std::size_t k = 0; k < ticks; ++k)
    currents_mA.push_back(
        controller.step({static_cast<std::int64_t>(k), 0.012 * static_cast<double>(k), 0}).current_mA);
  return currents_mA;
}

inline std::vector<double> up_rest_down() {
  std::vector<double> target;
  for (int k = 0; k < 100; ++k) target.push_back(0.05 + 0.001 * k);
  for (int k = 0; k < 50; ++k) target.push_back(0.15);
  for (int k = 1; k < 100; ++k) target.push_back(0.15 - 0.001 * k);
  return target;
}

}  // namespace mckibben::controllers
