// The rig near a point: slopes against differences of the equations, and against a ride after a small step.
#include <array>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <sim/engine/integrator.hpp>
#include <sim/engine/linear.hpp>

#include "switched_on.hpp"

namespace mckibben::engine {
namespace {

constexpr std::array<double, 2> currents{9.0, 8.0};

/// Under way, valves filling and partly open: one that is wide open hears no more.
Flow lifting(const plant::Plant& plant) {
  const auto filling_Pa = [](const plant::SideOf<double>& side, double current_mA) {
    return side.reference_pressure_Pa(current_mA) - 0.4 * side.rig().valve.proportional_band_Pa;
  };
  const double one_Pa = filling_Pa(plant.side(), currents[0]);
  const double two_Pa = plant.opposite() ? filling_Pa(*plant.opposite(), currents[1]) : 0.0;
  Flow flow;
  flow.state = {{0.1, 0.2}, {one_Pa, one_Pa - 2e4, 3e-5}, {two_Pa, two_Pa - 2e4, -3e-5}};
  return flow;
}

plant::Held held_of(const plant::Plant& plant) {
  plant::Held held;
  held.reference_pressure_Pa = plant.reference_pressure_Pa(currents[0]);
  held.current_speed_mA_per_s = 4.0;
  if (plant.opposite()) {
    held.opposite.reference_pressure_Pa = plant.opposite()->reference_pressure_Pa(currents[1]);
    held.opposite.current_speed_mA_per_s = -3.0;
  }
  return held;
}

/// Of the inputs of one side, by differences: rates of the joint and of that side's pressures.
void expect_input_slopes(const plant::Plant& plant, bool opposite) {
  const Flow flow = lifting(plant);
  const Linear linear = linearise(plant, flow, held_of(plant), currents);
  const auto rates = [&](double mA, double mA_per_s) {
    plant::Held held = held_of(plant);
    plant::HeldSide& side = opposite ? held.opposite : held;
    side.reference_pressure_Pa =
        (opposite ? *plant.opposite() : plant.side()).reference_pressure_Pa(currents[opposite] + mA);
    side.current_speed_mA_per_s += mA_per_s;
    const auto state = plant.rates(flow.state, plant.moment(flow.state, flow.memory, held));
    return std::array{state.joint.contraction_speed_per_s,
                      (opposite ? state.opposite : state.side).valve_pressure_Pa,
                      (opposite ? state.opposite : state.side).bristle_m};
  };
  const std::array<Eigen::Index, 3> rows{1, opposite ? 5 : 2, opposite ? 7 : 4};
  const Eigen::Index column = opposite ? 2 : 0;
  constexpr double h = 1e-4;
  const auto up = rates(h, 0.0), down = rates(-h, 0.0), faster = rates(0.0, h), slower = rates(0.0, -h);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double by_current = (up[i] - down[i]) / (2.0 * h), by_speed = (faster[i] - slower[i]) / (2.0 * h);
    EXPECT_NEAR(linear.B(rows[i], column), by_current, 1e-6 * std::abs(by_current) + 1e-9) << i;
    EXPECT_NEAR(linear.B(rows[i], column + 1), by_speed, 1e-6 * std::abs(by_speed) + 1e-9) << i;
  }
  EXPECT_FALSE(linear.B.col(column).isZero(0.0));
}

TEST(Linear, InputsActAsDifferencesOfTheEquationsSay) {
  plant::Rig rig;
  rig.friction.f1_s2_per_mA2 = 0.01;  // so that the current's speed acts
  expect_input_slopes(plant::Plant(rig, 15.0), false);
  expect_input_slopes(plant::Plant(rig, rig, {}), false);
  expect_input_slopes(plant::Plant(rig, rig, {}), true);
  expect_input_slopes(plant::Plant(plant::rig_with_all_effects(), 15.0), false);
}

TEST(Linear, NamesWhatItHoldsAndLeavesOutWhatIsNotAtWork) {
  const auto names = [](const std::vector<Signal>& signals) {
    std::string all;
    for (const auto& signal : signals) all += signal.name + " ";
    return all;
  };
  plant::Rig rig;
  const plant::Plant plain(rig, 15.0);
  const Linear linear = linearise(plain, lifting(plain), held_of(plain), currents);
  EXPECT_EQ(names(linear.states),
            "contraction_ratio contraction_speed_per_s valve_pressure_Pa muscle_pressure_Pa bristle_m ");
  EXPECT_EQ(names(linear.inputs), "current_mA current_speed_mA_per_s load_force_N ");
  EXPECT_EQ(names(linear.outputs), "contraction_ratio muscle_pressure_Pa force_N ");
  plant::switch_on(rig.effects.get<plant::BladderCreep>(), plant::BladderCreep::variants.front());
  const plant::Plant creeping(rig, 15.0);
  const Linear more = linearise(creeping, lifting(creeping), held_of(creeping), currents);
  EXPECT_EQ(more.states.back().name, "bladder_creep");
  EXPECT_EQ(more.states.back().unit, "m");
  EXPECT_EQ(more.A.rows(), 6);
  EXPECT_EQ(more.C.cols(), 6);
}

TEST(Linear, AForceOnTheLoadIsAsIfItWereLighter) {
  const plant::Plant plant(plant::Rig{}, 15.0);
  const Linear linear = linearise(plant, lifting(plant), held_of(plant), currents);
  EXPECT_NEAR(linear.B(1, 2) * plant.moved_kg() * plant.rig().muscle.rest_length_m, 1.0, 1e-12);
}

/// A small step of current from the same point, with and without, against the first terms of the matrices'
/// exponential.
TEST(Linear, FollowsASmallStep) {
  const plant::Plant plant(plant::Rig{}, 15.0);
  constexpr double length_s = 2e-4, step_mA = 1e-4;
  const Linear linear = linearise(plant, lifting(plant), held_of(plant), currents);
  const auto reached = [&](double mA) {
    plant::Held held = held_of(plant);
    held.reference_pressure_Pa = plant.reference_pressure_Pa(currents[0] + mA);
    Flow flow = lifting(plant);
    make_integrator(plant, {solver::Method::erk, solver::tightest_tolerance}, false)
        ->advance(flow, held, 0.0, length_s);
    return flow.state;
  };
  const auto with = reached(step_mA), without = reached(-step_mA);
  Eigen::VectorXd term = linear.B.col(0) * (2.0 * step_mA) * length_s, sum = term;
  for (int k = 2; k < 30; ++k) sum += term = linear.A * term * (length_s / k);
  const double valve_Pa = with.side.valve_pressure_Pa - without.side.valve_pressure_Pa;
  const double muscle_Pa = with.side.muscle_pressure_Pa - without.side.muscle_pressure_Pa;
  EXPECT_NEAR(sum[2], valve_Pa, 0.02 * std::abs(valve_Pa));  // the point has moved on meanwhile
  EXPECT_NEAR(sum[3], muscle_Pa, 0.05 * std::abs(muscle_Pa));
  EXPECT_GT(valve_Pa, 0.0);
}

TEST(Linear, RefusesWhatHasNoSlopes) {
  plant::Rig rig;
  const plant::Plant plant(rig, 15.0);
  plant::Held held = held_of(plant);
  held.given = plant::GivenPressure::muscle;
  EXPECT_THROW(linearise(plant, lifting(plant), held, currents), std::invalid_argument);
  Flow outside = lifting(plant);
  outside.state.joint.contraction_ratio = 0.9;
  EXPECT_THROW(linearise(plant, outside, held_of(plant), currents), std::invalid_argument);
  rig.friction.memory = plant::FrictionMemory::coulomb;
  const plant::Plant coulomb(rig, 15.0);
  EXPECT_THROW(linearise(coulomb, lifting(coulomb), held_of(coulomb), currents), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::engine
