// Other drives and two muscles against an independent program: fixed steps of 20 us, fourth order, same
// equations. A muscle at given pressure, with a load or at a given length; two muscles on one wheel.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <sim/ride/ride.hpp>

#include "table_of.hpp"

namespace mckibben::ride {
namespace {

using solver::Method;

constexpr double stamp_s = 0.012, bar = plant::Pa_per_bar;
constexpr int settling = 167;  // ticks, 2.004 s

Table read_reference(const std::string& name) {
  const Table columns = table_of(MCKIBBEN_TEST_DATA "/reference/" + name + ".csv");
  EXPECT_GE(columns.at("time_s").size(), 750u);
  return columns;
}

/// Worst differences of a trajectory.
struct Errors {
  double e = 0.0, bar = 0.0, N = 0.0;
};

void note(double& worst, double difference) {
  worst = std::max(worst, std::abs(difference));
}

class Driven : public testing::TestWithParam<Method> {
 protected:
  solver::Settings loose() const { return {GetParam(), solver::Settings{}.tolerance}; }
  solver::Settings tight() const { return {GetParam(), solver::tightest_tolerance}; }

  static Errors at_given_pressure(const char* name, double load_kg, const solver::Settings& settings) {
    const Table reference = read_reference(name);
    const auto& given = reference.at("muscle_pressure_bar");
    Ride ride(Loaded{plant::Rig{}, load_kg}, settings);
    Drive drive;
    drive.muscle_pressure_Pa = bar * given.front();
    ride.start(drive, -settling * stamp_s);
    for (int k = -settling; k < 0; ++k) ride.step(drive, (k + 1) * stamp_s);
    Errors worst;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const auto& joint = ride.flow().state.joint;
      note(worst.e, joint.contraction_ratio - reference.at("contraction_ratio")[k]);
      EXPECT_EQ(ride.reading().of(plant::Sensed::muscle_pressure), bar * given[k]);
      if (k + 1 == given.size()) break;
      drive.muscle_pressure_Pa = bar * given[k + 1];
      ride.step(drive, static_cast<double>(k + 1) * stamp_s);
    }
    return worst;
  }

  static Errors at_given_length(const char* name, const solver::Settings& settings) {
    const Table reference = read_reference(name);
    const auto& pressure = reference.at("muscle_pressure_bar");
    const auto& length = reference.at("contraction_ratio");
    Ride ride(Loaded{plant::Rig{}, 0.0}, settings);
    Drive drive;
    drive.muscle_pressure_Pa = bar * pressure.front();
    drive.contraction_ratio = length.front();
    ride.start(drive, 0.0);
    Errors worst;
    for (std::size_t k = 0; k + 1 < length.size(); ++k) {
      drive.muscle_pressure_Pa = bar * pressure[k + 1];
      drive.contraction_ratio = length[k + 1];
      ride.hold(drive, static_cast<double>(k + 1) * stamp_s);
      note(worst.N, ride.moment().cord_force_N() - reference.at("force_N")[k]);
      ride.advance();
      EXPECT_EQ(ride.flow().state.joint.contraction_ratio, length[k + 1]);
    }
    return worst;
  }

  static Errors of_pair(const char* name, const solver::Settings& settings) {
    const Table reference = read_reference(name);
    const auto& one = reference.at("current_1_mA");
    const auto& two = reference.at("current_2_mA");
    Ride ride(Loaded{plant::thesis_pair()}, settings);
    const plant::Plant& plant = ride.plant();
    Drive drive;
    const auto hold = [&](std::size_t k) {
      drive.current_mA = one[k];
      drive.opposite.current_mA = two[k];
    };
    hold(0);
    ride.start(drive, -settling * stamp_s);
    for (int k = -settling; k < 0; ++k) ride.step(drive, (k + 1) * stamp_s);
    Errors worst;
    for (std::size_t k = 0; k < one.size(); ++k) {
      const auto& state = ride.flow().state;
      const auto now = ride.moment();
      note(worst.e, 0.1 * (plant.angle_rad(state.joint.contraction_ratio) - reference.at("angle_rad")[k]));
      note(worst.bar, state.side.valve_pressure_Pa / bar - reference.at("valve_pressure_1_bar")[k]);
      note(worst.bar, state.side.muscle_pressure_Pa / bar - reference.at("muscle_pressure_1_bar")[k]);
      note(worst.bar, state.opposite.valve_pressure_Pa / bar - reference.at("valve_pressure_2_bar")[k]);
      note(worst.bar, state.opposite.muscle_pressure_Pa / bar - reference.at("muscle_pressure_2_bar")[k]);
      note(worst.N, now.cord_force_N() - reference.at("tension_1_N")[k]);
      note(worst.N, now.opposite.cord_force_N() - reference.at("tension_2_N")[k]);
      hold(k);
      if (k + 1 < one.size()) ride.step(drive, static_cast<double>(k + 1) * stamp_s);
    }
    return worst;
  }
};

TEST_P(Driven, AMuscleAtGivenPressureLiftsItsLoadAsTheReferenceDoes) {
  for (const auto& [name, load_kg] :
       {std::pair{"pressure_12.5kg_sine", 12.5}, {"pressure_18.87kg_steps", 18.87}}) {
    EXPECT_LT(at_given_pressure(name, load_kg, loose()).e, 2e-6) << name;
    EXPECT_LT(at_given_pressure(name, load_kg, tight()).e, 1e-8) << name;
  }
}

TEST_P(Driven, AMuscleAtGivenLengthPullsAsTheReferenceDoes) {
  for (const char* name : {"held_length", "held_moving"})
    EXPECT_LT(at_given_length(name, loose()).N, 0.05) << name;
}

TEST_P(Driven, TwoMusclesTurnTheWheelAsTheReferenceDoes) {
  for (const char* name : {"pair_opposed", "pair_steps", "pair_triangle"}) {
    const Errors worst = of_pair(name, loose());
    EXPECT_LT(worst.e, 2e-6) << name;
    EXPECT_LT(worst.bar, 1e-4) << name;
    EXPECT_LT(worst.N, 0.05) << name;
    EXPECT_LT(of_pair(name, tight()).e, 1e-8) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Driven, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

}  // namespace
}  // namespace mckibben::ride
