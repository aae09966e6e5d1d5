// A rig driven by hand: its steps are those of a ride; what is switched while it moves changes nothing but
// what was switched; what cannot be is refused and changes nothing.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/live/session.hpp>
#include <sim/ride/ride.hpp>

#include "own_law.hpp"

namespace mckibben::live {
namespace {

constexpr double load_kg = 16.138;

void go(Session& session, int ticks) {
  for (int k = 0; k < ticks; ++k) session.step();
}

/// Up and down, and in between still.
Sweep up_and_down() {
  return {Sweep::Shape::triangle, 4.0, 14.0, 2.4};
}

TEST(LiveSession, StepsAreThoseOfARideToTheBit) {
  const plant::Rig rig;
  Session session(rig, load_kg);
  ASSERT_EQ(session.set_sweep(up_and_down()), "");
  ride::Ride ride(ride::Loaded{rig, load_kg}, rig.integrator);
  ride::Drive drive;
  drive.current_mA = plant::dac_output_mA(rig.dac, rig.valve.zero_command);
  const auto settling = std::lround(rig.settling_time_s / rig.tick_s);
  ride.start(drive, -static_cast<double>(settling) * rig.tick_s);
  for (auto k = -settling + 1; k <= 0; ++k) ride.step(drive, static_cast<double>(k) * rig.tick_s);
  double highest = 0.0;
  for (int k = 0; k < 400; ++k) {
    const Sample now = session.step();
    EXPECT_EQ(now.contraction_ratio, ride.flow().state.joint.contraction_ratio) << k;
    EXPECT_EQ(now.state.side.muscle_pressure_Pa, ride.flow().state.side.muscle_pressure_Pa) << k;
    drive.current_mA = plant::dac_output_mA(rig.dac, up_and_down().at(k * rig.tick_s));
    EXPECT_EQ(now.current_mA, drive.current_mA);
    EXPECT_EQ(now.time_s, k * rig.tick_s);
    ride.step(drive, (k + 1) * rig.tick_s);
    highest = std::max(highest, now.contraction_ratio);
  }
  EXPECT_GT(highest, 0.05);
}

TEST(LiveSession, OfARigInVoltsIsMovedByVolts) {
  plant::Rig rig;
  plant::command_in(rig, plant::CommandUnit::V, -5.0, 5.0);
  rig.dac = plant::dac_for(rig.valve);
  Session session(rig, load_kg);
  EXPECT_EQ(session.step().current_mA, -5.0);
  EXPECT_EQ(session.set_command(9.0), "command = 9 V: must be from -5 to 5 V");
  EXPECT_EQ(session.set_command(4.0), "");
  go(session, 200);
  EXPECT_NEAR(session.now().current_mA, 4.0, 10.0 / 4096.0);
  EXPECT_GT(session.now().state.side.muscle_pressure_Pa, 4e5);
}

TEST(LiveSession, WhatIsSwitchedWhileItMovesLeavesTheStateAsItIs) {
  Session names(plant::Rig{}, load_kg);
  for (const Switch& one : names.switches().all()) {
    Session session(plant::Rig{}, load_kg), untouched(plant::Rig{}, load_kg);
    for (Session* each : {&session, &untouched}) {
      ASSERT_EQ(each->set_sweep(up_and_down()), "");
      go(*each, 60);
    }
    const Sample next = untouched.step();
    ASSERT_EQ(session.set_effect(one.name, true, one.size.value, one.shape.value), "") << one.name;
    EXPECT_FALSE(session.untouched());
    const Sample same = session.step();
    EXPECT_EQ(same.contraction_ratio, next.contraction_ratio) << one.name;
    EXPECT_EQ(same.state.side.muscle_pressure_Pa, next.state.side.muscle_pressure_Pa) << one.name;
    EXPECT_EQ(same.state.side.valve_pressure_Pa, next.state.side.valve_pressure_Pa) << one.name;
    EXPECT_EQ(same.current_mA, next.current_mA) << one.name;
    // It goes on, near where it would have been, and with the effect: of gauge and counts in what they show.
    bool tells = false;
    double farthest = 0.0;
    for (int k = 0; k < 200; ++k) {
      const Sample with = session.step(), without = untouched.step();
      farthest = std::max(farthest, std::abs(with.contraction_ratio - without.contraction_ratio));
      tells = tells || with.contraction_ratio != without.contraction_ratio || with.counts != without.counts ||
              with.shown[plant::Sensed::muscle_pressure] != without.shown[plant::Sensed::muscle_pressure];
    }
    EXPECT_EQ(session.failure(), "") << one.name;
    EXPECT_TRUE(tells) << one.name;
    EXPECT_LT(farthest, 0.06) << one.name;
    ASSERT_EQ(session.set_effect(one.name, false, one.size.value, one.shape.value), "");
    EXPECT_TRUE(session.rig().effects.absent()) << one.name;
    go(session, 50);
    EXPECT_EQ(session.failure(), "") << one.name;
  }
}

TEST(LiveSession, AnotherLoadBeginsWhereTheFirstOneWas) {
  Session session(plant::Rig{}, load_kg);
  ASSERT_EQ(session.set_command(10.0), "");
  go(session, 300);
  const double before = session.now().contraction_ratio;
  ASSERT_EQ(session.set_load(0.5 * load_kg), "");
  EXPECT_NEAR(session.step().contraction_ratio, before, 1e-4);
  go(session, 300);
  EXPECT_GT(session.now().contraction_ratio, before + 0.01);
}

TEST(LiveSession, AnotherLawOfTheSameEffectTakesItsPlace) {
  plant::Rig rig;
  rig.sensors.push_back({.signal = plant::Sensed::muscle_pressure, .kind = plant::SensorKind::gauge});
  Session session(rig, load_kg);
  const auto on = [&](const char* name) { return session.switches().find(name)->on; };
  ASSERT_EQ(session.set_effect("gauge_error offset", true, 1e4, 0.0), "");
  ASSERT_EQ(session.set_effect("gauge_error gain", true, 0.03, 0.0), "");
  EXPECT_FALSE(on("gauge_error offset"));
  EXPECT_TRUE(on("gauge_error gain"));
  EXPECT_EQ(Session(plant::Rig{}, load_kg).switches().find("gauge_error gain"), nullptr);  // no gauge
}

TEST(LiveSession, EffectsOfTheFileAreOnAtTheirSizes) {
  plant::Rig rig;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 3e-10;
  Session session(rig, load_kg);
  const Switch& leak = *session.switches().find("muscle_leak");
  EXPECT_TRUE(leak.on);
  EXPECT_EQ(leak.size.value, 3e-10);
  EXPECT_EQ(session.rig().effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa, 3e-10);
}

TEST(LiveSession, WhatCannotBeIsRefusedWithItsRuleAndChangesNothing) {
  Session session(plant::Rig{}, load_kg);
  ASSERT_EQ(session.set_command(9.0), "");
  const double nan = std::nan("");
  EXPECT_EQ(session.set_command(20.5), "current = 20.5 mA: must be from 0 to 20 mA");
  EXPECT_EQ(session.set_command(nan), "current = nan mA: must be from 0 to 20 mA");
  EXPECT_EQ(session.set_sweep({Sweep::Shape::sine, 9.0, 9.0, 5.0}),
            "highest current = 9 mA: must be above the lowest, which is 9 mA");
  EXPECT_EQ(session.set_sweep({Sweep::Shape::sine, 4.0, 9.0, 0.0}),
            "period = 0 s: must be from 0.1 to 1000 s");
  EXPECT_EQ(session.set_load(-1.0), "load = -1 kg: must be from 0 to 147 kg");
  EXPECT_EQ(session.set_effect("leak", true, 1e-10, 0.0), "name = leak: there is no such effect");
  EXPECT_EQ(session.set_effect("muscle_leak", true, -1.0, 0.0),
            "size of muscle_leak = -1 m3/(s.Pa): must be from 0 to 1e-08 m3/(s.Pa)");
  EXPECT_EQ(session.set_effect("bladder_creep", true, 100.0, 0.0),
            "shape of bladder_creep = 0 s: must be from 0.02 to 1000 s");
  EXPECT_EQ(session.set_command(9.0, 2), "muscle = 2: there is none of that number");
  EXPECT_EQ(session.wanted()[0], 9.0);
  EXPECT_EQ(session.load_kg(), load_kg);
  EXPECT_FALSE(session.sweep().has_value());
  EXPECT_TRUE(session.untouched());
  EXPECT_TRUE(session.rig().effects.absent());
}

TEST(LiveSession, AnEffectThatIsHiddenActsAloneAndStaysHiddenUntilItIsShown) {
  Session session(plant::Rig{}, load_kg);
  ASSERT_EQ(session.set_effect("muscle_leak", true, 1e-10, 0.0), "");
  EXPECT_NE(session.hide_effect("leak", 1.0, 1.0), "");
  EXPECT_TRUE(session.switches().find("muscle_leak")->on);
  ASSERT_EQ(session.hide_effect("bladder_creep", 100.0, 5.0), "");
  EXPECT_EQ(session.switches().hidden(), "bladder_creep");
  EXPECT_FALSE(session.switches().find("muscle_leak")->on);
  EXPECT_NE(session.set_effect("muscle_leak", true, 1e-10, 0.0), "");
  EXPECT_NE(session.hide_effect("muscle_leak", 1e-10, 0.0), "");
  session.start_over();
  EXPECT_EQ(session.switches().hidden(), "bladder_creep");
  EXPECT_TRUE(session.switches().find("bladder_creep")->on);
  session.show_effect();
  EXPECT_EQ(session.set_effect("muscle_leak", true, 1e-10, 0.0), "");
}

TEST(LiveSession, WhatIsHiddenIsOfTypicalSizeOrMoreToOneSide) {
  const Session fresh(plant::Rig{}, load_kg);
  for (const char* const name : {"speed_dependent_friction", "encoder_scale", "friction_warm_up"})
    EXPECT_EQ(fresh.switches().find(name)->plain_sizes().size(), 2U) << name;
  for (const Switch& one : fresh.switches().all()) {
    const auto sides = one.plain_sizes();
    EXPECT_FALSE(sides.empty()) << one.name;
    for (const auto& [near, far] : sides) {
      const double typical = one.candidate.typical * (1.0 - 1e-9);
      EXPECT_GE(std::abs(near - one.absent), typical) << one.name;
      EXPECT_GE(std::abs(far - one.absent), typical) << one.name;
      EXPECT_GE((near - one.absent) * (far - one.absent), 0.0) << one.name;
      for (const double size : {near, far}) {
        Session session(plant::Rig{}, load_kg);
        EXPECT_EQ(session.hide_effect(one.name, size, one.shape.value), "");
      }
    }
  }
}

TEST(LiveSession, TooHeavyALoadIsRefused) {
  plant::Rig rig;
  rig.muscle.stop_stiffness_N_per_m = 1e4;
  Session session(rig, 1.0);
  const auto [least_kg, most_kg] = session.loads();
  EXPECT_EQ(least_kg, 0.0);
  EXPECT_LT(most_kg, 400.0);
  const std::string why = session.set_load(400.0);
  EXPECT_TRUE(why.starts_with(fmt::format("load = 400 kg: must be from 0 to {:g} kg; the taut", most_kg)))
      << why;
  EXPECT_NE(session.set_load(1.01 * most_kg), "");
  EXPECT_EQ(session.load_kg(), 1.0);
  EXPECT_EQ(session.set_load(most_kg), "");
}

// A law of the user's own that is no number above a contraction.
TEST(LiveSession, WhereTheIntegrationGivesUpItSaysSoAndCanBeginAgain) {
  plant::Rig rig;
  rig.effects.laws.list = {
      own_law(plant::LawTarget::force, "-F * sqrt(0.06 - e)", {{"F", law::newton, 5.0}})};
  Session session(rig, load_kg);
  ASSERT_EQ(session.failure(), "");
  ASSERT_EQ(session.set_command(20.0), "");
  for (int k = 0; k < 1000 && session.failure().empty(); ++k) session.step();
  ASSERT_NE(session.failure(), "");
  EXPECT_NE(session.failure().find("effects.hypotheses"), std::string::npos) << session.failure();
  const double stood = session.now().time_s;
  EXPECT_EQ(session.step().time_s, stood) << "nothing moves any more";
  EXPECT_EQ(session.set_load(20.0), "");
  EXPECT_NE(session.failure(), "");
  ASSERT_EQ(session.set_command(4.0), "");
  session.start_over();
  EXPECT_EQ(session.failure(), "");
  EXPECT_EQ(session.now().time_s, 0.0);
  EXPECT_TRUE(session.untouched());
  go(session, 20);
  EXPECT_EQ(session.failure(), "");
}

TEST(LiveSession, TheFirstTickIsUnderWhatItHasSettledUnder) {
  Session session(plant::Rig{}, load_kg);
  ASSERT_EQ(session.set_command(12.0), "");
  const double settled_mA = session.step().current_mA;
  EXPECT_NEAR(settled_mA, 4.0, 0.01);
  EXPECT_TRUE(session.untouched());
  EXPECT_NEAR(session.step().current_mA, 12.0, 0.01);
  EXPECT_FALSE(session.untouched());
}

// Two muscles.

ride::Ride settled_pair(const plant::Rig& rig, const ride::Drive& drive) {
  ride::Ride ride(ride::Loaded{rig}, rig.integrator);
  const auto settling = std::lround(rig.settling_time_s / rig.tick_s);
  ride.start(drive, -static_cast<double>(settling) * rig.tick_s);
  for (auto k = -settling + 1; k <= 0; ++k) ride.step(drive, static_cast<double>(k) * rig.tick_s);
  return ride;
}

TEST(LivePair, StepsAreThoseOfARideToTheBitAndASweepSetsThemAgainstEachOther) {
  const plant::Rig rig = plant::thesis_pair();
  Session session(rig, 0.0);
  ride::Drive drive;
  const auto hold = [&](double one_mA, double two_mA) {
    drive.current_mA = plant::dac_output_mA(rig.dac, one_mA);
    drive.opposite.current_mA = plant::dac_output_mA(rig.dac, two_mA);
  };
  hold(rig.valve.zero_command, rig.valve.zero_command);
  ride::Ride ride = settled_pair(rig, drive);
  ASSERT_EQ(session.set_command(9.0, 2), "");
  double highest = 0.0, lowest = 0.0;
  for (int k = 0; k < 400; ++k) {
    if (k == 100) {
      ASSERT_EQ(session.set_sweep({Sweep::Shape::triangle, 4.0, 14.0, 2.4}), "");
    }
    const Sample now = session.step();
    EXPECT_EQ(now.contraction_ratio, ride.flow().state.joint.contraction_ratio) << k;
    EXPECT_EQ(now.state.opposite.muscle_pressure_Pa, ride.flow().state.opposite.muscle_pressure_Pa) << k;
    if (k < 100)
      hold(rig.valve.zero_command, k == 0 ? rig.valve.zero_command : 9.0);
    else
      hold(session.wanted()[0], 18.0 - session.wanted()[0]);
    EXPECT_EQ(now.opposite.current_mA, drive.opposite.current_mA) << k;
    ride.step(drive, (k + 1) * rig.tick_s);
    highest = std::max(highest, now.angle_rad), lowest = std::min(lowest, now.angle_rad);
  }
  EXPECT_GT(highest, 0.1);
  EXPECT_LT(lowest, -0.1);
  EXPECT_NEAR(session.now().read_angle_rad, session.now().angle_rad, 0.01);
}

TEST(LivePair, EffectsActOnBothMusclesAndLeaveTheStateAsItIs) {
  Session names(plant::thesis_pair(), 0.0);
  EXPECT_EQ(names.switches().find("guide_friction"), nullptr) << "no guide of a load";
  EXPECT_EQ(names.set_load(5.0), "load: two muscles turn a link; none hangs there");
  for (const Switch& one : names.switches().all()) {
    Session session(plant::thesis_pair(), 0.0), untouched(plant::thesis_pair(), 0.0);
    for (Session* each : {&session, &untouched}) {
      ASSERT_EQ(each->set_sweep({Sweep::Shape::sine, 8.0, 14.0, 2.4}), "");
      go(*each, 60);
    }
    const Sample next = untouched.step();
    ASSERT_EQ(session.set_effect(one.name, true, one.size.value, one.shape.value), "") << one.name;
    const Sample same = session.step();
    EXPECT_EQ(same.angle_rad, next.angle_rad) << one.name;
    EXPECT_EQ(same.state.opposite.muscle_pressure_Pa, next.state.opposite.muscle_pressure_Pa) << one.name;
    go(session, 50);
    EXPECT_EQ(session.failure(), "") << one.name;
    EXPECT_FALSE(session.rig().pair()->opposite.effects.absent()) << one.name;
    ASSERT_EQ(session.set_effect(one.name, false, one.size.value, one.shape.value), "");
    EXPECT_TRUE(session.rig().effects.absent() && session.rig().pair()->opposite.effects.absent())
        << one.name;
  }
}

TEST(LivePair, AnEffectOfOneMuscleInTheFileIsASwitchOfItsOwn) {
  plant::Rig rig = plant::thesis_pair();
  std::get<plant::Pair>(rig.mechanics).opposite.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa =
      3e-10;
  Session session(rig, 0.0);
  EXPECT_FALSE(session.switches().find("muscle_leak of muscle 1")->on);
  EXPECT_TRUE(session.switches().find("muscle_leak of muscle 2")->on);
  const auto leak = [](const plant::Effects& effects) {
    return effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa;
  };
  EXPECT_EQ(leak(session.rig().effects), 0.0);
  EXPECT_EQ(leak(session.rig().pair()->opposite.effects), 3e-10);
}

TEST(LiveSweep, BeginsAtThePresentCurrentOnItsWayUp) {
  for (const auto shape : {Sweep::Shape::sine, Sweep::Shape::triangle}) {
    const Sweep sweep{shape, 4.0, 20.0, 8.0};
    for (const double current_mA : {4.0, 7.3, 19.0, 20.0})
      EXPECT_NEAR(sweep.at(sweep.when(current_mA)), current_mA, 1e-9);
    EXPECT_EQ(sweep.when(2.0), 0.0);
    EXPECT_EQ(sweep.when(25.0), 4.0);
    EXPECT_NEAR(sweep.at(8.0 + 1.5), sweep.at(1.5), 1e-9);
  }
  const Sweep stairs{Sweep::Shape::stairs, 4.0, 20.0, 16.0};
  EXPECT_EQ(stairs.at(0.5), 4.0);
  EXPECT_EQ(stairs.at(8.5), 20.0);
  EXPECT_EQ(stairs.at(16.5), 4.0);
  EXPECT_EQ(stairs.at(17.5), 6.0);
}

}  // namespace
}  // namespace mckibben::live
