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
        const Hanging hanging{rig, load_kg};
        const auto predicted = predict(run, {&hanging, 1}, method).front();

        controllers::RecordedCurrent recorded;
        recorded.samples_mA = run.current_mA;
        const auto controller = recorded.make(run::knowledge_of(rig, {}));
        const auto simulated = run::simulate({.rig = rig,
                                              .load_kg = load_kg,
                                              .ticks = run.current_mA.size(),
                                              .engine = settings_for({&hanging, 1}, method)},
                                             *controller);
        ASSERT_EQ(simulated.failure, "") << name;
        ASSERT_EQ(simulated.samples.size(), predicted.states.size());
        const double length_m = rig.muscle.rest_length_m;
        plant::PulseCounter counter(rig.encoder.wiring, plant::count_height_m(rig.encoder, rig.joint));
        for (std::size_t k = 0; k < predicted.states.size(); ++k) {
          const run::Sample& sample = simulated.samples[k];
          ASSERT_EQ(std::memcmp(&sample.state, &predicted.states[k], sizeof sample.state), 0)
              << name << ", " << input::spelling(method) << ", row " << k;
          ASSERT_EQ(sample.gauge_Pa, plant::gauge_reading_Pa(rig.gauge, predicted.pressure_Pa[k]));
          ASSERT_EQ(sample.counts, counter.count(predicted.judged[k] * length_m)) << name;
        }
        EXPECT_GT(predicted.judged.back(), 0.01) << name;
      }
}

// What a parameter does to a rig that has no common steps must not drown in the noise of steps.
TEST(Predict, DifferencesOfCoulombRigsAreSensitivities) {
  const domain::Run run = up_and_down(150);
  const auto slope = [&](double h) {
    plant::Rig rig;
    rig.friction.memory = plant::FrictionMemory::coulomb;
    const Hanging near{rig, load_kg};
    Hanging far = near;
    far.rig.muscle.rest_radius_m += h;
    const Hanging both[] = {near, far};
    const auto readings = predict(run, both);
    return (readings[1].judged[130] - readings[0].judged[130]) / h;
  };
  const double steep = slope(3e-5);  // some 20 times the step that diagnose takes
  EXPECT_GT(std::abs(steep), 1.0);
  EXPECT_NEAR(slope(1.5e-6), steep, 0.05 * std::abs(steep));
}

}  // namespace
}  // namespace mckibben::diagnose
