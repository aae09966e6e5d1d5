// What is called reachable against simulated full-current steps and slow rides. The tables are quasi-static:
// they hold to 10 % where the flow decides, to 20 % where the load swings as well (docs/equations.md).
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

Recording ride(const plant::Rig& rig, double load_kg, double duration_s,
               const controllers::Settings& settings) {
  const auto controller = controllers::make(settings, knowledge_of(rig, {}));
  return simulate({.rig = rig,
                   .load_kg = load_kg,
                   .ticks = static_cast<std::size_t>(std::llround(duration_s / rig.tick_s))},
                  *controller);
}

controllers::StepCurrent step(double from_mA, double to_mA) {
  controllers::StepCurrent current;
  current.start_mA = from_mA;
  current.moves = {{0.12, to_mA}};
  return current;
}

// Time from one contraction ratio to another: simulated, between ticks by a straight line.
double simulated_s(const Recording& recording, double from, double to) {
  double at_s[2] = {0.0, 0.0};
  const double wanted[2] = {from, to};
  const bool up = to > from;
  for (int i = 0; i < 2; ++i)
    for (std::size_t k = 1; k < recording.samples.size(); ++k) {
      const auto &a = recording.samples[k - 1], &b = recording.samples[k];
      const double ea = a.state.joint.contraction_ratio, eb = b.state.joint.contraction_ratio;
      if (up ? eb < wanted[i] : eb > wanted[i]) continue;
      at_s[i] = a.time_s + (b.time_s - a.time_s) * (wanted[i] - ea) / (eb - ea);
      break;
    }
  return at_s[1] - at_s[0];
}

// The same from the table, at the largest speed all the way.
double table_s(const controllers::Reach& reach, const std::vector<double>& per_s, double from, double to) {
  constexpr int parts = 1000;
  double time_s = 0.0;
  for (int i = 0; i < parts; ++i)
    time_s += std::abs(to - from) / parts / reach.at_ratio(per_s, std::lerp(from, to, (i + 0.5) / parts));
  return time_s;
}

TEST(Reachable, FallAfterAFullStepOfCurrentTakesAsLongAsTheTableSays) {
  const plant::Rig rig;
  const auto reach = reachable(rig);
  for (const double load_kg : {11.138, 16.138, 23.406}) {
    const auto recording = ride(rig, load_kg, 5.0, [&] {
      controllers::StepCurrent current = step(4.0, 20.0);
      current.moves.push_back({3.0, 4.0});
      return current;
    }());
    const std::vector<Sample> down(recording.samples.begin() + 250, recording.samples.end());
    const Recording fall{.samples = down, .solver = {}};
    const double expected_s = table_s(reach, reach.at_load(load_kg).falling_per_s, 0.20, 0.09);
    EXPECT_NEAR(simulated_s(fall, 0.20, 0.09), expected_s, 0.2 * expected_s) << load_kg << " kg";
  }
}

TEST(Reachable, ADeadBandOfARegulatorIsNoLag) {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::regulator;
  rig.valve.time_constant_s = 0.1;
  const auto without = reachable(rig).at_load(16.138);
  rig.valve.dead_band_Pa = 1200.0;
  const auto with = reachable(rig).at_load(16.138);
  for (std::size_t i = 0; i < with.rising_lag_s.size(); ++i) {
    EXPECT_NEAR(with.rising_lag_s[i], without.rising_lag_s[i], 1e-9);
    EXPECT_LT(with.falling_lag_s[i], 0.5);
  }
}

TEST(Reachable, TheRubberTubeOfAMuscleCounts) {
  plant::Rig rig;
  auto& tube = rig.effects.get<plant::BladderElasticity>();
  tube.variant = plant::BladderLaw::saturating;
  tube.force_N = 150.0;
  rig.valve.conductance_m3_per_s_Pa /= 20.0;  // it does not swing past where friction holds it
  const auto recording = ride(rig, 16.138, 20.0, step(4.0, 20.0));
  const double top = recording.samples.back().state.joint.contraction_ratio;
  EXPECT_NEAR(reachable(rig).at_load(16.138).highest, top, 0.02 * top);
  EXPECT_GT(reachable({}).at_load(16.138).highest, 1.1 * top);
}

