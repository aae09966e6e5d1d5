// Effects and slow disturbances through the tick loop: absent they change no bit, switched on they show, and
// controllers know nothing of them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/simulate.hpp>

#include "switched_on.hpp"

namespace mckibben::run {
namespace {

Recording ride(const plant::Rig& rig, std::size_t ticks = 100, const plant::Noise& noise = {},
               std::uint64_t seed = 1, const controllers::StepCurrent* held = nullptr) {
  controllers::SineCurrent sine;
  sine.low_mA = 5.0;
  sine.high_mA = 17.0;
  sine.period_s = 1.0;
  RunPlan plan;
  plan.rig = rig;
  plan.load_kg = 13.87;
  plan.ticks = ticks;
  plan.noise = noise;
  plan.seed = seed;
  const auto knowledge = knowledge_of(rig, {});
  const auto controller = held != nullptr ? held->make(knowledge) : sine.make(knowledge);
  auto recording = simulate(plan, *controller);
  EXPECT_EQ(recording.failure, "");
  return recording;
}

bool same_bits(const Recording& a, const Recording& b) {
  return std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const Sample& x, const Sample& y) { return std::memcmp(&x, &y, sizeof x) == 0; });
}

double reading_apart(const Recording& a, const Recording& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.samples.size(); ++k)
    largest = std::max(largest, std::abs(static_cast<double>(a.samples[k].counts - b.samples[k].counts)));
  return largest;
}

/// In kPa.
double gauge_apart(const Recording& a, const Recording& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.samples.size(); ++k)
    largest = std::max(largest, 1e-3 * std::abs(a.samples[k].shown[plant::Sensed::muscle_pressure] -
                                                b.samples[k].shown[plant::Sensed::muscle_pressure]));
  return largest;
}

TEST(EffectsInARun, AbsentTheyChangeNoBitWhateverTheirShapes) {
  const Recording nominal = ride({});
  std::mt19937_64 random(3);
  const auto expect_nothing = [&]<class E>(const E&) {
    for (const plant::Variant& variant : E::variants) {
      plant::Rig rig;
      for (const auto& parameter : plant::parameters_of(rig.effects.get<E>(), variant.name))
        if (const auto* const law = plant::sized_by<E>(variant, parameter.key))
          *parameter.value = law->absent;
        else
          *parameter.value = std::uniform_real_distribution(parameter.lowest, parameter.highest)(random);
      EXPECT_TRUE(same_bits(ride(rig), nominal)) << E::name;
    }
  };
  std::apply([&](const auto&... effect) { (expect_nothing(effect), ...); }, plant::Effects::Table{});
}

TEST(EffectsInARun, OfTypicalSizeEachShowsAndOfNextToNoSizeNone) {
  const Recording nominal = ride({});
  for (const auto& [name, rig] : plant::rigs_with_one_effect()) {
    const bool of_the_gauge = name.starts_with("gauge_error");
    EXPECT_GE((of_the_gauge ? gauge_apart : reading_apart)(ride(rig), nominal), 2.0) << name;
    if (of_the_gauge) {
      EXPECT_EQ(reading_apart(ride(rig), nominal), 0.0);
    }
  }
  const auto expect_little = [&]<class E>(const E&) {
    for (const plant::Variant& variant : E::variants) {
      plant::Rig rig;
      plant::switch_on(rig.effects.get<E>(), variant, 1e-4);
      EXPECT_LE(reading_apart(ride(rig), nominal), 1.0) << E::name;
    }
  };
  std::apply([&](const auto&... effect) { (expect_little(effect), ...); }, plant::Effects::Table{});
}

