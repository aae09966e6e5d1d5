// Eight rigs in the lanes of one number do what each of them does alone, on any machine.
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <sim/engine/batch.hpp>
#include <sim/engine/vectorised.hpp>

#include "random_rigs.hpp"
#include "regulators.hpp"

namespace mckibben::engine {
namespace {

using plant::Chance;

template <class F>
Lanes of_each(const F& f) {
  Lanes x;
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) x.set(lane, f(lane));
  return x;
}

TEST(Lanes, CalculateLikeDoubles) {
  Chance chance(1);
  const auto one = [&](std::size_t) { return chance.between(-3.0, 3.0); };
  const auto check = [](const char* what, const Lanes& got, const auto& expected) {
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) EXPECT_EQ(got[lane], expected(lane)) << what;
  };
  for (int i = 0; i < 100; ++i) {
    const Lanes a = of_each(one), b = of_each(one);
    check("+", a + b, [&](auto l) { return a[l] + b[l]; });
    check("-", a - b, [&](auto l) { return a[l] - b[l]; });
    check("*", a * b, [&](auto l) { return a[l] * b[l]; });
    check("/", a / b, [&](auto l) { return a[l] / b[l]; });
    check("abs", abs(a), [&](auto l) { return std::abs(a[l]); });
    check("max", max(a, b), [&](auto l) { return std::max(a[l], b[l]); });
    check("sqrt", sqrt(a * a), [&](auto l) { return std::sqrt(a[l] * a[l]); });
    check("exp", exp(a), [&](auto l) { return std::exp(a[l]); });
    check("sin", sin(a), [&](auto l) { return std::sin(a[l]); });
    check("cos", cos(a), [&](auto l) { return std::cos(a[l]); });
    check("tanh", tanh(a), [&](auto l) { return std::tanh(a[l]); });
    check("pow", pow(abs(a), b), [&](auto l) { return std::pow(std::abs(a[l]), b[l]); });
    check("select", select(a < b, a, b), [&](auto l) { return std::min(a[l], b[l]); });
    const auto twice = [](const Lanes& x) { return [&x] { return x + x; }; };
    check("choose", choose(a > b, twice(a), twice(b)), [&](auto l) { return 2.0 * std::max(a[l], b[l]); });
  }
}

TEST(Lanes, LogarithmIsGoodToTheLastPlace) {
  Chance chance(2);
  for (int i = 0; i < 20000; ++i) {
    const Lanes x = of_each([&](std::size_t lane) {
      return lane < 4 ? chance.log_between(1e-300, 1e300) : chance.between(0.9, 1.1);
    });
    const Lanes y = log(x);
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const double exact = std::log(x[lane]), spacing = std::abs(std::nextafter(exact, 1e9) - exact);
      ASSERT_NEAR(y[lane], exact, 1.01 * spacing) << x[lane];
    }
  }
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_TRUE(std::isnan(log(Lanes(bad))[5])) << bad;
  EXPECT_EQ(log(Lanes(1.0))[0], 0.0);
}

TEST(Lanes, NobodyIsLeftOutOfAQuestion) {
  EXPECT_FALSE(any(Mask{}));
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
    Lanes x = 0.0;
    x.set(lane, std::nan(""));
    EXPECT_TRUE(any(!isfinite(x))) << lane;
    EXPECT_FALSE(isfinite(x)[lane]);
    EXPECT_TRUE(isfinite(x)[(lane + 1) % Lanes::count]);
  }
}

/// Rigs that differ in all their numbers, and states of them.
struct Eight {
  std::vector<plant::Plant> plants;
  plant::State<Lanes> state{};
  plant::Memory<Lanes> memory{};
  std::vector<plant::Held> held;

