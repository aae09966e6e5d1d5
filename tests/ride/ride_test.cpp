// The step-able rig: what is saved, restored or copied goes on to the same bits; when a drive is felt.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include <sim/ride/ride.hpp>
#include <sim/ride/sample.hpp>
#include <sim/ride/underway.hpp>

#include "switched_on.hpp"

namespace mckibben::ride {
namespace {

constexpr double load_kg = 16.138, tick_s = 0.012;

plant::Rig with_friction(plant::Rig rig, plant::FrictionMemory memory) {
  rig.friction.memory = memory;
  return rig;
}

/// Up and down, so that the load moves, turns and sticks.
Drive drive_at(int k) {
  return {{.current_mA = 11.0 - 6.0 * std::cos(0.05 * k), .stray_pressure_Pa = k % 5 == 0 ? 300.0 : 0.0}};
}

void go(Ride& ride, int from, int to) {
  for (int k = from; k < to; ++k) ride.step(drive_at(k), tick_s * (k + 1));
}

bool same_bits(const Ride& a, const Ride& b) {
  const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return same(a.flow().state, b.flow().state) && same(a.flow().memory, b.flow().memory) &&
         same(a.flow().ledger, b.flow().ledger) && a.reading().wheel_m == b.reading().wheel_m &&
         a.time_s() == b.time_s();
}

TEST(Ride, ReadsALoadFromAnotherZeroWithoutMovingItElsewhere) {
  plant::Rig off;
  off.joint.reading_offset_m = -2.3e-4;
  const solver::Settings settings{solver::Method::erk, 1e-6};
  Ride ride(Loaded{plant::Rig{}, load_kg}, settings), other(Loaded{off, load_kg}, settings);
  ride.start(drive_at(0), 0.0);
  other.start(drive_at(0), 0.0);
  go(ride, 0, 60);
  go(other, 0, 60);
  EXPECT_EQ(other.flow().state.joint.contraction_ratio, ride.flow().state.joint.contraction_ratio);
  EXPECT_NEAR(other.reading().wheel_m - ride.reading().wheel_m, -2.3e-4, 1e-15);
}

TEST(Ride, SetsOffWhereALoadStandsAndNotWhereItIsRead) {
  plant::Rig off;
  off.joint.reading_offset_m = 1e-3;
  Ride ride(Loaded{off, load_kg}, {solver::Method::erk, 1e-6});
  ride.start(drive_at(0), 0.0);
  set_off(ride.rider(), {.rise_m = 0.021});
  EXPECT_NEAR(ride.flow().state.joint.contraction_ratio, 0.020 / off.muscle.rest_length_m, 1e-12);
  EXPECT_NEAR(ride.reading().wheel_m, 0.021, 1e-12);
}

// What an encoder shows late is carried on; what is not known of it is of now, and is not.
TEST(Ride, SetsOffAsFarOffWhereReadingsAreLateAsWhereTheyAreNot) {
  plant::Rig late;
  late.effects.get<plant::ReadingDelay>().time_s = 0.04;
  const auto begun = [&](const ride::Underway& seen) {
    Ride ride(Loaded{late, load_kg}, {solver::Method::erk, 1e-6});
    ride.start(drive_at(0), 0.0);
    set_off(ride.rider(), seen);
    return std::pair(ride.flow().state.joint, ride.reading().wheel_m);
  };
  ride::Underway seen{.rise_m = 0.02, .speed_m_per_s = 0.01, .acceleration_m_per_s2 = 0.2};
  const auto [here, shown_m] = begun(seen);
  const double length_m = late.muscle.rest_length_m;
  EXPECT_NEAR(here.contraction_ratio * length_m, 0.02 + 0.01 * 0.04 + 0.5 * 0.2 * 0.04 * 0.04, 1e-12);
  EXPECT_NEAR(shown_m, 0.02, 1e-12);
  seen.off_rise_m = 1e-4;
  seen.off_speed_m_per_s = 2e-3;
  seen.off_acceleration_m_per_s2 = 1.0;
  const auto [off, off_shown_m] = begun(seen);
  EXPECT_NEAR((off.contraction_ratio - here.contraction_ratio) * length_m, 1e-4, 1e-12);
  EXPECT_NEAR((off.contraction_speed_per_s - here.contraction_speed_per_s) * length_m, 2e-3, 1e-12);
  EXPECT_NEAR(off_shown_m - shown_m, 1e-4, 1e-12);
}

// Of a rig on a cord position, speed, acceleration and pressure are seen: the cord is as long as they ask
// for, and the load goes on as it did.
TEST(Ride, SetsOffWithACordThatIsStretchedAsItsLoadHangs) {
  plant::Rig rig;
  rig.muscle.cord = {.stiffness_N_per_m = 2e4, .damping_N_s_per_m = 300.0};
  rig.effects.get<plant::GuideFriction>().coefficient = 0.03;
  const Loaded loaded{rig, load_kg};
  const auto pressed = [](int k) {
    Drive drive;
    drive.muscle_pressure_Pa = 3e5 - 1.5e5 * std::cos(0.05 * k);
    return drive;
  };
  for (const int from : {50, 75, 110}) {  // on its way up, near the top, on its way down
    SCOPED_TRACE(from);
    Ride ride(loaded, {solver::Method::erk, 1e-9}), other(loaded, {solver::Method::erk, 1e-9});
    ride.start(pressed(0), 0.0);
    for (int k = 0; k < from; ++k) ride.step(pressed(k + 1), tick_s * (k + 1));
    const double length_m = rig.muscle.rest_length_m;
    const plant::JointState<double> joint = ride.flow().state.joint;
    const double acceleration_m_per_s2 = ride.moment().acceleration_m_per_s2;
    other.start(pressed(from), tick_s * from);
    set_off(other.rider(), {.rise_m = length_m * joint.contraction_ratio,
                            .speed_m_per_s = length_m * joint.contraction_speed_per_s,
                            .acceleration_m_per_s2 = acceleration_m_per_s2});
    EXPECT_NEAR(other.moment().acceleration_m_per_s2, acceleration_m_per_s2, 1e-9);
    const double stretch_m = other.flow().memory.side[plant::cord_stretch];
    EXPECT_NEAR(2e4 * stretch_m, ride.moment().cord_force_N(), 1e-6);
    EXPECT_NEAR(stretch_m, load_kg * plant::gravity_m_per_s2 / 2e4, 4e-4);  // the guide rubs with 3 % of that
    double furthest_m = 0.0;
    for (int k = from; k < from + 80; ++k) {
      ride.step(pressed(k + 1), tick_s * (k + 1));
      other.step(pressed(k + 1), tick_s * (k + 1));
      furthest_m = std::max(furthest_m, length_m * std::abs(ride.flow().state.joint.contraction_ratio -
                                                            other.flow().state.joint.contraction_ratio));
    }
    EXPECT_LT(furthest_m, 5e-5);
  }
}

TEST(Ride, GoesOnToTheSameBitsFromWhatWasSavedAndAsACopy) {
  for (const auto method : {solver::Method::erk, solver::Method::cvode, solver::Method::automatic})
    for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb})
      for (const plant::Rig& rig : {plant::Rig{}, plant::rig_with_all_effects()}) {
        Ride ride(Loaded{with_friction(rig, memory), load_kg}, {method, 1e-6}, true);
        ride.start(drive_at(0), 0.0);
        for (int begin = 0; begin < 120; begin += 7) {
          const Ride::Saved saved = ride.save();
          Ride copy = ride;
          go(ride, begin, begin + 7);
          go(copy, begin, begin + 7);
          EXPECT_TRUE(same_bits(ride, copy)) << "copied before tick " << begin;
          copy.restore(saved);
          EXPECT_EQ(copy.time_s(), tick_s * begin);
          go(copy, begin, begin + 7);
          EXPECT_TRUE(same_bits(ride, copy)) << "restored at tick " << begin;
          copy.restore(saved);
          Ride of_copy = copy;  // which has made no step since
          go(of_copy, begin, begin + 7);
          EXPECT_TRUE(same_bits(ride, of_copy)) << "copied from a copy at tick " << begin;
        }
        EXPECT_GT(ride.flow().state.joint.contraction_ratio, 0.05);
      }
}

