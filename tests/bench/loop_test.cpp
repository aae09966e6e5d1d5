// The tick loop on a bench: what is put out and when, and that its watchdog vents whatever happens. Its clock
// is a test's, so no machine is too slow for it.
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include <controllers/pid.hpp>
#include <sim/bench/loop.hpp>
#include <sim/bench/serial.hpp>
#include <sim/bench/simulated.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/simulate.hpp>

#include "board.hpp"

namespace mckibben::bench {
namespace {

/// Counts as it is told to, and keeps what was put out.
class Told final : public Device {
 public:
  std::int64_t counts(double) override {
    if (fails_at == static_cast<int>(put_mA.size())) throw DeviceFailure("the plug is out");
    return jumps_at >= 0 && static_cast<int>(put_mA.size()) >= jumps_at ? 100000 : 5;
  }
  void put(double current_mA, double) override {
    put_mA.push_back(current_mA);
    if (raises != 0 && put_mA.size() >= 8) raise(raises);
  }

  std::vector<double> put_mA;
  int jumps_at = -1, fails_at = -1, raises = 0;
};

class Asks final : public controllers::Controller {
 public:
  explicit Asks(double current_mA) : current_mA_(current_mA) {}
  controllers::Command rest() override { return {4.0}; }
  controllers::Command step(const controllers::Reading& reading) override {
    if (reading.tick == gives_up_at) throw controllers::ControllerFailure("no more");
    return {current_mA_};
  }
  std::int64_t gives_up_at = -1;

 private:
  double current_mA_;
};

/// Wakes late once.
class Sleepy final : public Clock {
 public:
  explicit Sleepy(double at_s, double by_s) : at_s_(at_s), by_s_(by_s) {}
  double now_s() override { return now_s_; }
  void wait_until(double time_s) override {
    now_s_ = std::max(now_s_, time_s);
    if (time_s >= at_s_) now_s_ += std::exchange(by_s_, 0.0);
  }