  Eight(Chance& chance, const plant::Rig& rig) {
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      plant::Rig one = rig;
      const auto vary = [&](double& value) { value *= chance.between(0.9, 1.1); };
      vary(one.muscle.rest_radius_m);
      vary(one.muscle.braid_angle_rad);
      vary(one.friction.scale);
      vary(one.valve.volume_m3);
      vary(one.valve.time_constant_s);
      vary(one.valve.natural_frequency_Hz);
      vary(one.valve.dead_band_Pa);
      vary(one.hose.conductance_m3_per_s_Pa);
      vary(one.joint.guide_damping_N_s_per_m);
      vary(one.joint.stop_N_per_m);
      if (plant::Lever* lever = one.lever()) {
        vary(lever->base_m);
        vary(lever->mass_kg);
        vary(lever->hangs_at_rad);
        for (auto& line : lever->arms) vary(line.arm_m);
      }
      plants.push_back(plant::plant_of(one, chance.between(8.0, 25.0)));
      state.joint.contraction_ratio.set(lane, chance.between(-0.01, 0.28));
      state.joint.contraction_speed_per_s.set(lane, chance.between(-2.0, 2.0));
      state.side.valve_pressure_Pa.set(lane, chance.between(-0.5e5, 6e5));
      state.side.muscle_pressure_Pa.set(lane, chance.between(-0.5e5, 6e5));
      state.side.bristle_m.set(lane, chance.between(-1e-3, 1e-3));
      for (std::size_t i = 0; i < memory.side.size(); ++i)
        memory.side[i].set(lane, chance.between(-1.0, 2.0) * plant::memory_sizes[i]);
      held.emplace_back();
      held.back().reference_pressure_Pa = chance.between(0.5e5, 5e5);
      held.back().current_speed_mA_per_s = chance.between(-50.0, 50.0);
      held.back().supply_above_Pa = chance.between(-1e5, 1e5);
    }
  }

  std::vector<Lanes> rates() const {
    const auto all = vectorised(plants).value();
    plant::HeldOf<Lanes> holds;
    for (std::size_t lane = 0; lane < held.size(); ++lane) put(held[lane], lane, holds);
    const auto now = all.moment<1>(state, memory, holds);
    const auto dt = all.rates<1>(state, now);
    std::vector<Lanes> list{dt.joint.contraction_ratio, dt.joint.contraction_speed_per_s,
                            dt.side.valve_pressure_Pa, dt.side.muscle_pressure_Pa, dt.side.bristle_m};
    if (all.remembers()) list.insert(list.end(), now.memory_rates.begin(), now.memory_rates.end());
    return list;
  }

  std::vector<double> rates_alone(std::size_t lane) const {
    const plant::State<double> at{
        {state.joint.contraction_ratio[lane], state.joint.contraction_speed_per_s[lane]},
        {state.side.valve_pressure_Pa[lane], state.side.muscle_pressure_Pa[lane], state.side.bristle_m[lane]},
        {}};
    plant::Memory<double> remembered{};
    for (std::size_t i = 0; i < memory.side.size(); ++i) remembered.side[i] = memory.side[i][lane];
    const auto now = plants[lane].moment<1>(at, remembered, held[lane]);
    const auto dt = plants[lane].rates<1>(at, now);
    std::vector<double> list{dt.joint.contraction_ratio, dt.joint.contraction_speed_per_s,
                             dt.side.valve_pressure_Pa, dt.side.muscle_pressure_Pa, dt.side.bristle_m};
    if (plants[lane].remembers()) list.insert(list.end(), now.memory_rates.begin(), now.memory_rates.end());
    return list;
  }
};

void expect_alike(const Eight& eight, const std::string& what) {
  const auto together = eight.rates();
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
    const auto alone = eight.rates_alone(lane);
    ASSERT_EQ(together.size(), alone.size()) << what;
    for (std::size_t i = 0; i < alone.size(); ++i)
      EXPECT_NEAR(together[i][lane], alone[i], 1e-11 * (std::abs(alone[i]) + 1.0)) << what << ' ' << i;
  }
}

TEST(Vectorised, RigsKeepToTheirOwnLaws) {
  Chance chance(3);
  for (const auto law : {plant::FrictionLaw::superposition, plant::FrictionLaw::area,
                         plant::FrictionLaw::logarithmic, plant::FrictionLaw::power})
    for (int i = 0; i < 100; ++i) {
      plant::Rig rig;
      rig.friction.law = law;
      expect_alike(Eight(chance, rig), "law " + std::to_string(static_cast<int>(law)));
    }
  for (const auto& [name, rig] : plant::rigs_with_one_effect())
    for (int i = 0; i < 100; ++i) expect_alike(Eight(chance, rig), name);
  for (plant::Rig rig : {plant::quick_regulator(0.1), plant::swinging_regulator(5.0, 0.7)}) {
    rig.valve.dead_band_Pa = 5e3;
    for (int i = 0; i < 100; ++i) expect_alike(Eight(chance, rig), "regulator");
  }
  for (int i = 0; i < 100; ++i) expect_alike(Eight(chance, plant::rig_with_all_effects()), "all effects");
}

TEST(Vectorised, LeversKeepToTheirOwnArms) {
  Chance chance(5);
  plant::Rig points, table, hanging;
  plant::Lever lever;
  lever.base_m = 0.5;
  lever.attached_m = 0.06;
  lever.spring_N_m_per_rad = 2.0;
  points.mechanics = lever;
  points.joint.lowest_rad = 0.2;
  points.joint.highest_rad = 1.2;
  lever.arms = {{-0.5, 0.03}, {0.5, 0.06}, {2.0, 0.04}};
  lever.spring_ways = plant::SpringWays::one;
  table.mechanics = lever;
  hanging.joint.highest_ratio = 0.1;
  for (int i = 0; i < 100; ++i) {
    expect_alike(Eight(chance, points), "points");
    expect_alike(Eight(chance, table), "table");
    expect_alike(Eight(chance, hanging), "stops");
  }
  const plant::Plant one = plant::plant_of(points), other = plant::plant_of(table),
                     neither = plant::plant_of(hanging);
  const auto kind = [](const plant::Plant& a, const plant::Plant& b) {
    return kind_of(std::array{&a, &b}).has_value();
  };
  EXPECT_TRUE(kind(one, one));
  EXPECT_FALSE(kind(one, other));
  EXPECT_FALSE(kind(one, neither));
}

