// Laws of a user's own at work: the same in doubles, dual numbers and lanes; the same as the effect of the
// catalogue that says the same; absent without size; failing where they are no number.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/engine/dual.hpp>
#include <sim/engine/failure.hpp>
#include <sim/engine/integrator.hpp>
#include <sim/engine/lanes.hpp>
#include <sim/engine/vectorised.hpp>

#include "own_law.hpp"

namespace mckibben::engine {
namespace {

using plant::LawTarget;

const law::Dimension newton_per_metre = law::newton.times(law::metre, -1.0);

plant::OwnLawOf<double> creep(double k, double tau) {
  return own_law(LawTarget::force, "-k * (x - q)", {{"k", newton_per_metre, k}, {"tau", law::second, tau}},
                 {{"q", "(x - q) / tau"}});
}

TEST(OwnLaw, DoublesDualsAndLanesAgree) {
  const std::vector<OwnParameter> parameters{{"F", law::newton, 3.0}, {"n", law::ratio, 1.7}};
  for (const char* text : {"F * e", "F * sqrt(e)", "F * e^n", "F * e^3", "F * tanh(v / 5 [mm/s]) * exp(-e)",
                           "F * log(1 + e)", "F * if(v > 0, e, -2 * e)", "F * min(e, 0.1) - F * max(e, 0.1)",
                           "F * sin(x / 0.01 [m]) + F * cos(e) - F",
                           "F * abs(v) / (v + 1000 [mm/s]) * P / P_valve * F_braid / load"}) {
    const auto law = own_law(LawTarget::force, text, parameters);
    using Number = Dual<2>;
    for (int i = 0; i < 40; ++i) {
      const double e = i == 0 ? 0.0 : 0.008 * i, v = 0.02 * (i - 20);
      const auto at = [&](const auto& ratio, const auto& speed) {
        using S = std::decay_t<decltype(ratio)>;
        return std::array<S, plant::law_inputs>{ratio,    S(0.3 * ratio), speed,  S(2e5), S(2.5e5),
                                                S(110.0), S(90.0),        S(3e5), S(1.0)};
      };
      const auto alone = [&](double ratio, double speed) {
        return plant::value_of(law.text->program,
                               plant::LawNumbers<double, double>{at(ratio, speed), law.values, {}});
      };
      const double value = alone(e, v);
      const Number dual = plant::value_of(
          law.text->program, plant::LawNumbers<Number, double>{
                                 at(Number::unknown(e, 0), Number::unknown(v, 1)), law.values, {}});
      EXPECT_EQ(dual.value, value) << text;
      if (e > 0.0 && v != 0.0 && e != 0.1) {
        const double h = 1e-6;
        EXPECT_NEAR(dual.slopes[0], (alone(e + h, v) - alone(e - h, v)) / (2.0 * h),
                    1e-4 * (1.0 + std::abs(value)))
            << text << " at " << e;
        EXPECT_NEAR(dual.slopes[1], (alone(e, v + h) - alone(e, v - h)) / (2.0 * h),
                    1e-4 * (1.0 + std::abs(value)))
            << text << " at " << v;
      }
      EXPECT_TRUE(std::isfinite(dual.slopes[0])) << text << " at " << e;
      std::array<Lanes, plant::most_law_parameters> in_lanes;
      for (std::size_t k = 0; k < in_lanes.size(); ++k) in_lanes[k] = law.values[k];
      const Lanes lanes = plant::value_of(
          law.text->program, plant::LawNumbers<Lanes, Lanes>{at(Lanes(e), Lanes(v)), in_lanes, {}});
      EXPECT_NEAR(lanes[5], value, 4e-16 * (1.0 + std::abs(value))) << text;
    }
  }
}

/// Where a rig is after `time_s` from rest with its valve asked for 3 bar.
Flow after(const plant::Rig& rig, double time_s, solver::Method method) {
  const plant::Plant plant(rig, 12.0);
  plant::Held held;
  held.reference_pressure_Pa = 1e5;
  Flow flow{.state = plant.at_rest(held)};
  flow.ledger = plant.opened(flow.state);
  held.reference_pressure_Pa = 3e5;
  solver::Settings settings;
  settings.method = method;
  settings.tolerance = 1e-9;
  auto integrator = make_integrator(plant, settings, false);
  for (double t = 0.0; t < time_s; t += 0.01) integrator->advance(flow, held, t, t + 0.01);
  return flow;
}

TEST(OwnLaw, SaysTheSameAsTheEffectThatSaysTheSame) {
  plant::Rig catalogue, own;
  auto& effect = catalogue.effects.get<plant::BladderCreep>();
  effect.stiffness_N_per_m = 700.0;
  effect.time_s = 0.4;
  own.effects.laws.list = {creep(700.0, 0.4)};
  for (const auto method : {solver::Method::erk, solver::Method::cvode}) {
    const Flow a = after(catalogue, 0.5, method), b = after(own, 0.5, method), none = after({}, 0.5, method);
    EXPECT_GT(std::abs(a.state.joint.contraction_ratio - none.state.joint.contraction_ratio), 1e-3);
    EXPECT_NEAR(a.state.joint.contraction_ratio, b.state.joint.contraction_ratio, 1e-8);
    EXPECT_NEAR(a.state.side.muscle_pressure_Pa, b.state.side.muscle_pressure_Pa, 0.01);
  }
}

TEST(OwnLaw, EachTargetMovesWhatItIsSaidTo) {
  const auto with = [&](LawTarget target, const std::string& text, const OwnParameter& size) {
    plant::Rig rig;
    rig.effects.laws.list = {own_law(target, text, {size})};
    return plant::Plant(rig, 12.0);
  };
  plant::Held held;
  held.reference_pressure_Pa = 3e5;
  const plant::State<double> state{{0.1, 0.2}, {2e5, 1.5e5, 1e-5}, {}};
  const auto now = plant::Plant({}, 12.0).moment(state, held);
  const auto force = with(LawTarget::force, "-F * e", {"F", law::newton, 50.0}).moment(state, held);
  EXPECT_DOUBLE_EQ(force.effects_pull_N, -5.0);
  EXPECT_EQ(force.pull_on_load_N, 0.0);
  const auto friction = with(LawTarget::friction_factor, "c", {"c", law::ratio, 0.5}).moment(state, held);
  const double floor_N = plant::Rig{}.friction.floor_N;  // which is not friction of threads
  EXPECT_NEAR(friction.friction_level_N - floor_N, 1.5 * (now.friction_level_N - floor_N), 1e-12);
  const auto leak =
      with(LawTarget::outflow, "q * e", {"q", law::kilogram_per_second, 1e-5}).moment(state, held);
  EXPECT_DOUBLE_EQ(leak.leak_flow, 1e-6);
  const auto asked =
      with(LawTarget::command, "p * (command / P_valve)", {"p", law::pascal, 1e4}).moment(state, held);
  EXPECT_DOUBLE_EQ(asked.pressure_error_Pa, now.pressure_error_Pa + 1.5e4);
  EXPECT_NEAR(with(LawTarget::reading, "s * x / 1 [m]", {"s", law::metre, 0.1})
                  .side()
                  .reading_shift_m({0.1, 0.2}, state.side, {}, held),
              0.003, 1e-15);
}

TEST(OwnLaw, WithoutSizeThereIsNone) {
  plant::Rig rig;
  rig.effects.laws.list = {creep(0.0, 0.4)};
  EXPECT_TRUE(rig.effects.absent());
  EXPECT_FALSE(rig.remembers());
  const Flow a = after(rig, 0.1, solver::Method::erk), b = after({}, 0.1, solver::Method::erk);
  EXPECT_EQ(a.state.joint.contraction_ratio, b.state.joint.contraction_ratio);
}

TEST(OwnLaw, RemembersNoMoreThanThereIsPlaceFor) {
  plant::Rig rig;
  rig.effects.laws.list = {law_of_twelve()};
  EXPECT_NO_THROW(plant::Plant(rig, 12.0));
  rig.effects.laws.list.push_back(creep(1.0, 1.0));
  EXPECT_THROW(plant::Plant(rig, 12.0), std::invalid_argument);
}

// Twelve that creep alike are one with twelve times the stiffness; and beside the time.
TEST(OwnLaw, TwelveMemoriesAreCarried) {
  plant::Rig twelve, one;
  twelve.effects.laws.list = {law_of_twelve()};
  one.effects.laws.list = {creep(12.0 * 50.0, 0.4)};
  for (const auto method : {solver::Method::erk, solver::Method::cvode}) {
    const Flow a = after(twelve, 0.5, method), b = after(one, 0.5, method), none = after({}, 0.5, method);
    EXPECT_GT(std::abs(a.state.joint.contraction_ratio - none.state.joint.contraction_ratio), 1e-3);
    EXPECT_NEAR(a.state.joint.contraction_ratio, b.state.joint.contraction_ratio, 1e-8);
  }
}

TEST(OwnLaw, OtherLawsInEachLaneAreEachTheirOwn) {
  std::vector<plant::Plant> plants;
  const auto squared = own_law(LawTarget::friction_factor, "c * e^2", {{"c", law::ratio, 4.0}});
  const auto timed =
      own_law(LawTarget::force, "F * tanh(t / tau)", {{"F", law::newton, 5.0}, {"tau", law::second, 2.0}});
  for (int i = 0; i < 8; ++i) {
    plant::Rig rig;
    if (i % 2 == 1) rig.effects.laws.list = {creep(100.0 * i, 0.5), squared};
    if (i % 3 == 1) rig.effects.laws.list = {timed, creep(50.0, 0.1 * i)};
    if (i == 6) rig.effects.get<plant::ValveLag>().time_s = 0.1;
    plants.emplace_back(rig, 12.0 + i);
  }
  const auto together = vectorised(plants);
  ASSERT_TRUE(together);
  plant::HeldOf<Lanes> held;
  held.reference_pressure_Pa = Lanes(3e5);
  held.current_speed_mA_per_s = Lanes(0.0);
  plant::State<Lanes> state{{Lanes(0.1), Lanes(-0.3)}, {Lanes(2e5), Lanes(1.5e5), Lanes(1e-5)}, {}};
  plant::Memory<Lanes> memory;
  plant::Memory<double> one;
  for (std::size_t i = 0; i < one.side.size(); ++i) {
    one.side[i] = 0.1 * static_cast<double>(i + 1);
    memory.side[i] = Lanes(one.side[i]);
  }
  const auto all = together->moment<1>(state, memory, held);
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
    plant::Held alone_held;
    alone_held.reference_pressure_Pa = 3e5;
    const auto alone =
        plants[lane].moment<1>(plant::State<double>{{0.1, -0.3}, {2e5, 1.5e5, 1e-5}, {}}, one, alone_held);
    EXPECT_NEAR(all.effects_pull_N[lane], alone.effects_pull_N,
                1e-13 * (1.0 + std::abs(alone.effects_pull_N)))
        << lane;
    EXPECT_NEAR(all.friction_level_N[lane], alone.friction_level_N, 1e-12 * alone.friction_level_N) << lane;
    for (std::size_t i = 0; plants[lane].remembers() && i < one.side.size(); ++i)
      EXPECT_NEAR(all.memory_rates[i][lane], alone.memory_rates[i], 1e-12) << lane << " " << i;
  }
}

TEST(OwnLaw, ThatIsNoNumberFailsWithItsName) {
  plant::Rig rig;
  rig.effects.laws.list = {own_law(LawTarget::force, "-F * sqrt(0.03 - e)", {{"F", law::newton, 5.0}})};
  try {
    after(rig, 0.5, solver::Method::automatic);
    FAIL() << "it went on";
  } catch (const NumericalFailure& failure) {
    EXPECT_NE(failure.cause.find("the law own (effects.hypotheses) is not a number here"), std::string::npos)
        << failure.cause;
    EXPECT_NEAR(failure.state.joint.contraction_ratio, 0.03, 1e-3);
  }
}

}  // namespace
}  // namespace mckibben::engine
