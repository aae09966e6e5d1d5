// `predict` and the tick loop ride the same ride: of the same current they make the same bits.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/run/simulate.hpp>

#include "switched_on.hpp"

namespace mckibben::diagnose {
namespace {

constexpr double load_kg = 13.87;

domain::Run up_and_down(std::size_t rows) {
  domain::Run run;
  run.load_kg = load_kg;
  run.read("contraction");
  for (std::size_t k = 0; k < rows; ++k)
    run.current_mA.push_back(11.0 - 6.0 * std::cos(0.12 * static_cast<double>(k)));
  return run;
}

TEST(Predict, MakesOfACurrentTheSameBitsAsSimulate) {
  auto rigs = plant::rigs_with_one_effect();
  rigs.push_back({"none", {}});
  rigs.push_back({"all", plant::rig_with_all_effects()});
  const domain::Run run = up_and_down(70);
  for (auto& [name, rig] : rigs)
    for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb})
      for (const auto method : {solver::Method::erk, solver::Method::cvode}) {
        rig.friction.memory = memory;
        rig.friction.f1_s2_per_mA2 = 1e-5;
        rig.settling_time_s = 0.24;
        const Loaded hanging{rig, load_kg};
        const auto predicted = predict(run, {&hanging, 1}, method).front();

        controllers::RecordedCurrent recorded;
        recorded.samples_mA = run.current_mA;
        const auto controller = recorded.make(run::knowledge_of(rig, {}));
        rig.integrator = settings_for({&hanging, 1}, method);
        const auto simulated =
            run::simulate({.rig = rig, .load_kg = load_kg, .ticks = run.current_mA.size()}, *controller);
        ASSERT_EQ(simulated.failure, "") << name;
        ASSERT_EQ(simulated.samples.size(), predicted.states.size());
        const double length_m = rig.muscle.rest_length_m;
        plant::PulseCounter counter(rig.sensors.position().wiring, plant::count_height_m(rig));
        for (std::size_t k = 0; k < predicted.states.size(); ++k) {
          const run::Sample& sample = simulated.samples[k];
          ASSERT_EQ(std::memcmp(&sample.state, &predicted.states[k], sizeof sample.state), 0)
              << name << ", " << plant::name_of(method) << ", row " << k;
          ASSERT_EQ(sample.shown[plant::Sensed::muscle_pressure],
                    plant::shown(rig.sensors.of(plant::Sensed::muscle_pressure), predicted.pressure_Pa[k]));
          ASSERT_EQ(sample.counts, counter.count(predicted.judged()[k] * length_m)) << name;
        }
        EXPECT_GT(predicted.judged().back(), 0.01) << name;
      }
}

// What a parameter does to a rig that has no common steps must not drown in the noise of steps.
TEST(Predict, DifferencesOfCoulombRigsAreSensitivities) {
  const domain::Run run = up_and_down(150);
  const auto slope = [&](double h) {
    plant::Rig rig;
    rig.friction.memory = plant::FrictionMemory::coulomb;
    const Loaded near{rig, load_kg};
    Loaded far = near;
    far.rig.muscle.rest_radius_m += h;
    const Loaded both[] = {near, far};
    const auto readings = predict(run, both);
    return (readings[1].judged()[130] - readings[0].judged()[130]) / h;
  };
  const double steep = slope(3e-5);  // some 20 times the step that diagnose takes
  EXPECT_GT(std::abs(steep), 1.0);
  EXPECT_NEAR(slope(1.5e-6), steep, 0.05 * std::abs(steep));
}

/// Runs under other loads, each for a rig with an effect, one a little different, and one that differs in
/// law.
std::vector<Wanted> several(const std::vector<domain::Run>& runs) {
  std::vector<Wanted> list;
  for (const auto& run : runs)
    for (auto& [name, rig] : plant::rigs_with_one_effect()) {
      Loaded aside{rig, run.load_kg};
      aside.rig.muscle.rest_radius_m *= 1.001;
      list.push_back({&run, {{rig, run.load_kg}, aside}});
    }
  list.back().rigs.back().rig.friction.memory = plant::FrictionMemory::coulomb;
  return list;
}

std::vector<std::vector<Readings>> all_of(const std::vector<Wanted>& list, unsigned threads, bool reversed) {
  std::vector<std::vector<Readings>> all(list.size());
  const auto number = [&](std::size_t i) { return reversed ? list.size() - 1 - i : i; };
  predict_all(
      list.size(), 2 * list.size(), threads, solver::Method::automatic,
      [&](std::size_t i) { return list[number(i)]; },
      [&](std::size_t i, std::vector<Readings> readings, const std::exception_ptr& failure) {
        EXPECT_EQ(failure, nullptr);
        all[number(i)] = std::move(readings);
      });
  return all;
}

TEST(Predict, SideBySideEachIsWhatItIsAlone) {
  std::vector<domain::Run> runs{up_and_down(50), up_and_down(30)};
  runs.back().load_kg = 7.0;
  const auto list = several(runs);
  const auto all = all_of(list, 1, false), otherwise = all_of(list, 3, true);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto alone = predict(*list[i].run, list[i].rigs);
    ASSERT_EQ(all[i].size(), 2u);
    for (std::size_t r = 0; r < 2; ++r) {
      EXPECT_EQ(all[i][r].judged(), otherwise[i][r].judged()) << i;
      EXPECT_EQ(all[i][r].pressure_Pa, otherwise[i][r].pressure_Pa) << i;
      for (std::size_t k = 0; k < alone[r].judged().size(); ++k)
        ASSERT_NEAR(all[i][r].judged()[k], alone[r].judged()[k], 2e-6) << i << ", " << k;
    }
    EXPECT_NE(all[i][0].judged(), all[i][1].judged());
  }
}

TEST(Predict, SideBySideOneThatFailsFailsAlone) {
  const std::vector<domain::Run> runs{up_and_down(30)};
  auto list = several(runs);
  const auto all = all_of(list, 2, false);
  Loaded& soft = list[3].rigs.back();  // its load falls past the range of the laws
  soft.rig.muscle.stop_stiffness_N_per_m = 1e3;
  soft.rig.muscle.stop_damping_s_per_m = 0.0;
  soft.load_kg = 400.0;
  std::vector<std::size_t> failed;
  predict_all(
      list.size(), 2 * list.size(), 1, solver::Method::automatic, [&](std::size_t i) { return list[i]; },
      [&](std::size_t i, const std::vector<Readings>& readings, const std::exception_ptr& failure) {
        if (failure) return failed.push_back(i);
        EXPECT_EQ(readings[1].judged(), all[i][1].judged()) << i;
      });
  EXPECT_EQ(failed, std::vector<std::size_t>{3});
}

}  // namespace
}  // namespace mckibben::diagnose
