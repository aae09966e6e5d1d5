// Intervals where the misfit is no parabola: against fits in which the number is held at the ends.
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/diagnose/profile.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Runs of a rig with an effect, and the fit of it beside some numbers of the rig.
struct Valleys {
  domain::Dataset data;
  Experiment experiment;
  Runs runs;
  Fitted fitted{};
  std::vector<Bounds> bounds{};

  Valleys(const plant::Rig& truth, const char* effect, std::vector<double> loads_kg, double duration_s,
          double jitter)
      : data([&] {
          auto currents = three_kinds();
          currents.resize(1);
          currents.front().duration_s = duration_s;
          return planted(truth, std::move(loads_kg), currents, 7, {}, jitter);
        }()),
        experiment(data, nothing_masked(data), 2) {
    for (std::size_t run = 0; run < data.runs.size(); ++run) runs.push_back(run);
    Model model{.rig = data.rig};
    for (const Parameter& p : nominal_parameters(data.rig))
      if (p.path == "friction.scale" || p.path == "muscle.rest_radius") model.free.push_back(p);
    for (const Candidate& c : catalogue())
      if (c.effect == effect && model.effects.empty()) {
        model.rig = c.chosen(model.rig);
        c.put(model.rig, c.typical, c.shapes.empty() ? 0.0 : c.shapes[1]);
        const auto more = c.parameters(model.rig);
        model.free.insert(model.free.end(), more.begin(), more.end());
        model.effects.push_back(c);
      }
    fitted = fit(experiment, model, runs, {.inflation = inflation, .thorough = true});
    bounds = intervals(experiment, fitted, runs, inflation);
    trust_or_profile(experiment, fitted, runs, inflation, worth_a_profile(fitted.model), bounds);
  }

  std::size_t place(const std::string& path) const {
    const auto found = std::ranges::find(fitted.model.free, path, &Parameter::path);
    return static_cast<std::size_t>(found - fitted.model.free.begin());
  }
  /// The number stands here, and all others are fitted anew.
  Fitted held_at(const std::string& path, double value) const {
    const std::size_t j = place(path);
    Model held = fitted.model;
    held.free[j].put(held.rig, value);
    held.free.erase(held.free.begin() + static_cast<std::ptrdiff_t>(j));
    return fit(experiment, held, runs, {.inflation = inflation, .thorough = true});
  }
  /// By how much of what it should the cost rises there.
  double rise_at(const std::string& path, double value) const {
    return (held_at(path, value).cost - fitted.cost) / bounds[place(path)].rise;
  }

  double inflation = 1.0;  ///< white noise
};

/// Creep that goes on for longer than these runs of 2.5 s, whose readings scatter by half a millimetre.
Valleys creeping(double stiffness_N_per_m, double time_s, double jitter) {
  plant::Rig truth;
  auto& creep = truth.effects.get<plant::BladderCreep>();
  creep.stiffness_N_per_m = stiffness_N_per_m;
  creep.time_s = time_s;
  return {truth, "bladder_creep", {11.138, 16.138}, 2.5, jitter};
}
const std::string creep_time = "effects.bladder_creep.time";

TEST(Profile, EndsWhereTheMisfitHasRisenAsFarAsTheParabolaShould) {
  const Valleys valleys = creeping(30.0, 1.0, 2e-3);
  const Bounds& time = valleys.bounds[valleys.place(creep_time)];
  ASSERT_TRUE(time.quadratic);
  EXPECT_LT(valleys.rise_at(creep_time, time.quadratic->back()), 0.6);  // by slopes: far too short
  EXPECT_NEAR(valleys.rise_at(creep_time, time.low), 1.0, 0.15);
  EXPECT_NEAR(valleys.rise_at(creep_time, time.high), 1.0, 0.15);
  EXPECT_GT(std::log(time.high / time.value), 2.0 * std::log(time.value / time.low));
  EXPECT_TRUE(time.determined);
}

TEST(Profile, EndsAtABoundWhereTheMisfitHasNotRisenAsFar) {
  const Valleys valleys = creeping(60.0, 4.0, 2.5e-3);
  const std::size_t place = valleys.place(creep_time);
  const Bounds& time = valleys.bounds[place];
  ASSERT_TRUE(time.quadratic);
  EXPECT_LT(time.quadratic->back(), 20.0);
  EXPECT_NEAR(time.high, valleys.fitted.model.free[place].highest, 1e-9);
  EXPECT_LT(valleys.rise_at(creep_time, time.high), 0.9);
  EXPECT_GT(time.low, time.quadratic->front());  // which is too long on this side
  EXPECT_TRUE(time.determined);
}

TEST(Profile, IsNotNeededWhereTheValleyIsAParabola) {
  plant::Rig truth;
  truth.effects.get<plant::BladderElasticity>().stiffness_N_per_m = 100.0;
  truth.muscle.rest_radius_m *= 1.02;
  const Valleys valleys(truth, "bladder_elasticity", {11.138, 16.138, 23.406}, 3.0, 5e-5);
  const Model& model = valleys.fitted.model;
  EXPECT_GT(worth_a_profile(model).size(), 1u);
  for (const Bounds& bounds : valleys.bounds) EXPECT_FALSE(bounds.quadratic) << bounds.value;

  // Nor if the fit ended a little beside its bottom.
  const std::string stiffness = "effects.bladder_elasticity.stiffness";
  const std::size_t place = valleys.place(stiffness);
  const Parameter& p = model.free[place];
  const Bounds& of = valleys.bounds[place];
  const auto rig = valleys.held_at(stiffness, p.unscaled(p.scaled(of.value) + 0.25 * of.half)).model.rig;
  auto told = valleys.experiment.slopes(rig, model.free, valleys.runs);
  Fitted beside{.model = model, .residuals = std::move(told.residuals), .columns = std::move(told.columns)};
  beside.model.rig = rig;
  auto bounds = intervals(valleys.experiment, beside, valleys.runs, valleys.inflation);
  trust_or_profile(valleys.experiment, beside, valleys.runs, valleys.inflation, {place}, bounds);
  EXPECT_GT(bounds[place].value, of.value);
  EXPECT_FALSE(bounds[place].quadratic);
}

}  // namespace
}  // namespace mckibben::diagnose