 private:
  double at_s_, by_s_, now_s_ = 0.0;
};

LoopPlan plan(std::int64_t ticks) {
  LoopPlan all;
  all.rig.settling_time_s = 5 * all.rig.tick_s;
  all.ticks = ticks;
  all.limits = {4.0, 20.0};
  return all;
}

Recorded driven(Told& device, double asked_mA, const LoopPlan& all, Clock&& clock = PatientClock()) {
  return drive(device, std::make_unique<Asks>(asked_mA), all, clock);
}

TEST(Loop, SettlesThenAsksEachTickAndVentsAtTheEnd) {
  Told device;
  const Recorded recorded = driven(device, 9.0, plan(10));
  ASSERT_EQ(device.put_mA.size(), 16U);
  const plant::Rig rig;
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(device.put_mA[i], plant::dac_output_mA(rig.dac, 4.0));
  for (std::size_t i = 5; i < 15; ++i) EXPECT_EQ(device.put_mA[i], plant::dac_output_mA(rig.dac, 9.0));
  EXPECT_EQ(device.put_mA.back(), 0.0);
  ASSERT_EQ(recorded.rows.size(), 10U);
  EXPECT_EQ(recorded.rows[9].counts, 5);
  EXPECT_EQ(recorded.stopped, "");
}

TEST(Loop, LimitsEveryOutput) {
  Told device;
  EXPECT_EQ(driven(device, 1000.0, plan(3)).limited_ticks, 3);
  EXPECT_EQ(*std::max_element(device.put_mA.begin(), device.put_mA.end()), 20.0);
  Told other;
  EXPECT_EQ(driven(other, std::numeric_limits<double>::quiet_NaN(), plan(3)).stopped,
            "the controller's command is no number");
  EXPECT_EQ(other.put_mA.back(), 0.0);
}

TEST(Loop, VentsWhenCountsJumpOrTheDeviceOrTheControllerFails) {
  Told jumps;
  jumps.jumps_at = 8;
  EXPECT_EQ(driven(jumps, 9.0, plan(20)).stopped, "watchdog: counts jump from 5 to 100000 at tick 3");
  EXPECT_EQ(jumps.put_mA.size(), 9U);
  EXPECT_EQ(jumps.put_mA.back(), 0.0);
  Told fails;
  fails.fails_at = 7;
  EXPECT_EQ(driven(fails, 9.0, plan(20)).stopped, "the plug is out");
  EXPECT_EQ(fails.put_mA.back(), 0.0);
  Told sound;
  auto gives_up = std::make_unique<Asks>(9.0);
  gives_up->gives_up_at = 4;
  PatientClock clock;
  const Recorded recorded = drive(sound, std::move(gives_up), plan(20), clock);
  EXPECT_EQ(recorded.stopped, "no more");
  EXPECT_EQ(recorded.rows.size(), 4U);
  EXPECT_EQ(sound.put_mA.back(), 0.0);
}

TEST(Loop, VentsOnceMoreTicksInARowAreMissedThanMayBe) {
  const double tick_s = plant::Rig{}.tick_s;
  Told few;
  const Recorded late = driven(few, 9.0, plan(20), Sleepy(10 * tick_s, 3.5 * tick_s));
  EXPECT_EQ(late.stopped, "");
  EXPECT_EQ(late.missed_ticks, 3);
  EXPECT_EQ(late.rows.size(), 20U);
  EXPECT_NEAR(late.rows[4].read_s, 7.5 * tick_s, 1e-9);
  EXPECT_EQ(late.rows[4].sent_s, late.rows[4].read_s) << "its clock stands still meanwhile";
  Told many;
  const Recorded stopped = driven(many, 9.0, plan(20), Sleepy(10 * tick_s, 9.5 * tick_s));
  EXPECT_TRUE(stopped.stopped.starts_with("watchdog: 4 ticks of 12 ms in a row were missed, up to tick 7;"))
      << stopped.stopped;
  EXPECT_EQ(many.put_mA.back(), 0.0);
}

TEST(Loop, VentsAtEachSignalThatCanBeCaughtHoweverOftenItComes) {
  for (const int each : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGXCPU, SIGTSTP}) {
    Told device;
    device.raises = each;  // again as it vents
    const Recorded recorded = driven(device, 9.0, plan(20));
    EXPECT_TRUE(run::take_interrupt()) << each;
    EXPECT_TRUE(recorded.by_user) << each;
    EXPECT_EQ(recorded.stopped, "stopped by the user") << each;
    EXPECT_EQ(recorded.rows.size(), 3U) << each;
    EXPECT_EQ(device.put_mA.back(), 0.0) << each;
  }
}

controllers::PidSettings pid() {
  controllers::PidSettings settings;
  settings.proportional_mA = 30.0;
  settings.integral_time_s = 0.3;
  settings.derivative_time_s = 0.0;
  return settings;
}

TEST(SimulatedBench, IsTheRunThatIsSimulated) {
  std::array<plant::Rig, 2> rigs;
  plant::Valve& modulated = rigs[1].valve;
  modulated.kind = plant::ValveKind::on_off;
  modulated.switching = plant::Switching::pwm;
  modulated.pwm_frequency_Hz = 50.0;  // its periods of 20 ms begin within ticks of 12 ms
  modulated.resolve();
  std::vector<double> target(200, 0.1);
  for (const plant::Rig& rig : rigs) {
    const auto known = run::knowledge_of(rig, target);
    auto simulated = pid().make(known), driving = pid().make(known);
    const run::Recording expected = run::simulate({.rig = rig, .load_kg = 16.0, .ticks = 200}, *simulated);
    Simulated bench(rig, 16.0, {}, plant::dac_output_mA(rig.dac, 4.0));
    LoopPlan all = plan(200);
    all.rig = rig;
    all.load_kg = 16.0;
    PatientClock clock;
    clock.wait_until(0.0071);  // tick 0 is no round time of the clock
    const Recorded recorded = drive(bench, std::move(driving), all, clock);
    ASSERT_EQ(recorded.rows.size(), 200U) << recorded.stopped;
    for (std::size_t k = 0; k < 200; ++k) {
      EXPECT_EQ(recorded.rows[k].counts, expected.samples[k].counts) << k;
      EXPECT_EQ(recorded.rows[k].current_mA, expected.samples[k].current_mA) << k;
    }
    EXPECT_GT(recorded.rows.back().counts, rig.valve.is_on_off() ? 198 : 200);  // these begin shut
  }
}

/// A busy machine's: it wakes late, and whatever is done takes a while.
class Busy final : public Clock {
 public:
  double now_s() override { return now_s_ += 3e-4 * at_random_(random_); }
  void wait_until(double time_s) override {
    now_s_ = std::max(now_s_, time_s) + 6e-3 * std::pow(at_random_(random_), 4);
  }

