// Effects in motion: both methods give one answer with each of them, gas mass and energy still add up, and
// the laws with a memory follow their closed forms.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>

#include "rig_on_bench.hpp"
#include "switched_on.hpp"

namespace mckibben::engine {
namespace {

double stepped_mA(int k) {
  return 12.0 + 6.0 * std::sin(0.15 * k) + (k > 30 ? 2.0 : 0.0);
}

Flow end_of_ride(const plant::Rig& rig, Settings settings, int ticks) {
  RigOnBench bench(rig, 13.87, settings);
  bench.start(stepped_mA(0));
  for (int k = 0; k < ticks; ++k) bench.hold(stepped_mA(k));
  return bench.flow;
}

TEST(Effects, BothMethodsGiveOneAnswerWithEachOfThem) {
  for (const auto& [name, rig] : plant::rigs_with_one_effect()) {
    SCOPED_TRACE(name);
    const auto erk = end_of_ride(rig, {Method::erk, 1e-9}, 50);
    const auto cvode = end_of_ride(rig, {Method::cvode, 1e-9}, 50);
    EXPECT_NEAR(erk.state.joint.contraction_ratio, cvode.state.joint.contraction_ratio, 2e-8);
    EXPECT_NEAR(erk.state.side.muscle_pressure_Pa, cvode.state.side.muscle_pressure_Pa, 0.2);
    for (std::size_t i = 0; i < erk.memory.side.size(); ++i)
      EXPECT_NEAR(erk.memory.side[i], cvode.memory.side[i], 1e-6 * plant::memory_sizes[i]);
  }
}

TEST(Effects, AllAtOnceAreIntegratedByBothMethods) {
  const auto rig = plant::rig_with_all_effects();
  const auto erk = end_of_ride(rig, {Method::erk, 1e-9}, 50);
  const auto cvode = end_of_ride(rig, {Method::cvode, 1e-9}, 50);
  EXPECT_NEAR(erk.state.joint.contraction_ratio, cvode.state.joint.contraction_ratio, 2e-8);
}

// The least that is not nothing: a lag or a line so quick that it cannot be told from none.
TEST(Effects, NextToNothingIsNoTrouble) {
  const double nominal = end_of_ride({}, {}, 50).state.joint.contraction_ratio;
  plant::Rig lag, line;
  lag.effects.get<plant::ValveLag>().time_s = 1e-9;
  line.effects.get<plant::SupplyDroop>().line_resistance_s_Pa_per_kg = 1e-3;
  plant::Rig gas;
  gas.effects.get<plant::GasTemperature>().time_s = 1e-9;
  for (const auto& rig : {lag, line, gas})
    EXPECT_NEAR(end_of_ride(rig, {}, 50).state.joint.contraction_ratio, nominal, 3e-5);
}

TEST(Effects, GasMassAndEnergyAddUpWithLeakAndPulls) {
  plant::Rig rig;
  const auto on = [&]<class E>(E& effect) { plant::switch_on(effect, E::variants.front(), 2.0); };
  on(rig.effects.get<plant::MuscleLeak>());
  on(rig.effects.get<plant::ViscousDamping>());
  on(rig.effects.get<plant::GuideFriction>());
  on(rig.effects.get<plant::BladderElasticity>());
  on(rig.effects.get<plant::BladderCreep>());
  on(rig.effects.get<plant::SupplyDroop>());
  plant::switch_on(rig.effects.get<plant::ResidualForce>());
  rig.joint.load_offset_kg = 0.3;
  for (const auto method : {Method::erk, Method::cvode}) {
    RigOnBench bench(rig, 13.87, {method, 1e-10}, true);
    bench.start(4.0);
    const double gas_before_kg = bench.plant.gas_mass_kg(bench.flow.state);
    const double energy_before_J = bench.plant.mechanical_energy_J(bench.flow.state);
    for (int k = 0; k < 200; ++k) bench.hold(12.0 - 8.0 * std::cos(0.06 * k));
    const auto& books = bench.flow.ledger;
    EXPECT_GT(books.air_leaked_kg, 1e-5);
    EXPECT_NEAR(bench.plant.gas_mass_kg(bench.flow.state) - gas_before_kg,
                books.air_drawn_kg - books.air_vented_kg - books.air_leaked_kg, 1e-8 * books.air_drawn_kg);
    EXPECT_LT(books.effects_work_J, -0.05);
    EXPECT_NEAR(books.braid_work_J + books.stop_work_J - books.thread_friction_work_J - books.guide_work_J +
                    books.effects_work_J,
                bench.plant.mechanical_energy_J(bench.flow.state) - energy_before_J,
                1e-6 * books.thread_friction_work_J);
  }
}

// Gas of its own temperature: what flows is mass and carries energy, and both add up, over many cycles.
TEST(Effects, GasMassAndEnergyAddUpWithPolytropicGas) {
  plant::Rig rig;
  rig.effects.get<plant::PolytropicGas>().exponent = 1.4;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  for (const auto method : {Method::erk, Method::cvode}) {
    RigOnBench bench(rig, 13.87, {method, 1e-9}, true);
    bench.start(4.0);
    const auto before = bench.flow.state;
    for (int k = 0; k < 1500; ++k) bench.hold(12.0 - 8.0 * std::cos(0.1 * k));
    const auto& books = bench.flow.ledger;
    EXPECT_GT(books.air_leaked_kg, 1e-4);
    const auto imbalance = bench.plant.imbalance(before, bench.flow.state, books);
    EXPECT_LT(imbalance.gas, 1e-7);
    EXPECT_LT(imbalance.energy, 1e-7);
    // p V = m R T, in both volumes at once: the temperature has not run away.
    const double warmth =
        bench.plant.gas_mass_kg(bench.flow.state) / (books.valve_air_kg + books.muscle_air_kg);
    EXPECT_GT(warmth, 0.7);
    EXPECT_LT(warmth, 1.4);
  }
}

// With the hose shut nothing flows: T V^(n-1) stays.
TEST(Effects, EnclosedPolytropicGasGrowsColdAsItExpands) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;
  rig.effects.get<plant::PolytropicGas>().exponent = 1.4;
  RigOnBench bench(rig, 11.138, {Method::erk, 1e-10}, true);
  bench.start(14.0);
  const plant::Braid braid(rig.muscle);
  const auto volume_m3 = [&] { return braid.volume_m3(bench.flow.state.joint.contraction_ratio); };
  const auto temperature_K = [&] {
    return (bench.flow.state.side.muscle_pressure_Pa + 101325.0) * volume_m3() /
           (287.05 * bench.flow.ledger.muscle_air_kg);
  };
  const double first_m3 = volume_m3();
  EXPECT_NEAR(temperature_K(), 293.15, 1e-9);
  bench.hold(14.0, 5);
  EXPECT_LT(temperature_K(), 260.0);
  EXPECT_NEAR(temperature_K() / 293.15, std::pow(first_m3 / volume_m3(), 0.4), 5e-4);
}

// What is remembered of the temperature is that of the mass in the books, and mass and energy add up.
TEST(Effects, GasThatWarmsUpKeepsItsBooks) {
  plant::Rig rig;
  rig.effects.get<plant::GasTemperature>().time_s = 0.2;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  for (const auto method : {Method::erk, Method::cvode}) {
    RigOnBench bench(rig, 13.87, {method, 1e-9}, true);
    bench.start(4.0);
    const auto before = bench.flow.state;
    double warmest = 0.0, coldest = 0.0;
    for (int k = 0; k < 300; ++k) {
      bench.hold(12.0 - 8.0 * std::cos(0.1 * k));
      const auto& side = bench.flow.state.side;
      const double per_kg = (side.muscle_pressure_Pa + 101325.0) *
                            plant::Braid(rig.muscle).volume_m3(bench.flow.state.joint.contraction_ratio) /
                            bench.plant.side().gas_energy_J_per_kg();
      const double excess = per_kg / bench.flow.ledger.muscle_air_kg - 1.0;
      double remembered = 0.0;
      for (const double one : bench.flow.memory.side) remembered += one;  // nothing else has a memory here
      EXPECT_NEAR(remembered, excess, 1e-5);
      warmest = std::max(warmest, excess);
      coldest = std::min(coldest, excess);
    }
    EXPECT_GT(warmest, 0.02);
    EXPECT_LT(coldest, -0.02);
    const auto imbalance = bench.plant.imbalance(before, bench.flow.state, bench.flow.ledger);
    EXPECT_LT(imbalance.gas, 1e-7);
    EXPECT_LT(imbalance.energy, 1e-7);
  }
}

TEST(Effects, AnEnclosedMuscleThatMovesKeepsPVn) {
  plant::Rig isothermal, polytropic, hot;
  polytropic.effects.get<plant::PolytropicGas>().exponent = 1.4;
  hot.effects.get<plant::GasTemperature>().time_s = 100.0;  // no time for heat to go
  for (const auto& [n, rig] : {std::pair{1.0, &isothermal}, {1.4, &polytropic}, {1.4, &hot}}) {
    rig->hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
    RigOnBench bench(*rig, 11.138, {Method::erk, 1e-10});
    bench.start(14.0);  // and nothing holds the load
    const plant::Braid braid(rig->muscle);
    const auto invariant = [&] {
      return (bench.flow.state.side.muscle_pressure_Pa + 101325.0) *
             std::pow(braid.volume_m3(bench.flow.state.joint.contraction_ratio), n);
    };
    const double before = invariant();
    bench.hold(14.0, 5);
    EXPECT_GT(bench.flow.state.joint.contraction_ratio, 0.05);
    EXPECT_NEAR(invariant() / before, 1.0, 5e-4) << n;
  }
}

// Choked all the way, from a muscle that cannot move: the absolute pressure falls exponentially.
TEST(Effects, ALeakEmptiesARigidMuscleExponentially) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;
  rig.muscle.stop_stiffness_N_per_m = 1e8;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-9;
  RigOnBench bench(rig, 300.0, {Method::erk, 1e-9});
  bench.start(20.0);
  bench.hold(20.0, 20);
  const double volume_m3 = plant::Braid(rig.muscle).volume_m3(0.0), t = 20 * 0.012;
  const double rate_per_s = 1e-9 * 1.185 * 287.05 * 293.15 / volume_m3;
  EXPECT_NEAR(bench.flow.state.side.muscle_pressure_Pa + 101325.0, 601325.0 * std::exp(-rate_per_s * t), 6e2);
}