TEST(Vectorised, OnlySomeHaveCordsThatStretch) {
  Chance chance(6);
  plant::Rig rig;
  rig.effects.get<plant::GuideFriction>().coefficient = 0.02;
  for (int i = 0; i < 100; ++i) {
    plant::Rig corded = rig;
    corded.muscle.cord = {chance.log_between(1e4, 1e6), 100.0, chance.between(0.05, 0.5)};
    expect_alike(Eight(chance, corded), "all");
    Eight eight(chance, corded);
    for (std::size_t lane = 0; lane < Lanes::count; lane += 2) {
      eight.plants[lane] = plant::plant_of(rig, chance.between(8.0, 25.0));
      eight.memory.side[plant::cord_stretch].set(lane, 0.0);  // as it stays without one
    }
    const auto together = eight.rates();
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const auto alone = eight.rates_alone(lane);
      for (std::size_t k = 0; k < alone.size(); ++k)
        EXPECT_NEAR(together[k][lane], alone[k], 1e-11 * (std::abs(alone[k]) + 1.0)) << lane << ' ' << k;
    }
  }
}

TEST(Vectorised, AnEffectOfOneRigIsNotItsNeighbours) {
  Chance chance(4);
  const auto rigs = plant::rigs_with_one_effect();
  for (std::size_t first = 0; first < rigs.size(); ++first) {
    Eight eight(chance, plant::Rig{});
    std::string names;
    for (std::size_t lane = 0; lane < Lanes::count; lane += 2) {  // every second rig has another effect
      const auto& [name, rig] = rigs[(first + 2 * lane) % rigs.size()];
      plant::Rig struck = eight.plants[lane].rig();
      struck.effects = rig.effects;
      eight.plants[lane] = {struck, eight.plants[lane].load_kg()};
      names += name + ' ';
    }
    const auto together = eight.rates();
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const auto alone = eight.rates_alone(lane);
      for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(together[i][lane], alone[i], 1e-11 * (std::abs(alone[i]) + 1.0)) << names << lane;
    }
  }
}

TEST(Vectorised, TermsOfALawAreEachTheirOwn) {
  using plant::Basis;
  Chance chance(6);
  Eight eight(chance, plant::Rig{});
  const auto give = [&](std::size_t lane, std::vector<plant::ForceTerm> terms) {
    plant::Rig rig = eight.plants[lane].rig();
    rig.effects.get<plant::ResidualForce>().terms = std::move(terms);
    eight.plants[lane] = {rig, eight.plants[lane].load_kg()};
  };
  give(1, {{Basis::speed, 3.0}});
  give(2, {{Basis::sine, 4.0, 0.02, 0.3}, {Basis::sine, -2.0, 0.05, 1.0}});
  give(5, {{Basis::direction_pressure, 2.0}, {Basis::speed, -1.0}});
  give(7, {{Basis::sine, 1.0, 0.01, 0.0}});
  expect_alike(eight, "terms");
}

TEST(Vectorised, RigsOfAnotherKindAreNot) {
  plant::Rig area;
  area.friction.law = plant::FrictionLaw::area;
  EXPECT_FALSE(vectorised(std::vector<plant::Plant>{{plant::Rig{}, 12.0}, {area, 12.0}}).has_value());
  for (const plant::Rig& other : {plant::Rig{}, plant::swinging_regulator(5.0, 0.7)})
    EXPECT_FALSE(vectorised(std::vector<plant::Plant>{{plant::quick_regulator(0.1), 12.0}, {other, 12.0}})
                     .has_value());
  plant::Rig linear, saturating;
  linear.effects.get<plant::BladderElasticity>().stiffness_N_per_m = 50.0;
  auto& bladder = saturating.effects.get<plant::BladderElasticity>();
  bladder.variant = plant::BladderLaw::saturating;
  bladder.force_N = 5.0;
  EXPECT_FALSE(vectorised(std::vector<plant::Plant>{{linear, 12.0}, {saturating, 12.0}}).has_value());
  EXPECT_TRUE(vectorised(std::vector<plant::Plant>{{plant::Rig{}, 12.0}, {saturating, 12.0}}).has_value());
}

TEST(Vectorised, EachMachineGetsTheSameBits) {
#if defined(__x86_64__)
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  Chance chance(5);
  for (int i = 0; i < 20; ++i) {
    const Eight eight(chance, plant::rig_with_all_effects());
    std::vector<Lanes> plain, vectors;
    on_any_machine([&] { plain = eight.rates(); });
    with_avx2([&] { vectors = eight.rates(); });
    for (std::size_t k = 0; k < plain.size(); ++k)
      for (std::size_t lane = 0; lane < Lanes::count; ++lane)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(plain[k][lane]),
                  std::bit_cast<std::uint64_t>(vectors[k][lane]));
  }
#else
  GTEST_SKIP() << "one way only";
#endif
}

}  // namespace
}  // namespace mckibben::engine
