// The Jacobian by dual numbers is the slope of the equations, with every law and effect.
#include <array>

#include <gtest/gtest.h>

#include <sim/engine/jacobian.hpp>

#include "own_law.hpp"
#include "slopes.hpp"
#include "switched_on.hpp"

namespace mckibben::engine {
namespace {

TEST(Jacobian, IsTheSlopeOfTheEquations) {
  for (const auto law : {plant::FrictionLaw::superposition, plant::FrictionLaw::area,
                         plant::FrictionLaw::logarithmic, plant::FrictionLaw::power}) {
    plant::Rig rig;
    rig.friction.law = law;
    expect_slopes<Layout<1, plant::Memories::none, Books::isothermal>>(rig);
  }
}

TEST(Jacobian, KnowsEveryEffectAndWhatItRemembers) {
  expect_slopes<Layout<1, plant::Memories::few, Books::polytropic>>(plant::rig_with_all_effects());
  for (const auto& [name, rig] : plant::rigs_with_one_effect()) {
    SCOPED_TRACE(name);
    if (plant::Plant(rig, 15.0).remembers())
      expect_slopes<Layout<1, plant::Memories::few, Books::none>>(rig);
    else
      expect_slopes<Layout<1, plant::Memories::none, Books::none>>(rig);
  }
}

TEST(Jacobian, KnowsStopsAndLawsThatRememberMuch) {
  plant::Rig rig = plant::rig_with_all_effects();
  rig.effects.get<plant::BladderHysteresis>().stops = plant::BladderHysteresis::most_stops;
  rig.effects.laws.list = {law_of_twelve()};
  rig.effects.laws.take_places();
  ASSERT_EQ(rig.memories(), plant::Memories::all);
  expect_slopes<Layout<1, plant::Memories::all, Books::polytropic>>(rig);
  expect_slopes<Layout<2, plant::Memories::all, Books::polytropic>>(rig);
}

TEST(Jacobian, KnowsTwoMuscles) {
  expect_slopes<Layout<2, plant::Memories::few, Books::polytropic>>(plant::Rig{});
  expect_slopes<Layout<2, plant::Memories::few, Books::polytropic>>(plant::rig_with_all_effects());
}

TEST(Jacobian, KnowsLeversAndStops) {
  plant::Rig hanging, points, table;
  hanging.joint.lowest_ratio = 0.02;
  hanging.joint.highest_ratio = 0.2;
  plant::Lever lever;
  lever.spring_N_m_per_rad = 2.0;
  points.mechanics = lever;
  points.joint.lowest_rad = 0.2;
  points.joint.highest_rad = 1.2;
  lever.arms = {{-0.5, 0.03}, {0.5, 0.06}, {2.0, 0.04}};
  lever.plane = plant::Plane::horizontal;
  table.mechanics = lever;
  for (const plant::Rig& rig : {hanging, points, table})
    expect_slopes<Layout<1, plant::Memories::none, Books::isothermal>>(rig);
}

TEST(Jacobian, KnowsCordsThatStretch) {
  plant::Rig rig, lever;
  rig.muscle.cord = lever.muscle.cord = {2e4, 100.0, 0.1};
  rig.effects.get<plant::GuideFriction>().coefficient = 0.02;
  lever.mechanics = plant::Lever{};
  expect_slopes<Layout<1, plant::Memories::all, Books::polytropic>>(rig);
  expect_slopes<Layout<1, plant::Memories::all, Books::polytropic>>(lever);
  rig.effects = {};
  expect_slopes<Layout<2, plant::Memories::all, Books::polytropic>>(rig);
}

TEST(Jacobian, IsRefusedOutsideTheDomain) {
  const plant::Plant plant(plant::Rig{}, 15.0);
  const Problem<Layout<1, plant::Memories::none, Books::none>> problem(plant);
  const std::array<double, plant::single_size> y{0.9, 0.0, 1e5, 1e5, 0.0};
  Eigen::Matrix<double, plant::single_size, plant::single_size> result;
  EXPECT_FALSE(jacobian(problem, y.data(), result));
}

}  // namespace
}  // namespace mckibben::engine