TEST(Effects, ALaggingValveOpensExponentially) {
  plant::Rig rig;
  rig.effects.get<plant::ValveLag>().time_s = 0.02;
  RigOnBench bench(rig, 23.406, {Method::erk, 1e-9});
  bench.start(4.0);
  bench.hold(20.0);  // a tick later the error is still more than the band: fully open is wanted
  const auto now = bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held);
  EXPECT_NEAR(now.valve_opening, 1.0 - std::exp(-0.012 / 0.02), 1e-8);
}

TEST(Effects, WarmingUpIsExponentialInTime) {
  plant::Rig rig;
  rig.effects.get<plant::FrictionWarmUp>() = {.change = -0.4, .time_s = 0.5};
  RigOnBench bench(rig, 13.87, {Method::erk, 1e-9});
  bench.start(4.0);
  bench.hold(12.0, 30);
  const auto level_N = [&](const plant::Memory<double>& memory) {
    const double floor_N = rig.friction.floor_N;  // not friction of the threads, so it does not warm up
    return bench.plant.moment(bench.flow.state, memory, bench.held).friction_level_N - floor_N;
  };
  EXPECT_NEAR(level_N(bench.flow.memory) / level_N({}), 1.0 - 0.4 * (1.0 - std::exp(-30 * 0.012 / 0.5)),
              1e-8);
}

