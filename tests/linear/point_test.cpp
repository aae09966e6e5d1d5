// The rig's slopes against the rig itself: a small sine of command, ridden by the engine.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <sim/input/rigs.hpp>
#include <sim/linear/point.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::linear {
namespace {

constexpr double load_kg = 11.0;

/// Threads without friction.
plant::Rig smooth(plant::Rig rig = {}) {
  rig.friction.memory = plant::FrictionMemory::coulomb;
  rig.friction.scale = rig.friction.floor_N = 0.0;
  rig.tick_s = 0.004;
  rig.integrator.tolerance = 1e-9;
  return rig;
}

plant::Valve regulator(plant::Valve valve, double time_s) {
  valve.kind = plant::ValveKind::regulator;
  valve.time_constant_s = time_s;
  return valve;
}

/// A ride under a point's command and a little more, tick by tick.
class Held {
 public:
  Held(const plant::Rig& rig, double load, const Point& point)
      : h(rig.tick_s), point_(point), pair_(rig.pair() != nullptr), ride_({rig, load}, rig.integrator) {
    hold(0.0);
    ride_.start(drive_, 0.0);
  }
  void step(double more) {
    hold(more);
    ride_.step(drive_, static_cast<double>(++tick_) * h);
  }
  /// Until it stands; rocked before, ever less, so that threads are bent neither way.
  void settle(double rocked) {
    const auto rocking = std::lround(30.0 / h), settling = std::lround(10.0 / h);
    for (long k = 0; k < rocking + settling; ++k) {
      const double fades = std::exp(-9.0 * static_cast<double>(k) / static_cast<double>(rocking));
      step(k < rocking ? rocked * fades * std::sin(30.0 * h * static_cast<double>(k)) : 0.0);
    }
  }
  double position() const {
    const double ratio = ride_.flow().state.joint.contraction_ratio;
    return ride_.plant().has_angle() ? ride_.plant().angle_rad(ratio) : ratio;
  }
  const double h;

 private:
  void hold(double more) {
    drive_.current_mA = point_.command.current_mA + more;
    drive_.opposite.current_mA = point_.command.opposite_mA + (pair_ ? point_.direction[1] * more : 0.0);
  }