TEST(EffectsInARun, ControllersDoNotKnowThem) {
  plant::Rig rig = plant::rig_with_all_effects();
  rig.joint.load_offset_kg = 0.5;
  const auto known = knowledge_of(rig, {}), nominal = knowledge_of(plant::Rig{}, {});
  EXPECT_EQ(known.contraction_per_count, nominal.contraction_per_count);
  EXPECT_EQ(known.model.end_correction, nominal.model.end_correction);
  EXPECT_EQ(known.valve.zero_pressure_Pa, nominal.valve.zero_pressure_Pa);
  plant::Rig muscle;  // of which the rubber tube is a part
  muscle.effects.get<plant::BladderElasticity>() = rig.effects.get<plant::BladderElasticity>();
  const auto reach = reachable(rig), without = reachable(muscle);
  ASSERT_EQ(reach.loads.size(), without.loads.size());
  for (std::size_t i = 0; i < reach.loads.size(); ++i) {
    EXPECT_EQ(reach.loads[i].highest, without.loads[i].highest);
    EXPECT_EQ(reach.loads[i].rising_per_s, without.loads[i].rising_per_s);
    EXPECT_EQ(reach.loads[i].falling_lag_s, without.loads[i].falling_lag_s);
  }
}

TEST(EffectsInARun, ALoadOffsetIsSoMuchMoreLoad) {
  plant::Rig heavier;
  heavier.joint.load_offset_kg = 0.5;
  RunPlan plan;
  plan.load_kg = 14.0;
  plan.ticks = 50;
  RunPlan offset = plan;
  offset.load_kg = 13.5;
  offset.rig = heavier;
  controllers::StepCurrent current;
  current.start_mA = 12.0;
  const auto simulated = [&](const RunPlan& each) {
    const auto controller = current.make(knowledge_of(each.rig, {}));
    return simulate(each, *controller);
  };
  EXPECT_TRUE(same_bits(simulated(offset), simulated(plan)));
  offset.rig.joint.load_offset_kg = -14.0;
  EXPECT_NE(simulated(offset).failure.find("leave no load"), std::string::npos);
}

TEST(SlowDisturbances, OfNoSizeChangeNoBit) {
  const plant::Noise noise{.encoder_jitter = 1e-4, .gauge_Pa = 50.0, .current_mA = 0.01};
  plant::Noise shaped = noise;
  shaped.ripple_period_s = 3.0;
  shaped.wander_time_s = 0.7;
  EXPECT_TRUE(same_bits(ride({}, 100, noise), ride({}, 100, shaped)));
}

controllers::StepCurrent held_current() {
  controllers::StepCurrent current;
  current.start_mA = 12.0;
  return current;
}

TEST(SlowDisturbances, RippleIsASineOfThatSizeWithAPhaseByChance) {
  const auto current = held_current();
  const plant::Noise noise{.ripple_Pa = 1e4, .ripple_period_s = 3.0};
  const auto pressures = [&](std::uint64_t seed) {
    std::vector<double> values;
    for (const auto& sample : ride({}, 500, noise, seed, &current).samples)
      values.push_back(sample.state.side.valve_pressure_Pa);
    return values;
  };
  const auto first = pressures(1), other = pressures(2);
  for (const auto& each : {first, other}) {
    const auto [low, high] = std::minmax_element(each.begin(), each.end());
    EXPECT_NEAR(*high - *low, 2e4, 1e3);
    EXPECT_NEAR(each[400], each[150], 300.0);                   // a period later
    EXPECT_NEAR(0.5 * (each[300] + each[425]), 2.75e5, 500.0);  // half a period apart
  }
  EXPECT_GT(std::abs(first[200] - other[200]), 1e3);
  EXPECT_EQ(first, pressures(1));
}

TEST(SlowDisturbances, WanderHasItsSizeAndItsTime) {
  const auto current = held_current();
  const plant::Noise noise{.wander_Pa = 5e3, .wander_time_s = 0.6};
  double squares = 0.0, products = 0.0;
  constexpr std::size_t ticks = 4000, apart = 50;  // 80 correlation times; 0.6 s
  const auto recording = ride({}, ticks, noise, 3, &current);
  const auto off_Pa = [&](std::size_t k) {
    return recording.samples[k].state.side.valve_pressure_Pa - 2.75e5;
  };
  for (std::size_t k = 0; k + apart < ticks; ++k) {
    squares += off_Pa(k) * off_Pa(k);
    products += off_Pa(k) * off_Pa(k + apart);
  }
  EXPECT_NEAR(std::sqrt(squares / (ticks - apart)), 5e3, 1e3);
  EXPECT_NEAR(products / squares, std::exp(-1.0), 0.2);
}

}  // namespace
}  // namespace mckibben::run
