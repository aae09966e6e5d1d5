// The effects of the table one by one: what each may not do to energy, and its law where that has a closed
// form; and all of them together. What holds of every one: each_effect_test.cpp.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "chance.hpp"
#include "switched_on.hpp"

namespace mckibben::plant {
namespace {

TEST(Catalogue, HasTheNamesThatResultsAreComparedBy) {
  std::set<std::string_view> names;
  std::apply([&](const auto&... effect) { (names.insert(effect.name), ...); }, Effects::Table{});
  EXPECT_EQ(names.size(), Effects::count);
  for (const char* name : {"viscous_damping",     "guide_friction",       "speed_dependent_friction",
                           "bladder_elasticity",  "bladder_creep",        "bladder_hysteresis",
                           "end_cap_correction",  "pressure_threshold",   "muscle_leak",
                           "polytropic_gas",      "gas_temperature",      "valve_lag",
                           "valve_dead_band",     "valve_hysteresis",     "supply_droop",
                           "exhaust_restriction", "friction_warm_up",     "encoder_backlash",
                           "encoder_scale",       "isometric_hysteresis", "residual_law"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_EQ(ResidualForce::variants.size(), 0u);
}

TEST(Catalogue, ForcesThatDissipateNeverPush) {
  Chance chance;
  ViscousDamping viscous;
  GuideFriction guide;
  switch_on(viscous, ViscousDamping::variants[0]);
  switch_on(guide, GuideFriction::variants[0]);
  for (int i = 0; i < 200; ++i) {
    const auto now = chance.instant();
    EXPECT_LE(viscous.pull_N(now, 0.0) * now.speed_m_per_s, 0.0);
    EXPECT_LE(guide.pull_N(now, 0.0) * now.speed_m_per_s, 0.0);
    EXPECT_LE(std::abs(guide.pull_N(now, 0.0)), 0.02 * now.weight_N);
  }
}

TEST(Catalogue, CreepGivesBackNoMoreThanItStored) {
  Chance chance;
  BladderCreep creep{.stiffness_N_per_m = 300.0, .time_s = 0.7};
  for (int i = 0; i < 200; ++i) {
    const auto now = chance.instant();
    const double crept_m = chance.between(-0.02, 0.1), stretch_m = now.rise_m - crept_m;
    const double crept_rate = creep.memory_rate(now, Inflow<double>{}, crept_m);
    const double stored_W = 300.0 * stretch_m * (now.speed_m_per_s - crept_rate);
    EXPECT_LE(creep.pull_N(now, crept_m) * now.speed_m_per_s + stored_W, 1e-12);
    EXPECT_NEAR(creep.pull_N(now, now.rise_m), 0.0, 1e-12);  // crept to where it is: no force
  }
}

TEST(Catalogue, ElasticityDependsOnTheRiseAlone) {
  Chance chance;
  for (const Variant& variant : BladderElasticity::variants) {
    BladderElasticity elastic;
    switch_on(elastic, variant);
    for (int i = 0; i < 100; ++i) {
      const auto now = chance.instant();
      auto other = chance.instant();
      other.contraction_ratio = now.contraction_ratio;
      other.rise_m = now.rise_m;
      EXPECT_EQ(elastic.pull_N(now, 0.0), elastic.pull_N(other, 0.0));  // so round a cycle its work is zero
      EXPECT_LE(elastic.pull_N(now, 0.0) * now.rise_m, 0.0);
    }
  }
  const BladderElasticity saturating{.variant = BladderLaw::saturating, .force_N = 10.0, .ratio = 0.05};
  Instant<double> now{0.05, 0.015, 0.0, 0.0, 0.0, 0.0, 0.0, {}};
  EXPECT_NEAR(saturating.pull_N(now, 0.0), -10.0 * (1.0 - std::exp(-1.0)), 1e-12);
  BladderElasticity both = saturating;
  both.stiffness_N_per_m = 200.0;
  EXPECT_EQ(both.pull_N(now, 0.0), saturating.pull_N(now, 0.0));  // not of the law that is chosen
  both.variant = BladderLaw::saturating_linear;
  EXPECT_NEAR(both.pull_N(now, 0.0), saturating.pull_N(now, 0.0) - 200.0 * 0.015, 1e-12);
  now.contraction_ratio = -1e-9;  // straight on, without a kink
  EXPECT_NEAR(saturating.pull_N(now, 0.0) / -1e-9, -10.0 / 0.05, 1e-6);
}

TEST(Catalogue, FrictionFactorsStayPositive) {
  Chance chance;
  for (int i = 0; i < 200; ++i) {
    SpeedDependentFriction speed{chance.between(0.05, 5.0), chance.between(5e-4, 1.0)};
    FrictionWarmUp warm{chance.between(-0.95, 5.0), chance.between(0.1, 1e5)};
    const auto now = chance.instant();
    EXPECT_GE(speed.friction_factor(now, 0.0), 0.05);
    EXPECT_GE(warm.friction_factor(now, chance.between(0.0, 1.0)), 0.05 - 1e-12);
  }
  auto now = Chance().instant();
  const SpeedDependentFriction stribeck{0.6, 0.02};
  for (const double v : {0.02, -0.02}) {
    now.speed_m_per_s = v;
    EXPECT_NEAR(stribeck.friction_factor(now, 0.0), 0.6 + 0.4 * std::exp(-1.0), 1e-15);
  }
  now.speed_m_per_s = 0.0;
  EXPECT_EQ(stribeck.friction_factor(now, 0.0), 1.0);
}

TEST(Catalogue, GasOnlyLeaksOutAndAsIso6358SaysItDoes) {
  const MuscleLeak leak{1e-10};
  Instant<double> now = Chance().instant();
  now.muscle_pressure_Pa = 0.0;
  EXPECT_EQ(leak.outflow_kg_per_s(now), 0.0);
  for (const double P : {1.0, 1e3, 1e5, 5e5}) {
    now.muscle_pressure_Pa = P;
    EXPECT_GT(leak.outflow_kg_per_s(now), 0.0);
  }
  EXPECT_NEAR(leak.outflow_kg_per_s(now), 1e-10 * 1.185 * (5e5 + 101325.0), 1e-18);  // choked
}

TEST(Catalogue, ADeadBandIsTakenOffTheError) {
  const ValveDeadBand band{5e3};
  const auto left_Pa = [&](double error_Pa) { return error_Pa + band.valve_error_shift_Pa(error_Pa); };
  EXPECT_EQ(left_Pa(4e3), 0.0);
  EXPECT_EQ(left_Pa(-5e3), 0.0);
  EXPECT_EQ(left_Pa(7e3), 2e3);
  EXPECT_EQ(left_Pa(-8e3), -3e3);
}

TEST(Catalogue, APlayMovesOnlyWhenPushed) {
  Play play;
  EXPECT_EQ(play.follow(1.0, 0.5), 1.0);  // begins in the middle
  EXPECT_EQ(play.follow(1.4, 0.5), 1.0);
  EXPECT_EQ(play.follow(3.0, 0.5), 2.5);
  EXPECT_EQ(play.follow(2.1, 0.5), 2.5);
  EXPECT_EQ(play.follow(1.0, 0.5), 1.5);
}

TEST(Catalogue, BacklashIsAFullWidthAndTheScaleOfWhatTheWheelSays) {
  Effects effects;
  effects.get<EncoderBacklash>().width_m = 1e-3;
  effects.get<EncoderScale>().error = 0.02;
  Effects::Plays plays{};
  EXPECT_EQ(effects.wheel_m(0.0, plays), 0.0);
  EXPECT_NEAR(effects.wheel_m(0.01, plays), 1.02 * (0.01 - 0.5e-3), 1e-15);
  EXPECT_NEAR(effects.wheel_m(0.009, plays), 1.02 * (0.01 - 0.5e-3), 1e-15);
  EXPECT_NEAR(effects.wheel_m(0.0, plays), 1.02 * 0.5e-3, 1e-15);
  effects.get<ValveHysteresis>().half_width_Pa = 5e3;
  EXPECT_EQ(effects.reference_Pa(1e5, plays), 1e5);
  EXPECT_EQ(effects.reference_Pa(2e5, plays), 1.95e5);
  EXPECT_EQ(effects.reference_Pa(1.91e5, plays), 1.95e5);
}

TEST(Catalogue, EndCapsChangeTheForceOnly) {
  Rig capped, shifted;
  capped.effects.get<EndCapCorrection>().slope = 0.01;
  shifted.muscle.end_correction += 0.03;
  const State<double> state{{0.1, 0.0}, {3e5, 3e5, 0.0}, {}};
  const auto with = Plant(capped, 12.0).moment(state, Held{});
  EXPECT_NEAR(with.braid_force_N, Plant(shifted, 12.0).moment(state, Held{}).braid_force_N, 1e-9);
  EXPECT_EQ(with.volume_slope_m3, Plant(Rig{}, 12.0).moment(state, Held{}).volume_slope_m3);
}

// Braid and threads feel the pressure less the threshold; the gas does not.
TEST(Catalogue, AThresholdIsTakenOffThePressureThatPresses) {
  Rig tight;
  tight.effects.get<PressureThreshold>().pressure_Pa = 4e4;
  const auto at = [](const Rig& rig, double pressure_Pa) {
    return Plant(rig, 12.0).moment(State<double>{{0.1, 0.0}, {pressure_Pa, pressure_Pa, 0.0}, {}}, Held{});
  };
  const auto with = at(tight, 3e5), less = at({}, 2.6e5), below = at(tight, 3e4), vacuum = at(tight, -1e4);
  EXPECT_NEAR(with.braid_force_N, less.braid_force_N, 1e-9);
  EXPECT_NEAR(with.friction_level_N, less.friction_level_N, 1e-9);
  EXPECT_EQ(below.braid_force_N, 0.0);
  EXPECT_EQ(below.friction_level_N, tight.friction.floor_N);
  EXPECT_EQ(vacuum.braid_force_N, at({}, -1e4).braid_force_N);
  EXPECT_EQ(with.vent_flow, at({}, 3e5).vent_flow);
}

TEST(Catalogue, ARestrictedExhaustHindersTheWayOutOnly) {
  Rig narrow;
  narrow.effects.get<ExhaustRestriction>().share = 0.3;
  const State<double> state{{0.1, 0.0}, {3e5, 3e5, 0.0}, {}};
  for (const double reference_Pa : {1e5, 5e5}) {
    Held held;
    held.reference_pressure_Pa = reference_Pa;
    const auto with = Plant(narrow, 12.0).moment(state, held),
               without = Plant(Rig{}, 12.0).moment(state, held);
    EXPECT_NEAR(with.vent_flow, 0.7 * without.vent_flow, 1e-15);
    EXPECT_EQ(with.supply_flow, without.supply_flow);
  }
}

// After a long way the force stands at F_h against it; a reversal over x_h ln 2 brings it to nothing.
TEST(Catalogue, HysteresisOfTheBladderGoesByTheWayAlone) {
  const BladderHysteresis rubber{.force_N = 8.0, .stroke_m = 0.01};
  for (const double speed_m_per_s : {0.05, -0.4}) {
    Instant<double> now = Chance().instant();
    const double way = speed_m_per_s > 0.0 ? 1.0 : -1.0;
    const auto go = [&](double wound, double way_m) {
      constexpr int steps = 10000;
      for (int i = 0; i < steps; ++i)
        wound += way_m / std::abs(speed_m_per_s) / steps * rubber.memory_rate(now, Inflow<double>{}, wound);
      return wound;
    };
    now.speed_m_per_s = speed_m_per_s;
    const double far = go(0.0, 0.2);
    EXPECT_NEAR(rubber.pull_N(now, far, {}), -8.0 * way, 1e-6);
    now.speed_m_per_s = -speed_m_per_s;
    EXPECT_NEAR(rubber.pull_N(now, go(far, 0.01 * std::log(2.0)), {}), 0.0, 1e-3);
  }
}

// From rest, a way x bends a stop of width x_i to 1 - exp(-x/x_i): widths 5, 10 and 15 mm of three.
TEST(Catalogue, StopsOfTheBladderAddUp) {
  const BladderHysteresis rubber{.force_N = 9.0, .stroke_m = 0.01, .stops = 3};
  Instant<double> now = Chance().instant();
  now.speed_m_per_s = 0.1;
  const double way_m = 0.012;
  constexpr int steps = 100'000;
  double first = 0.0;
  Further<BladderHysteresis, double> others{};
  for (int i = 0; i < steps; ++i) {
    const double time_s = way_m / 0.1 / steps;
    const auto rates = rubber.further_rates(now, others);
    first += time_s * rubber.memory_rate(now, Inflow<double>{}, first);
    for (std::size_t k = 0; k < others.size(); ++k) others[k] += time_s * rates[k];
  }
  double wanted = 0.0;
  for (const double width_m : {0.005, 0.01, 0.015}) wanted += (1.0 - std::exp(-way_m / width_m)) / 3.0;
  EXPECT_NEAR(rubber.pull_N(now, first, others), -9.0 * wanted, 1e-4);
  EXPECT_EQ(others[2], 0.0);
}

// After a long rise the force is that of P - P_h, after a long fall that of P + P_h, and a reversal by
// P_z ln 2 brings it between them; below P_h it is none while P rises.
TEST(Catalogue, IsometricHysteresisFollowsThePressure) {
  const IsometricHysteresis lag{.pressure_Pa = 15.6e3, .turn_Pa = 5e3};
  Instant<double> now = Chance().instant();
  now.muscle_pressure_Pa = 3e5;
  now.braid_force_N = 300.0;
  const auto go = [&](double wound, double way_Pa) {
    constexpr int steps = 10000;
    Inflow<double> inflow{};
    inflow.pressure_rate_Pa_per_s = way_Pa;
    for (int i = 0; i < steps; ++i) wound += lag.memory_rate(now, inflow, wound) / steps;
    return wound;
  };
  const double risen = go(0.0, 2e5), fallen = go(risen, -2e5);
  EXPECT_NEAR(300.0 + lag.pull_N(now, risen), 300.0 * (3e5 - 15.6e3) / 3e5, 1e-9);
  EXPECT_NEAR(300.0 + lag.pull_N(now, fallen), 300.0 * (3e5 + 15.6e3) / 3e5, 1e-9);
  EXPECT_NEAR(lag.pull_N(now, go(risen, -5e3 * std::log(2.0))), 0.0, 1e-2);
  now.muscle_pressure_Pa = 5e3;
  now.braid_force_N = 5.0;
  EXPECT_NEAR(5.0 + lag.pull_N(now, risen), 0.0, 1e-9);
}

// dP/P = -n dV/V where no gas flows.
TEST(Catalogue, PolytropicGasKeepsPVn) {
  Rig rig;
  rig.effects.get<PolytropicGas>().exponent = 1.3;
  const State<double> state{{0.1, 0.7}, {3e5, 3e5, 0.0}, {}};
  const Plant plant(rig, 12.0);
  const auto now = plant.moment(state, Held{});
  EXPECT_NEAR(plant.rates(state, now).side.muscle_pressure_Pa / (3e5 + 101325.0),
              -1.3 * now.volume_slope_m3 * 0.7 / now.volume_m3, 1e-12);
}

TEST(Catalogue, TheResidualLawIsTheSumOfItsTerms) {
  ResidualForce law;
  const Instant<double> now{0.1, 0.03, -0.2, 3e5, 98.0665, 101325.0, 84150.0, {}, 2e5, 2e5, 200.0};
  for (const auto& [of, value] : names(Basis{})) {
    law.terms = {{of, 2.0, 0.12}};
    const double expected[] = {1.0, 0.1,  0.01, 3.0,  0.3,  0.2,  0.02, 0.002,
                               1.0, -2.0, -4.0, -1.0, -0.1, -3.0, 1.0,  0.0};
    EXPECT_NEAR(law.pull_N(now, 0.0), 2.0 * expected[static_cast<std::size_t>(of)], 1e-12) << value;
  }
  law.terms = {{Basis::constant, 2.0}, {Basis::pressure, -1.0}};
  EXPECT_NEAR(law.pull_N(now, 0.0), -1.0, 1e-12);
}

template <class T>
struct Turned;
template <class... E>
struct Turned<std::tuple<E...>> {
  template <std::size_t... i>
  static auto turn(std::index_sequence<i...>)
      -> EffectSet<double, std::tuple_element_t<sizeof...(E) - 1 - i, std::tuple<E...>>...>;
  using type = decltype(turn(std::index_sequence_for<E...>{}));
};

TEST(Catalogue, TheOrderOfTheTableDoesNotMatter) {
  const Effects forth = rig_with_all_effects().effects;
  Turned<Effects::Table>::type back;
  std::apply([&](auto&... effect) { ((effect = forth.get<std::decay_t<decltype(effect)>>()), ...); },
             back.all);
  Chance chance;
  Effects::Plays plays{}, others{};
  const auto same = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * (std::abs(a) + 1.0)); };
  for (int i = 0; i < 100; ++i) {
    const auto now = chance.instant();
    const auto memory = chance.memory().side;
    auto turned = memory;
    std::reverse(turned.begin(), turned.begin() + Effects::memories);  // what follows is the valve's
    const Inflow<double> inflow{chance.between(-1.0, 1.0),   chance.between(0.0, 1e-3),
                                chance.between(-1e-3, 1e-3), chance.between(0.0, 1e-4),
                                chance.between(1e-5, 1e-4),  chance.between(-1e-4, 1e-4)};
    same(forth.pull(now, memory).all_N, back.pull(now, turned).all_N);
    same(forth.pull(now, memory).on_load_N, forth.get<GuideFriction>().pull_N(now, 0.0));
    same(forth.friction_factor(now, memory), back.friction_factor(now, turned));
    same(forth.valve_opening(0.3, memory), back.valve_opening(0.3, turned));
    same(forth.supply_drop_Pa(memory), back.supply_drop_Pa(turned));
    const auto rates = forth.memory_rates(now, inflow, memory);
    auto turned_rates = back.memory_rates(now, inflow, turned);
    std::reverse(turned_rates.begin(), turned_rates.begin() + Effects::memories);
    for (std::size_t m = 0; m < rates.size(); ++m) same(rates[m], turned_rates[m]);
    same(forth.end_correction_shift(now), back.end_correction_shift(now));
    same(forth.pressing_shift_Pa(now), back.pressing_shift_Pa(now));
    same(forth.heating_Pa_per_s(now, inflow, memory), back.heating_Pa_per_s(now, inflow, turned));
    same(forth.vent_factor(), back.vent_factor());
    same(forth.valve_error_shift_Pa(1e4), back.valve_error_shift_Pa(1e4));
    same(forth.outflow_kg_per_s(now, memory), back.outflow_kg_per_s(now, turned));
    same(forth.gas_exponent(), back.gas_exponent());
    const double rise_m = chance.between(0.0, 0.1), wanted_Pa = chance.between(0.5e5, 5e5);
    same(forth.wheel_m(rise_m, plays), back.wheel_m(rise_m, others));
    same(forth.reference_Pa(wanted_Pa, plays), back.reference_Pa(wanted_Pa, others));
  }
}

TEST(Catalogue, DelaysAddUpAndLeaveThePlantAlone) {
  Rig rig;
  EXPECT_EQ(rig.effects.command_delay_s(), 0.0);
  rig.effects.get<CommandDelay>().time_s = 0.02;
  rig.effects.get<ReadingDelay>().time_s = 0.05;
  EXPECT_EQ(rig.effects.command_delay_s(), 0.02);
  EXPECT_EQ(rig.effects.reading_delay_s(), 0.05);
  const Plant late(rig, 12.0), prompt(Rig{}, 12.0);
  Chance chance;
  const auto state = chance.state();
  const auto memory = chance.memory();
  EXPECT_EQ(all_of(late, state, memory), all_of(prompt, state, memory));
  EXPECT_FALSE(late.remembers());
}

}  // namespace
}  // namespace mckibben::plant