  const Point& point_;
  bool pair_;
  ride::Ride ride_;
  ride::Drive drive_;
  long tick_ = 0;
};

/// Gain and phase of position for a sine of command about the point, once it has died in.
Complex ridden(const plant::Rig& rig, double load, const Point& point, double w, double amplitude,
               double rocked = 0.0) {
  Held held(rig, load, point);
  held.settle(rocked);
  const auto period = std::lround(2.0 * std::numbers::pi / (w * held.h));
  const long before = std::lround(std::ceil(15.0 / (static_cast<double>(period) * held.h))) * period;
  const long whole = 3 * period;
  Matrix shapes(whole, 4);  // what does not swing: a place, and how it creeps
  Eigen::VectorXd seen(whole);
  for (long k = 0; k < before + whole; ++k) {
    const double turn = w * held.h * static_cast<double>(k);
    if (k >= before) {
      const long row = k - before;
      shapes.row(row) << 1.0, static_cast<double>(row) / static_cast<double>(whole), std::sin(turn),
          std::cos(turn);
      seen[row] = held.position();
    }
    held.step(amplitude * std::sin(turn));
  }
  const Eigen::VectorXd found = shapes.colPivHouseholderQr().solve(seen);
  return Complex(found[2], found[3]) / amplitude;
}

/// Three frequencies, of which each has a whole number of ticks in a period: 1 % and 1 degree.
void expect_as_ridden(const plant::Rig& rig, double load, const Point& point, double amplitude) {
  const System linear = sampled(point.system(), rig.tick_s, point.command_delay_s);
  for (const int ticks : {1000, 200, 60}) {
    const double w = 2.0 * std::numbers::pi / (ticks * rig.tick_s);
    const Complex asked = response(linear, w), got = ridden(rig, load, point, w, amplitude);
    EXPECT_NEAR(std::abs(got) / std::abs(asked), 1.0, 0.01) << w;
    EXPECT_NEAR(std::arg(got / asked) * 180.0 / std::numbers::pi, 0.0, 1.0) << w;
  }
}

Point at_command(const plant::Rig& rig, double load, double command, Threads threads = Threads::sliding,
                 Opening opening = Opening::both) {
  return point_at(rig, load, {Place::Of::command, command}, threads, opening);
}

TEST(Point, OfARegulatorAndThreadsWithoutFrictionIsAsRidden) {
  plant::Rig rig = smooth();
  rig.valve = regulator(rig.valve, 0.05);
  const Point point = at_command(rig, load_kg, 11.0);
  EXPECT_TRUE(point.settled);
  EXPECT_FALSE(point.shut || point.on_stop);
  expect_as_ridden(rig, load_kg, point, 0.005);
}

TEST(Point, OfAServoValveThatFeedsALeakIsAsRiddenLateCommandsToo) {
  plant::Rig rig = smooth();
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  rig.effects.get<plant::CommandDelay>().time_s = 0.023;
  const Point point = at_command(rig, load_kg, 11.0);
  EXPECT_FALSE(point.shut);
  EXPECT_EQ(point.delay_s(), 0.023);
  expect_as_ridden(rig, load_kg, point, 0.002);
}

/// Of a shut one the response is no sine, and the mean of filling and venting what comes nearest.
TEST(Point, OfAServoValveThatIsShutLiesBetweenFillingAndVenting) {
  const plant::Rig rig = smooth();
  const Point point = at_command(rig, load_kg, 11.0);
  EXPECT_TRUE(point.shut);
  const auto fills = at_command(rig, load_kg, 11.0, Threads::sliding, Opening::filling),
             vents = at_command(rig, load_kg, 11.0, Threads::sliding, Opening::venting);
  const double w = 2.0 * std::numbers::pi / (60 * rig.tick_s);
  const double got = std::abs(ridden(rig, load_kg, point, w, 0.005));
  EXPECT_LT(got, std::abs(response(sampled(fills.system(), rig.tick_s), w)));
  EXPECT_GT(got, std::abs(response(sampled(vents.system(), rig.tick_s), w)));
  EXPECT_NEAR(got / std::abs(response(sampled(point.system(), rig.tick_s), w)), 1.0, 0.05);
}

/// Where settling ends it is open by less than any step of a command, now this way, now that.
TEST(Point, OfAServoValveAtRestIsShutEverywhere) {
  for (const double ratio : {0.10, 0.12, 0.14, 0.15, 0.16})
    for (const double kg : {14.0, 18.87, 23.406})
      EXPECT_TRUE(point_at({}, kg, {Place::Of::position, ratio}, Threads::sliding, Opening::both).shut)
          << ratio << ' ' << kg;
}

/// An integrator leaves pressures a few Pa about where they rest: slopes had been of one side, here or there.
TEST(Point, OfAPairHasPolesThatChangeSmoothlyWithItsAngle) {
  plant::Rig rig = plant::thesis_pair();
  *rig.pair() = plant::with_load_in_hand(*rig.pair(), 0.5, 0.4);
  std::vector<Complex> before;
  for (int deg = -20; deg <= 20; deg += 2) {
    const Point point =
        point_at(rig, 0.0, {Place::Of::position, deg * plant::degree_rad}, Threads::sliding, Opening::both);
    EXPECT_TRUE(point.shut && point.settled) << deg;
    const auto all = poles(point.system());
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(std::abs(all.at(i)) / std::abs(before[i]), 1.0, 0.05) << deg << ' ' << i;
    before = all;
  }
}

/// Whichever way a search came there.
TEST(Point, IsInTheMiddleOfWhereFrictionHolds) {
  plant::Rig rig, free = smooth();
  rig.effects.get<plant::GuideFriction>().coefficient = 0.02;
  for (const double ratio : {0.05, 0.13, 0.15, 0.16, 0.20, 0.21}) {
    const auto at = [&](const plant::Rig& of) {
      return point_at(of, 16.138, {Place::Of::position, ratio}, Threads::sliding, Opening::both);
    };
    EXPECT_NEAR(at(rig).command.current_mA, at(free).command.current_mA, 1e-3) << ratio;
    EXPECT_NEAR(gain_at_rest(at(rig).system()) / gain_at_rest(at(free).system()), 1.0, 1e-3) << ratio;
    EXPECT_GT(at(rig).friction_N, 0.02 * 16.138 * 9.8);
    EXPECT_EQ(at(free).friction_N, 0.0);
  }
}

/// Rocking moves the load to where its threads pull neither way, and there the point is.
TEST(Point, OfThreadsThatStickIsAsRidden) {
  plant::Rig rig;
  rig.tick_s = 0.004;
  rig.integrator.tolerance = 1e-11;
  rig.valve = regulator(rig.valve, 0.05);
  constexpr double rocked = 1.0, amplitude = 1e-3;
  const Point before = at_command(rig, load_kg, 11.0);
  Held held(rig, load_kg, before);
  held.settle(rocked);
  const Point point =
      point_at(rig, load_kg, {Place::Of::position, held.position()}, Threads::sticking, Opening::both);
  for (const int ticks : {1000, 200, 60}) {
    const double w = 2.0 * std::numbers::pi / (ticks * rig.tick_s);
    const Complex asked = response(sampled(point.system(), rig.tick_s), w),
                  got = ridden(rig, load_kg, before, w, amplitude, rocked);
    EXPECT_NEAR(std::abs(got) / std::abs(asked), 1.0, 0.01) << w;
    EXPECT_NEAR(std::arg(got / asked) * 180.0 / std::numbers::pi, 0.0, 1.0) << w;
  }
  EXPECT_GT(gain_at_rest(before.system()), 3.0 * gain_at_rest(point.system()));
}

/// Dry friction G in a swing is 4 G/(pi V) of damping.
TEST(Point, OfASwingHasTheDampingOfDryFriction) {
  plant::Rig rig = smooth();
  rig.friction.floor_N = 2.0;
  rig.valve = regulator(rig.valve, 0.05);
  const Point slides = at_command(rig, load_kg, 11.0);
  const auto damping = [](const Point& point) {
    const auto all = poles(point.system());
    const auto swings = std::ranges::find_if(all, [](const Complex& pole) { return pole.imag() > 0.0; });
    return swings == all.end() ? 1.0 : -swings->real() / std::abs(*swings);
  };
  const double mass_kg =
      load_kg + rig.joint.moving_mass_kg +
      rig.joint.wheel_inertia_kg_m2 / (rig.joint.wheel_radius_m * rig.joint.wheel_radius_m);
  for (const double speed : {0.05, 0.2}) {
    const Point swings = slides.swinging(speed);
    EXPECT_NEAR(swings.slopes.A(1, 1) - slides.slopes.A(1, 1),
                -4.0 * 2.0 / (std::numbers::pi * speed) / mass_kg, 1e-9);
    EXPECT_GT(damping(swings), damping(slides));
  }
}

TEST(Point, OfAPairAndOfALeverIsAsRidden) {
  plant::Rig rig = smooth(plant::thesis_pair());
  rig.friction.floor_N = 1e-3;
  rig.valve = regulator(rig.valve, 0.05);
  rig.pair()->opposite.valve = rig.valve;
  rig.pair()->opposite.friction = rig.friction;
  const Point point = point_at(rig, 0.0, {Place::Of::position, 0.1}, Threads::sliding, Opening::both);
  EXPECT_NEAR(point.position, 0.1, 1e-6);
  expect_as_ridden(rig, 0.0, point, 0.02);

  std::vector<domain::InputFile> files;
  plant::Rig turning = smooth(input::read_rig(MCKIBBEN_SOURCE_DIR "/scenarios/rigs/forearm.yaml", files));
  turning.valve = regulator(turning.valve, 0.05);
  turning.joint.guide_damping_N_s_per_m = 100.0;
  expect_as_ridden(turning, 2.0, at_command(turning, 2.0, 11.0), 0.002);
}

/// The valve alone: a regulator's lag is a pole, at any load and place.
// At rest inside it nothing small would act: it is left out, as backlash and hysteresis are.
TEST(Point, HasNoDeadBandOfTheValve) {
  for (const bool regulator : {true, false}) {
    plant::Rig rig;
    if (regulator) {
      rig.valve.kind = plant::ValveKind::regulator;
      rig.valve.time_constant_s = 0.05;
    }
    const auto gain_of = [&] {
      return gain_at_rest(
          point_at(rig, 11.0, {Place::Of::position, 0.12}, Threads::sliding, Opening::both).system());
    };
    const double gain = gain_of();
    if (regulator)
      rig.valve.dead_band_Pa = 1200.0;
    else
      rig.effects.get<plant::ValveDeadBand>().half_width_Pa = 2000.0;
    EXPECT_NEAR(gain_of() / gain, 1.0, 1e-6) << regulator;
    EXPECT_GT(gain, 0.0);
  }
}

TEST(Point, HasThePoleOfARegulatorsLag) {
  plant::Rig rig = smooth();
  rig.valve = regulator(rig.valve, 0.08);
  const auto all = poles(at_command(rig, load_kg, 9.0).system());
  EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                          [](const Complex& pole) { return std::abs(pole + 1.0 / 0.08) < 1e-6; }));
}

TEST(Point, IsFoundByCommandPressureOrPlace) {
  plant::Rig rig;
  const Point by_command = at_command(rig, load_kg, 10.0);
  const Point by_pressure = point_at(rig, load_kg, {Place::Of::pressure, by_command.pressure_Pa[0]},
                                     Threads::sliding, Opening::both);
  EXPECT_NEAR(by_pressure.command.current_mA, 10.0, 1e-3);
  const Point by_place = point_at(rig, load_kg, {Place::Of::position, 0.15}, Threads::sliding, Opening::both);
  EXPECT_NEAR(by_place.position, 0.15, 1e-4);
  EXPECT_THROW(point_at(rig, load_kg, {Place::Of::position, 0.4}, Threads::sliding, Opening::both),
               std::invalid_argument);
  EXPECT_THROW(at_command(rig, load_kg, 25.0), std::invalid_argument);
  EXPECT_THROW(at_command(smooth(), load_kg, 10.0, Threads::sticking), std::invalid_argument);
  rig.valve.kind = plant::ValveKind::on_off;
  EXPECT_THROW(at_command(rig, load_kg, 10.0), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::linear