 private:
  double now_s_ = 0.0;
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> at_random_{0.0, 1.0};
};

TEST(SimulatedBench, ReplaysFromTheInstantsOfABusyMachine) {
  LoopPlan all = plan(300);
  plant::Valve& modulated = all.rig.valve;
  modulated.kind = plant::ValveKind::on_off;
  modulated.switching = plant::Switching::pwm;
  modulated.pwm_frequency_Hz = 50.0;
  modulated.resolve();
  all.load_kg = 16.0;
  Simulated bench(all.rig, all.load_kg, {}, plant::dac_output_mA(all.rig.dac, 4.0));
  Busy clock;
  auto controller = pid().make(run::knowledge_of(all.rig, std::vector<double>(300, 0.1)));
  const std::vector<Row> rows = drive(bench, std::move(controller), all, clock).rows;
  ASSERT_EQ(rows.size(), 300U);

  run::Course sent, ticks;
  for (const Row& row : rows) {
    const auto hold = [&](run::Course& course, double at_s, double current_mA) {
      course.time_s.push_back(at_s);
      course.drives.emplace_back().current_mA = current_mA;
    };
    for (run::Course* course : {&sent, &ticks}) course->rows.push_back(course->time_s.size());
    hold(sent, row.read_s, sent.drives.empty() ? row.current_mA : sent.drives.back().current_mA);
    hold(sent, row.sent_s, row.current_mA);
    hold(ticks, static_cast<double>(row.tick) * all.rig.tick_s, row.current_mA);
  }
  const auto off = [&](const run::Course& course) {
    const run::Recording replayed = run::follow(all.rig, all.load_kg, course);
    std::int64_t most = 0;
    for (std::size_t k = 0; k < rows.size(); ++k)
      most = std::max(most, std::abs(replayed.samples[k].counts - rows[k].counts));
    return most;
  };
  EXPECT_EQ(off(sent), 0);
  EXPECT_GT(off(ticks), 2);
}

TEST(SimulatedBench, HasTheNoiseOfTheRigsSensor) {
  plant::Rig rig;
  plant::Sensor laser = rig.sensors.position();
  laser.kind = plant::SensorKind::laser;
  laser.resolution = 1e-5;
  const auto scatter = [&](double noise_m) {
    laser.noise = noise_m;
    rig.sensors.put(laser);
    Simulated bench(rig, 16.0, {}, 9.0);
    double squares = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const auto counts = static_cast<double>(bench.counts(rig.tick_s * k));
      bench.put(4.0, rig.tick_s * k);
      squares += counts * counts / 1000.0;
    }
    return 1e-5 * std::sqrt(squares);
  };
  const double at_rest_m = scatter(0.0);
  EXPECT_NEAR(std::sqrt(std::pow(scatter(1e-4), 2) - std::pow(at_rest_m, 2)), 1e-4, 2e-5);
}

TEST(SimulatedBench, IsBelievedWithAnyLoad) {
  for (const double load_kg : {0.5, 5.0, 45.0}) {
    LoopPlan all = plan(300);
    all.load_kg = load_kg;
    Simulated bench(all.rig, load_kg, {}, all.rig.dac.lowest_command);
    PatientClock clock;
    auto controller = pid().make(run::knowledge_of(all.rig, std::vector<double>(300, 0.15)));
    EXPECT_EQ(drive(bench, std::move(controller), all, clock).stopped, "") << load_kg;
  }
}

TEST(SerialBench, SpeaksItsLines) {
  Board board([](int, long) { return "42\r\n"; }, "what?\r\n");
  {
    Serial serial(board.port, plant::Rig{});
    EXPECT_EQ(serial.counts(0.0), 42);
    serial.put(12.34567, 0.0);
    EXPECT_EQ(serial.counts(0.0), 42);
    serial.put(0.0, 0.0);
  }
  for (int i = 0; i < 500 && board.heard().back() != "=0.0000"; ++i) usleep(2000);
  const std::vector<std::string> all = board.heard(), last(all.end() - 4, all.end());
  EXPECT_EQ(last, (std::vector<std::string>{"?", "=12.3457", "?", "=0.0000"}));
  EXPECT_EQ(all.front(), "mckibben 1 12");
}

TEST(SerialBench, SaysWhatItsCommandsAreInUnlessTheyAreMilliamperes) {
  plant::Rig volts;
  plant::command_in(volts, plant::CommandUnit::V, 0.0, 10.0);
  Board board;
  EXPECT_EQ(Serial(board.port, volts).counts(0.0), 42);
  EXPECT_EQ(board.heard().front(), "mckibben 2 12 V");
}

TEST(SerialBench, SaysWhatIsWrong) {
  EXPECT_THROW(Serial("/nowhere/port", plant::Rig{}), DeviceFailure);
}

}  // namespace
}  // namespace mckibben::bench