TEST(Effects, CreepIsForgottenAndTheSupplyOnlySinks) {
  plant::Rig rig;
  rig.effects.get<plant::BladderCreep>() = {.stiffness_N_per_m = 200.0, .time_s = 0.05};
  rig.effects.get<plant::SupplyDroop>() = {.volume_m3 = 3e-4, .line_resistance_s_Pa_per_kg = 5e7};
  RigOnBench bench(rig, 13.87, {Method::erk, 1e-7});
  bench.start(4.0);
  const auto pull_N = [&] {
    return bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held).effects_pull_N;
  };
  double largest_N = 0.0, deepest_Pa = 0.0;
  for (int k = 0; k < 100; ++k) {
    bench.hold(16.0);
    largest_N = std::min(largest_N, pull_N());
    const double drop_Pa = rig.effects.supply_drop_Pa(bench.flow.memory.side);
    EXPECT_GE(drop_Pa, 0.0);
    deepest_Pa = std::max(deepest_Pa, drop_Pa);
  }
  EXPECT_LT(largest_N, -1.0);
  EXPECT_GT(deepest_Pa, 1e4);
  bench.hold(16.0, 100);
  EXPECT_NEAR(pull_N(), 0.0, 0.02);
  EXPECT_LT(rig.effects.supply_drop_Pa(bench.flow.memory.side), 1e3);
}

// A load that sticks exactly is loosened by an effect as by anything else.
TEST(Effects, CoulombFrictionTakesThemToo) {
  for (auto& [name, rig] : plant::rigs_with_one_effect()) {
    rig.friction.memory = plant::FrictionMemory::coulomb;
    const auto erk = end_of_ride(rig, {Method::erk, 1e-8}, 40);
    const auto cvode = end_of_ride(rig, {Method::cvode, 1e-8}, 40);
    EXPECT_NEAR(erk.state.joint.contraction_ratio, cvode.state.joint.contraction_ratio, 1e-6) << name;
  }
}

TEST(Effects, TakeTheSameStepsWithAndWithoutTheLedger) {
  const auto rig = plant::rig_with_all_effects();
  RigOnBench plain(rig, 11.138, {Method::erk, 1e-6}), audited(rig, 11.138, {Method::erk, 1e-6}, true);
  for (auto* bench : {&plain, &audited}) {
    bench->start(4.0);
    for (int k = 0; k < 60; ++k) bench->hold(stepped_mA(k));
  }
  EXPECT_EQ(std::memcmp(&plain.flow.state, &audited.flow.state, sizeof plain.flow.state), 0);
  EXPECT_EQ(plain.flow.memory.side, audited.flow.memory.side);
}

}  // namespace
}  // namespace mckibben::engine