TEST(Ride, ADriveIsFeltFromItsInstantOn) {
  Ride ride(Loaded{plant::Rig{}, load_kg}, {solver::Method::erk, 1e-6});
  ride.start({{.current_mA = 8.0}}, 0.0);
  const double before_Pa = ride.flow().state.side.valve_pressure_Pa;
  EXPECT_EQ(before_Pa, ride.plant().reference_pressure_Pa(8.0));
  ride.hold({{.current_mA = 12.0}}, tick_s);
  EXPECT_EQ(ride.flow().state.side.valve_pressure_Pa, before_Pa);
  EXPECT_GT(ride.moment().supply_flow, 0.0);
  ride.advance();
  EXPECT_GT(ride.flow().state.side.valve_pressure_Pa, before_Pa + 1e4);
  EXPECT_EQ(ride.time_s(), tick_s);
}

// T 4.6: the level grows with the speed of the current, (12 - 8) mA in the length of the step.
TEST(Ride, TheCurrentsSpeedIsItsChangeOverTheStep) {
  plant::Rig rig;
  rig.friction.f1_s2_per_mA2 = 1e-4;
  Ride ride(Loaded{rig, load_kg}, {solver::Method::erk, 1e-6});
  ride.start({{.current_mA = 8.0}}, 0.0);
  for (const double step_s : {0.012, 0.05}) {
    ride.hold({{.current_mA = 8.0}}, ride.time_s() + step_s);
    const double still_N = ride.moment().friction_level_N - rig.friction.floor_N;
    ride.hold({{.current_mA = 12.0}}, ride.time_s() + step_s);
    const double speed_mA_per_s = 4.0 / step_s;
    EXPECT_NEAR(
        (ride.moment().friction_level_N - rig.friction.floor_N) / still_N,
        plant::friction_coefficient(rig.friction, ride.flow().state.joint.contraction_ratio, speed_mA_per_s) /
            plant::friction_coefficient(rig.friction, ride.flow().state.joint.contraction_ratio, 0.0),
        1e-12);
    ride.hold({{.current_mA = 8.0}}, ride.time_s() + step_s);
  }
}

