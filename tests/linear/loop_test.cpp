// Loops: the PID as a system against the controller itself, margins against loops that are simulated.
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <sim/linear/loop.hpp>
#include <sim/ride/ride.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::linear {
namespace {

constexpr double lifted_kg = 11.0, tick_s = 0.012;

/// A regulator, no friction, and counts so fine that they are numbers.
plant::Rig fine_rig() {
  plant::Rig rig;
  rig.friction.memory = plant::FrictionMemory::coulomb;
  rig.friction.scale = rig.friction.floor_N = 0.0;
  rig.valve.kind = plant::ValveKind::regulator;
  rig.valve.time_constant_s = 0.05;
  rig.joint.guide_damping_N_s_per_m = 150.0;
  rig.sensors.position().pulses_per_turn = 10000000;
  rig.integrator.tolerance = 1e-9;
  rig.effects.get<plant::ReadingDelay>().time_s = 0.017;
  rig.effects.get<plant::CommandDelay>().time_s = 0.004;
  return rig;
}

controllers::PidForm form(double K, double Ti_s, double Td_s) {
  controllers::PidForm pid;
  pid.proportional_mA = K;
  pid.integral_time_s = Ti_s;
  pid.derivative_time_s = Td_s;
  return pid;
}

Point point_of(const plant::Rig& rig) {
  return point_at(rig, lifted_kg, {Place::Of::position, 0.12}, Threads::sliding, Opening::both);
}

/// How a swing that begins with this speed of the load has grown after `seconds`; above 1, the loop is
/// unstable.
double growth(const plant::Rig& rig, const Point& point, const controllers::PidForm& form_of,
              double kick_m_per_s, double seconds,
              const std::optional<controllers::CommandFilter>& filter = {}) {
  controllers::PidSettings settings;
  settings.command_filter = filter;
  static_cast<controllers::PidForm&>(settings) = form_of;
  settings.rest_current_mA = point.command.current_mA;
  ride::Ride ride({rig, lifted_kg}, rig.integrator);
  ride::Drive drive;
  drive.current_mA = point.command.current_mA;
  ride.start(drive, 0.0);
  long tick = 0;
  for (; tick < 2000; ++tick) ride.step(drive, static_cast<double>(tick + 1) * tick_s);
  // Its target is where friction holds it.
  controllers::Knowledge known = run::knowledge_of(rig, {ride.flow().state.joint.contraction_ratio});
  const double count = known.contraction_per_count;
  const auto controller = controllers::make(settings, known);
  controller->rest();
  double early = 0.0, late = 0.0;
  const long first = tick, all = std::lround(seconds / tick_s);
  ride.rider().now.flow.state.joint.contraction_speed_per_s = kick_m_per_s / rig.muscle.rest_length_m;
  ride.rider().now.held.slip = plant::Slip::rising;
  for (; tick < first + all; ++tick) {
    const double ratio = ride.reading().wheel_m / rig.muscle.rest_length_m;
    const auto counts = static_cast<std::int64_t>(std::floor(ratio / count));
    const long k = tick - first;
    drive.current_mA = controller->step({k, static_cast<double>(k) * tick_s, counts}).current_mA;
    ride.step(drive, static_cast<double>(tick + 1) * tick_s);
    const double speed = std::abs(ride.flow().state.joint.contraction_speed_per_s);
    if (k > all / 4 && k < all / 2) early = std::max(early, speed);
    if (k > 3 * all / 4) late = std::max(late, speed);
  }
  return late / early;
}

TEST(Loop, PidIsTheControllerAsASystem) {
  const plant::Rig rig = fine_rig();
  for (const int every : {1, 3}) {
    controllers::PidSettings settings;
    static_cast<controllers::PidForm&>(settings) = form(70.0, 0.3, 0.06);
    settings.sample_ticks = every;
    settings.rest_current_mA = 10.0;
    controllers::Knowledge known = run::knowledge_of(rig, {0.1});
    const auto controller = settings.make(known);
    const System linear = system_of(settings, tick_s);
    EXPECT_DOUBLE_EQ(linear.step_s, every * tick_s);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
    for (int k = 0; k < 40; ++k) {
      const auto counts =
          static_cast<std::int64_t>((0.1 + 0.004 * std::sin(0.21 * k)) / known.contraction_per_count);
      const double command = controller->step({k, k * tick_s, counts}).current_mA;
      const double e =
          0.1 - (static_cast<double>(counts) + known.middle_of_count) * known.contraction_per_count;
      if (k % every != 0) continue;
      const double u = (linear.C * x)(0) + linear.D(0, 0) * e;
      x = linear.A * x + linear.B * e;
      if (k == 0) {  // bumpless: the integral takes up the proportional part, the derivative begins with none
        x[0] -= 70.0 * e;
        x[1] = 0.0;
      }
      EXPECT_NEAR(command, k == 0 ? 10.0 : 10.0 + u, 1e-9) << k;
    }
  }
}

/// Just above its gain margin the loop swings up, just below it dies out; of both ends, and of the phase.
TEST(Loop, IsUnstableJustBeyondItsMarginsAndStableJustWithin) {
  const plant::Rig rig = fine_rig();
  const Point point = point_of(rig);
  for (const int delay_ticks : {0, 2}) {
    controllers::PidForm pid = form(12.0, 0.4, 0.05);
    pid.feedback_delay_ticks = delay_ticks;
    const Margins margins = margins_of(loop_of(point, pid, tick_s));
    ASSERT_TRUE(margins.stable);
    ASSERT_TRUE(margins.gain && margins.phase_rad);
    for (const double beside : {0.96, 1.04}) {
      controllers::PidForm stronger = pid;
      stronger.proportional_mA = *pid.proportional_mA * *margins.gain * beside;
      EXPECT_EQ(margins_of(loop_of(point, stronger, tick_s)).stable, beside < 1.0);
      EXPECT_EQ(growth(rig, point, stronger, 2e-3, 20.0) < 1.0, beside < 1.0) << delay_ticks << " " << beside;
    }
    // The phase margin is a delay that may come on top.
    const double more_s = *margins.phase_rad / margins.phase_rad_per_s;
    for (const double share : {0.97, 1.03}) {
      Point late = point;
      late.reading_delay_s += share * more_s;
      EXPECT_EQ(margins_of(loop_of(late, pid, tick_s)).stable, share < 1.0) << share;
    }
  }
}

/// The loop is that without a filter times the filter's response, and unstable just beyond its margin.
TEST(Loop, CountsTheFilterOfTheCommand) {
  using controllers::CommandFilter, controllers::FilterKind;
  const plant::Rig rig = fine_rig();
  const Point point = point_of(rig);
  controllers::PidForm pid = form(8.0, 0.4, 0.05);
  const System without = loop_of(point, pid, tick_s);
  for (const CommandFilter& filter :
       {CommandFilter{FilterKind::low_pass, 5.0, 0.7071}, CommandFilter{FilterKind::notch, 3.0, 0.5}}) {
    pid.sample_ticks = 1;
    const System with = loop_of(point, pid, tick_s, &filter);
    for (const double Hz : {0.2, 1.7, 3.0, 11.0}) {
      const double w = 2.0 * std::numbers::pi * Hz,
                   s = std::tan(0.5 * w * tick_s) / std::tan(std::numbers::pi * filter.frequency_Hz * tick_s);
      const Complex above = filter.kind == FilterKind::notch ? 1.0 - s * s : 1.0,
                    ratio = above / Complex(1.0 - s * s, 2.0 * filter.damping * s);
      EXPECT_NEAR(std::abs(response(with, w) - ratio * response(without, w)), 0.0,
                  1e-9 * std::abs(response(without, w)))
          << Hz;
    }
    pid.sample_ticks = 2;
    const auto gain = margins_of(loop_of(point, pid, tick_s, &filter)).gain;
    ASSERT_TRUE(gain.has_value());
    EXPECT_GT(std::abs(*gain / *margins_of(loop_of(point, pid, tick_s)).gain - 1.0), 0.07) << "it matters";
    for (const double beside : {0.94, 1.06}) {
      controllers::PidForm stronger = pid;
      stronger.proportional_mA = *pid.proportional_mA * *gain * beside;
      EXPECT_EQ(growth(rig, point, stronger, 2e-3, 12.0, filter) < 1.0, beside < 1.0) << beside;
    }
  }
}

TEST(Loop, ThatIsUnstableHasNoMargins) {
  const Margins margins = margins_of(loop_of(point_of(fine_rig()), form(5000.0, 0.0, 0.0), tick_s));
  EXPECT_FALSE(margins.stable);
  EXPECT_FALSE(margins.gain || margins.phase_rad);
}

/// What is unstable without friction comes to rest from swings slower than said, and grows from faster ones.
TEST(Loop, ThatIsUnstableIsCalmedByDryFrictionUpToASpeed) {
  plant::Rig rig = fine_rig();
  rig.joint.guide_damping_N_s_per_m = 20.0;
  rig.friction.floor_N = 3.0;
  const Point point = point_of(rig);
  controllers::PidForm pid = form(4.0, 0.4, 0.02);
  const Margins margins = margins_of(loop_of(point, pid, tick_s));
  ASSERT_TRUE(margins.gain.has_value());
  pid.proportional_mA = 2.2 * *pid.proportional_mA * *margins.gain;
  EXPECT_FALSE(margins_of(loop_of(point, pid, tick_s)).stable);
  const double calmed = calmed_m_per_s(point, pid, tick_s);
  EXPECT_GT(calmed, 1e-3);
  EXPECT_LT(growth(rig, point, pid, 0.6 * calmed, 4.0), 1.0) << calmed;
  EXPECT_GT(growth(rig, point, pid, 1.6 * calmed, 4.0), 1.0) << calmed;
}

// A resonance whose gain is above 1 in a band that is narrower than the steps of the frequencies.
TEST(Loop, ANarrowResonanceHasAPhaseMarginOfItsOwn) {
  constexpr double w0 = 15.0, damping = 4e-3;
  System plant{Matrix::Zero(3, 3), Matrix(3, 1), Matrix(1, 3), Matrix::Zero(1, 1)};
  plant.A(1, 2) = 1.0;
  plant.A(2, 1) = -w0 * w0;
  plant.A(2, 2) = -2.0 * damping * w0;
  plant.B << 1.0, 0.0, 1.0;
  for (const double peak : {0.97, 1.004, 1.006, 1.02, 1.1}) {
    plant.C << 1.0, (peak - 1.0 / w0) * 2.0 * damping * w0 * w0, 0.0;
    const Margins has = margins_of(sampled(plant, tick_s, 0.05));
    ASSERT_TRUE(has.stable);
    EXPECT_NEAR(has.phase_rad_per_s, peak > 1.0 ? w0 : 1.0, 0.05) << peak;
    EXPECT_EQ(*has.phase_rad<1.0, peak> 1.0) << peak;
  }
}

TEST(Loop, PidByMarginsHasThem) {
  const plant::Rig rig = fine_rig();
  const Point point = point_of(rig);
  for (const double wanted : {40.0, 60.0}) {
    const auto found = pid_by_margins(point, tick_s, {wanted * std::numbers::pi / 180.0});
    ASSERT_TRUE(found.has_value());
    const controllers::PidForm pid = pid_of(found->gains);
    const Margins has = margins_of(loop_of(point, pid, tick_s));
    EXPECT_TRUE(has.stable);
    EXPECT_GT(*has.phase_rad * 180.0 / std::numbers::pi, wanted - 0.1);
    EXPECT_GE(*has.gain, 2.0);
    EXPECT_LT(growth(rig, point, pid, 2e-3, 6.0), 1.0);  // then it is at rest, but for counts
    // A little more gain costs the margin that binds, and no other.
    controllers::PidForm stronger = pid;
    stronger.proportional_mA = *pid.proportional_mA * 1.001;
    const Margins after = margins_of(loop_of(point, stronger, tick_s));
    EXPECT_EQ(*after.gain < 2.0, found->gain_binds) << wanted;
    EXPECT_EQ(*after.phase_rad * 180.0 / std::numbers::pi < wanted, !found->gain_binds) << wanted;
  }
}

/// Where integral action is best alone, the shortest integral time that is searched is said to be that.
TEST(Loop, PidByMarginsMayBeAtTheShortestIntegralTime) {
  plant::Rig rig = fine_rig();
  rig.joint.guide_damping_N_s_per_m = 20.0;
  const Point point = point_of(rig);
  const auto found = pid_by_margins(point, tick_s, {45.0 * std::numbers::pi / 180.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->shortest);
  const double best = found->gains.proportional_mA / found->gains.integral_time_s;
  // Any other by the gain margin, which binds here.
  for (const double Ti_s : {0.016, 0.03, 0.06}) {
    const double K = 0.01 * Ti_s;
    const Margins has = margins_of(loop_of(point, form(K, Ti_s, 0.25 * Ti_s), tick_s));
    ASSERT_TRUE(has.stable && has.gain);
    EXPECT_LT(0.5 * *has.gain * K / Ti_s, 1.01 * best) << Ti_s;
  }
  rig.joint.guide_damping_N_s_per_m = 150.0;
  EXPECT_FALSE(pid_by_margins(point_of(rig), tick_s, {1.0})->shortest);
}

/// How a swing under a state feedback has grown, whose law sees the states as late as they are read and gives
/// `factor` times what it remembers to have given.
double growth(const plant::Rig& rig, const Point& point, const Regulator& law, double factor,
              double seconds) {
  constexpr int looks = 12;  // in a tick: it is read between ticks, too
  const auto late = static_cast<std::size_t>(std::lround(point.reading_delay_s * looks / tick_s));
  ride::Ride ride({rig, lifted_kg}, rig.integrator);
  ride::Drive drive;
  drive.current_mA = point.command.current_mA;
  ride.start(drive, 0.0);
  std::deque<Eigen::VectorXd> seen(late + 1, Eigen::VectorXd::Zero(law.gain.size()));
  std::deque<double> given(static_cast<std::size_t>(law.before.size()), 0.0);
  const auto tick = [&](long k, bool acts) {
    double command = 0.0;
    for (Eigen::Index i = 0; acts && i < law.gain.size(); ++i) command -= law.gain[i] * seen.front()[i];
    for (std::size_t i = 0; acts && i < given.size(); ++i)
      command -= law.before[static_cast<Eigen::Index>(i)] * given[i];
    given.push_front(command);
    given.pop_back();
    drive.current_mA = point.command.current_mA + factor * command;
    for (int look = 1; look <= looks; ++look) {
      ride.step(drive, (static_cast<double>(k) + static_cast<double>(look) / looks) * tick_s);
      const std::array commands{drive.current_mA, 0.0};
      const engine::Linear now = engine::linearise(ride.plant(), ride.flow(), ride.held(), commands);
      seen.push_back(now.state.head(law.gain.size()) - point.slopes.state);
      seen.pop_front();
    }
  };
  constexpr long settles = 2000;
  for (long k = 0; k < settles; ++k) tick(k, false);
  ride.rider().now.flow.state.joint.contraction_speed_per_s = 2e-3 / rig.muscle.rest_length_m;
  ride.rider().now.held.slip = plant::Slip::rising;
  double early = 0.0, later = 0.0;
  const long all = std::lround(seconds / tick_s);
  for (long k = 0; k < all; ++k) {
    tick(settles + k, true);
    const double speed = std::abs(ride.flow().state.joint.contraction_speed_per_s);
    if (k > all / 4 && k < all / 2) early = std::max(early, speed);
    if (k > 3 * all / 4) later = std::max(later, speed);
  }
  return later / early;
}

/// The law of a rig with delays: stable as simulated, and its margins are where the simulated loop swings.
TEST(Loop, LqrKnowsOfTheDelays) {
  for (const auto& [command_s, reading_s] : {std::pair{0.048, 0.0}, {0.03, 0.01}, {0.004, 0.017}}) {
    plant::Rig rig = fine_rig();
    rig.joint.guide_damping_N_s_per_m = 60.0;
    rig.effects.get<plant::CommandDelay>().time_s = command_s;
    rig.effects.get<plant::ReadingDelay>().time_s = reading_s;
    const Point point = point_of(rig);
    ASSERT_EQ(point.slopes.states.size(), 4u);
    const Regulator law = lqr(point, tick_s, 0.01, 1.0);
    EXPECT_EQ(law.before.size(), std::lround(std::ceil((command_s + reading_s) / tick_s - 1e-9)));
    const Margins margins = margins_of(law.loop);
    ASSERT_TRUE(margins.stable && margins.gain && margins.phase_rad) << command_s;
    EXPECT_LT(growth(rig, point, law, 1.0, 6.0), 0.5);
    const auto dies_out = [&](const plant::Rig& on, double factor) {
      return growth(on, point, law, factor, 6.0) < 0.9;  // 1: a swing to and from the valve's ends
    };
    for (const double beside : {0.93, 1.07})
      EXPECT_EQ(dies_out(rig, *margins.gain * beside), beside < 1.0) << command_s << " " << beside;
    // The phase margin is a delay that may come on top of those that the law knows.
    const double more_s = *margins.phase_rad / margins.phase_rad_per_s;
    for (const double share : {0.9, 1.1}) {
      plant::Rig later = rig;
      later.effects.get<plant::CommandDelay>().time_s += share * more_s;
      EXPECT_EQ(dies_out(later, 1.0), share < 1.0) << command_s << " " << share;
    }
    // Made for the rig without delays it swings.
    if (command_s < 0.04) continue;
    Point prompt = point;
    prompt.command_delay_s = prompt.reading_delay_s = 0.0;
    EXPECT_GT(growth(rig, point, lqr(prompt, tick_s, 0.01, 1.0), 1.0, 6.0), 0.99);
  }
}

/// A state feedback of least squares bears a gain of half (Kalman 1964), and in fine ticks 60 degrees; what
/// it cannot know yet, for a delay, costs margins.
TEST(Loop, LqrBearsHalfItsGainAndSixtyDegrees) {
  plant::Rig rig = fine_rig();
  rig.tick_s = 1e-3;
  rig.effects.get<plant::ReadingDelay>() = {};
  rig.effects.get<plant::CommandDelay>() = {};
  const Regulator regulator = lqr(point_of(rig), rig.tick_s, 0.01, 1.0);
  const Margins margins = margins_of(regulator.loop);
  ASSERT_TRUE(margins.stable);
  EXPECT_LE(margins.shrunk_gain.value_or(0.0), 0.5);
  EXPECT_GT(margins.phase_rad.value_or(std::numbers::pi) * 180.0 / std::numbers::pi, 58.0);
  const Point point = point_of(rig);
  const Matrix steps = point.slopes.A - point.slopes.B * regulator.gain;
  for (const Complex& pole : poles({steps, point.slopes.B, point.slopes.C, point.slopes.D}))
    EXPECT_LT(pole.real(), 0.0);
}

}  // namespace
}  // namespace mckibben::linear