TEST(Reachable, RiseAfterAFullStepAgreesWhereTheFlowDecides) {
  plant::Rig rig;
  rig.valve.conductance_m3_per_s_Pa /= 20.0;  // a valve so slow that inertia does not matter
  const auto reach = reachable(rig);
  for (const double load_kg : {11.138, 16.138, 23.406}) {
    const auto recording = ride(rig, load_kg, 12.0, step(4.0, 20.0));
    const double expected_s = table_s(reach, reach.at_load(load_kg).rising_per_s, 0.08, 0.18);
    EXPECT_NEAR(simulated_s(recording, 0.08, 0.18), expected_s, 0.1 * expected_s) << load_kg << " kg";
  }
}

TEST(Reachable, EndsAreWhereASlowRideTurns) {
  const plant::Rig rig;
  const auto reach = reachable(rig);
  controllers::TriangleCurrent slow;
  slow.speed_mA_per_s = 1.0;
  slow.cycles = 1.0;
  for (const double load_kg : {11.138, 23.406}) {
    const auto recording = ride(rig, load_kg, 36.0, slow);
    const auto limits = reach.at_load(load_kg);
    EXPECT_NEAR(recording.largest_contraction_ratio, limits.highest, 3e-3) << load_kg << " kg";
    const double end = recording.samples.back().state.joint.contraction_ratio;
    EXPECT_NEAR(std::max(0.0, end), limits.lowest_falling, 3e-3) << load_kg << " kg";
  }
}

TEST(Reachable, LagIsThatOfASlowRamp) {
  const plant::Rig rig;
  const auto reach = reachable(rig);
  const double load_kg = 16.138, nu = 1.0;
  controllers::TriangleCurrent slow;
  slow.speed_mA_per_s = nu;
  const auto recording = ride(rig, load_kg, 31.0, slow);
  const auto limits = reach.at_load(load_kg);
  const double Pa_per_mA = 4.5e5 / 16.0;
  double sums_s[2][2] = {{0.0, 0.0}, {0.0, 0.0}};  // [rising, falling][simulated, table]
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const auto& now = recording.samples[k];
    const double e = now.state.joint.contraction_ratio;
    const bool rising = now.time_s < 16.0;
    if (e < 0.10 || e > 0.20 || std::abs(now.time_s - 16.0) < 1.0) continue;
    // A held current is on average half a tick old, which is not the valve's doing.
    const double line_mA = 0.5 * (now.current_mA + recording.samples[k - 1].current_mA);
    const double behind_Pa = 0.5e5 + (line_mA - 4.0) * Pa_per_mA - now.state.side.muscle_pressure_Pa;
    sums_s[rising ? 0 : 1][0] += (rising ? behind_Pa : -behind_Pa) / (Pa_per_mA * nu);
    sums_s[rising ? 0 : 1][1] += reach.at_ratio(rising ? limits.rising_lag_s : limits.falling_lag_s, e);
  }
  for (const auto& [simulated, table] : sums_s) EXPECT_NEAR(simulated, table, 0.15 * table);
}

TEST(Reachable, FastTargetsAreSlowedToTheTable) {
  const plant::Rig rig;
  const auto reach = reachable(rig);
  std::vector<double> target(800, 0.05);
  for (std::size_t k = 20; k < 400; ++k) target[k] = 0.22;
  for (const double load_kg : {11.138, 23.406, 60.0}) {
    const auto load = reach.at_load(load_kg);
    const auto followed = controllers::slowed(target, rig.tick_s, reach, load);
    for (std::size_t k = 1; k < followed.size(); ++k) {
      const double speed = (followed[k] - followed[k - 1]) / rig.tick_s;
      ASSERT_LE(speed, reach.at_ratio(load.rising_per_s, followed[k - 1]) + 1e-9);
      ASSERT_GE(speed, -reach.at_ratio(load.falling_per_s, followed[k - 1]) - 1e-9);
      ASSERT_LE(followed[k], load.highest + 1e-12);
    }
  }
}

}  // namespace
}  // namespace mckibben::run