plant::Rig late_by(double command_s, double reading_s) {
  plant::Rig rig;
  rig.effects.get<plant::CommandDelay>().time_s = command_s;
  rig.effects.get<plant::ReadingDelay>().time_s = reading_s;
  return rig;
}

// Two ticks late, all that happens has happened two ticks before in a ride that has its commands at once.
TEST(Ride, ALateCommandIsFeltAsItWasGivenBefore) {
  Ride late(Loaded{late_by(2 * tick_s, 0.0), load_kg}, {solver::Method::erk, 1e-9});
  Ride prompt(Loaded{plant::Rig{}, load_kg}, {solver::Method::erk, 1e-9});
  late.start(drive_at(0), 0.0);
  prompt.start(drive_at(0), 0.0);
  for (int k = 0; k < 80; ++k) {
    late.step({{.current_mA = drive_at(k).current_mA}}, tick_s * (k + 1));
    prompt.step({{.current_mA = drive_at(std::max(0, k - 2)).current_mA}}, tick_s * (k + 1));
    ASSERT_NEAR(late.reading().wheel_m, prompt.reading().wheel_m, 1e-9) << k;
  }
  EXPECT_GT(late.reading().wheel_m, 0.01);
}

// By its data sheet a sensor reads as late as one that has the effect.
TEST(Ride, ASensorsReadingIsOfSoLongAgoAndStaysUntilItsNext) {
  plant::Rig by_sheet, slow;
  by_sheet.sensors.position().delay_s = 2.5 * tick_s;
  slow.sensors.position().rate_Hz = 0.25 / tick_s;
  Ride effect(Loaded{late_by(0.0, 2.5 * tick_s), load_kg}, {solver::Method::erk, 1e-9});
  Ride sheet(Loaded{by_sheet, load_kg}, {solver::Method::erk, 1e-9});
  Ride held(Loaded{slow, load_kg}, {solver::Method::erk, 1e-9});
  Ride prompt(Loaded{plant::Rig{}, load_kg}, {solver::Method::erk, 1e-9});
  std::vector<double> rises_m{0.0};
  for (Ride* ride : {&effect, &sheet, &held, &prompt}) ride->start(drive_at(0), 0.0);
  for (int k = 1; k < 80; ++k) {
    for (Ride* ride : {&effect, &sheet, &held, &prompt}) ride->step(drive_at(k - 1), tick_s * k);
    rises_m.push_back(prompt.reading().wheel_m);
    ASSERT_EQ(sheet.reading().wheel_m, effect.reading().wheel_m) << k;
    ASSERT_NEAR(held.reading().wheel_m, rises_m[static_cast<std::size_t>(k - k % 4)], 1e-9) << k;
  }
  EXPECT_GT(rises_m.back(), 0.01);
}

// Gauges and load cells, too, whatever they read.
TEST(Ride, EverySensorMayBeLate) {
  using plant::Sensed;
  constexpr auto late_s = 2.0 * tick_s, rate_Hz = 0.25 / tick_s;
  plant::Rig delayed, slow;
  for (const auto& [signal, kind] : {std::pair{Sensed::muscle_pressure, plant::SensorKind::gauge},
                                     {Sensed::valve_pressure, plant::SensorKind::gauge},
                                     {Sensed::force, plant::SensorKind::load_cell}}) {
    delayed.sensors.put({.signal = signal, .kind = kind, .delay_s = late_s});
    slow.sensors.put({.signal = signal, .kind = kind, .rate_Hz = rate_Hz});
  }
  std::vector<plant::Sample> rows, late, held;
  const auto take = [](const plant::Rig& rig, std::vector<plant::Sample>& into) {
    Ride ride(Loaded{rig, load_kg}, {solver::Method::erk, 1e-9});
    ride.start(drive_at(0), 0.0);
    for (int k = 0; k < 40; ++k) {
      ride.hold(drive_at(k), tick_s * (k + 1));
      into.push_back(sample_of(ride.rider(), 0));
      ride.advance();
    }
  };
  take({}, rows), take(delayed, late), take(slow, held);
  for (const Sensed signal : {Sensed::muscle_pressure, Sensed::valve_pressure, Sensed::force})
    for (std::size_t k = 2; k < rows.size(); ++k) {
      const double then = rows[k - 2].shown[signal], taken = rows[k - k % 4].shown[signal];
      ASSERT_NEAR(late[k].shown[signal], then, 1e-9 * std::abs(then)) << k;
      ASSERT_NEAR(held[k].shown[signal], taken, 1e-9 * std::abs(taken)) << k;
    }
  EXPECT_GT(rows.back().shown[Sensed::muscle_pressure], rows[10].shown[Sensed::muscle_pressure]);
}

// A tick and a half late: the same as in a ride whose commands change there.
TEST(Ride, ALateCommandIsFeltBetweenInstantsToo) {
  const double half_s = 0.5 * tick_s;
  for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb}) {
    const Loaded late{with_friction(late_by(3 * half_s, 0.0), memory), load_kg};
    Ride alone(late, {solver::Method::erk, 1e-9});
    Ride prompt(Loaded{with_friction({}, memory), load_kg}, {solver::Method::erk, 1e-9});
    for (Ride* ride : {&alone, &prompt}) ride->start(drive_at(0), 0.0);
    for (int k = 0; k < 120; ++k) {
      const Drive given{{.current_mA = drive_at(k / 2).current_mA}};
      if (k % 2 == 0) alone.step(given, tick_s * (k / 2 + 1));
      prompt.step({{.current_mA = drive_at(std::max(0, k - 3) / 2).current_mA}}, half_s * (k + 1));
      if (k % 2 == 0) continue;
      ASSERT_NEAR(alone.reading().wheel_m, prompt.reading().wheel_m, 1e-8) << k;
    }
    EXPECT_GT(alone.reading().wheel_m, 0.01);
  }
}

TEST(Ride, ALateReadingShowsWhereTheLoadWas) {
  for (const double late_s : {3 * tick_s, 2.4 * tick_s, 0.3 * tick_s}) {
    Ride late(Loaded{late_by(0.0, late_s), load_kg}, {solver::Method::erk, 1e-9});
    Ride prompt(Loaded{plant::Rig{}, load_kg}, {solver::Method::erk, 1e-9});
    late.start(drive_at(0), 0.0);
    prompt.start(drive_at(0), 0.0);
    for (int k = 0; k < 60; ++k) {
      const double then_s = tick_s * (k + 1) - late_s;
      while (prompt.time_s() < then_s - 1e-9) {
        const int at = static_cast<int>(prompt.time_s() / tick_s + 1e-6);
        prompt.step(drive_at(at), std::min(then_s, tick_s * (at + 1)));
      }
      late.step(drive_at(k), tick_s * (k + 1));
      EXPECT_NEAR(late.reading().wheel_m, prompt.reading().wheel_m, 3e-6) << k;  // a cubic's error
      EXPECT_EQ(late.reading().of(plant::Sensed::muscle_pressure), late.flow().state.side.muscle_pressure_Pa);
    }
    EXPECT_GT(late.reading().wheel_m, 0.01);
  }
}

TEST(Ride, EachMuscleOfAPairHasItsOwnDelay) {
  const plant::Rig prompt, late = late_by(2 * tick_s, 0.0);
  const auto references = [&](const plant::Rig& rig, const plant::Rig& opposite) {
    Ride ride(Loaded{plant::pair_of(rig, opposite)}, {solver::Method::erk, 1e-6});
    ride.start({{.current_mA = 8.0}, {}, {.current_mA = 8.0}}, 0.0);
    ride.hold({{.current_mA = 12.0}, {}, {.current_mA = 12.0}}, tick_s);
    const plant::Held& held = ride.rider().now.held;
    return std::pair(held.reference_pressure_Pa, held.opposite.reference_pressure_Pa);
  };
  const plant::Plant plant(prompt, load_kg);
  const double before_Pa = plant.reference_pressure_Pa(8.0), after_Pa = plant.reference_pressure_Pa(12.0);
  EXPECT_EQ(references(late, prompt), std::pair(before_Pa, after_Pa));
  EXPECT_EQ(references(prompt, late), std::pair(after_Pa, before_Pa));
}

// What a gauge shows is off, and what it showed where a pressure is given.
TEST(Ride, AGaugeInErrorIsReadAndGivenAsItShows) {
  plant::Rig offset, gain;
  offset.effects.get<plant::GaugeError>().offset_Pa = 2e4;
  gain.effects.get<plant::GaugeError>() = {.variant = plant::GaugeLaw::gain, .gain = 0.1};
  for (const auto& [rig, true_Pa] : {std::pair{offset, 1.8e5}, std::pair{gain, 2e5 / 1.1}}) {
    Ride driven(Loaded{rig, load_kg}, {solver::Method::erk, 1e-6});
    driven.start({{.muscle_pressure_Pa = 1e5}}, 0.0);
    EXPECT_NEAR(driven.reading().of(plant::Sensed::muscle_pressure), 1e5, 1e-6);
    driven.step({{.muscle_pressure_Pa = 2e5}}, tick_s);
    EXPECT_NEAR(driven.flow().state.side.muscle_pressure_Pa, true_Pa, 1e-6);
    EXPECT_NEAR(driven.reading().of(plant::Sensed::muscle_pressure), 2e5, 1e-6);
    Ride commanded(Loaded{rig, load_kg}, {solver::Method::erk, 1e-6});
    Ride nominal(Loaded{plant::Rig{}, load_kg}, {solver::Method::erk, 1e-6});
    for (Ride* ride : {&commanded, &nominal}) {
      ride->start({{.current_mA = 8.0}}, 0.0);
      ride->step({{.current_mA = 12.0}}, tick_s);
    }
    const double there_Pa = commanded.flow().state.side.muscle_pressure_Pa;
    EXPECT_EQ(there_Pa, nominal.flow().state.side.muscle_pressure_Pa);
    EXPECT_EQ(commanded.reading().wheel_m, nominal.reading().wheel_m);
    EXPECT_NEAR(commanded.reading().of(plant::Sensed::muscle_pressure), rig.effects.shown_Pa(there_Pa), 1e-6);
    EXPECT_NEAR(rig.effects.shown_Pa(true_Pa), 2e5, 1e-6);
  }
}

TEST(Ride, TimesAreTheCallers) {
  const auto arrive = [](double step_s) {
    Ride ride(Loaded{plant::Rig{}, load_kg}, {solver::Method::erk, 1e-9});
    ride.start({{.current_mA = 4.0}}, 0.0);
    for (int k = 1; k * step_s < 1.0 + 1e-9; ++k) ride.step({{.current_mA = 12.0}}, k * step_s);
    return ride.flow().state.joint.contraction_ratio;
  };
  const double e = arrive(0.01);
  EXPECT_GT(e, 0.05);
  EXPECT_NEAR(arrive(0.001), e, 1e-7);
  EXPECT_NEAR(arrive(0.25), e, 1e-7);
}

TEST(Ride, RefusesWhatItCannotDo) {
  Ride ride(Loaded{plant::Rig{}, load_kg}, {});
  ride.start({{.current_mA = 4.0}}, 1.0);
  EXPECT_THROW(ride.step({{.current_mA = 4.0}}, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::ride
