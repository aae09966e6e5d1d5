// Rigs carried side by side: each goes where it would go alone,
// and differences between them are sensitivities.
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <sim/engine/flock.hpp>

#include "rig_on_bench.hpp"

namespace mckibben::engine {
namespace {

/// Contraction of each rig after a second of a rising current, in one flock.
std::vector<double> fly(const std::vector<plant::Plant>& plants, double tolerance) {
  const auto flock = make_flock(plants, tolerance);
  std::vector<Flow> flows(plants.size());
  std::vector<plant::Held> held(plants.size());
  std::vector<Bound> bound;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    held[i].reference_pressure_Pa = plants[i].reference_pressure_Pa(4.0);
    flows[i].state = plants[i].at_rest(held[i]);
    bound.push_back({&flows[i], &held[i]});
  }
  for (int k = 0; k < 84; ++k) {
    for (std::size_t i = 0; i < plants.size(); ++i)
      held[i].reference_pressure_Pa = plants[i].reference_pressure_Pa(4.0 + 0.15 * k);
    flock->advance(bound, 0.012 * k, 0.012 * (k + 1));
  }
  std::vector<double> ratios;
  for (const Flow& flow : flows) ratios.push_back(flow.state.joint.contraction_ratio);
  return ratios;
}

plant::Plant with_radius(double radius_m) {
  plant::Rig rig;
  rig.muscle.rest_radius_m = radius_m;
  return {rig, 16.138};
}

TEST(Flock, CarriesEachRigWhereItGoesAlone) {
  plant::Rig lagging;
  lagging.effects.get<plant::ValveLag>().time_s = 0.03;
  const std::vector<plant::Plant> plants{{plant::Rig{}, 11.0}, {lagging, 16.138}, {plant::Rig{}, 23.0}};
  const auto together = fly(plants, 1e-9);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    RigOnBench alone(plants[i].rig(), i == 0 ? 11.0 : i == 1 ? 16.138 : 23.0, {Method::erk, 1e-9});
    alone.start(4.0);
    for (int k = 0; k < 84; ++k) alone.hold(4.0 + 0.15 * k);
    EXPECT_NEAR(together[i], alone.flow.state.joint.contraction_ratio, 1e-7) << i;
    EXPECT_GT(together[i], 0.05);
  }
}

TEST(Flock, RigsThatDifferInMoreThanNumbersGoToo) {
  plant::Rig area, log;
  area.friction.law = plant::FrictionLaw::area;
  log.friction.law = plant::FrictionLaw::logarithmic;
  const std::vector<plant::Plant> plants{{plant::Rig{}, 16.138}, {area, 16.138}, {log, 16.138}};
  const auto together = fly(plants, 1e-9);
  for (std::size_t i = 0; i < plants.size(); ++i)
    EXPECT_NEAR(together[i], fly({plants[i]}, 1e-9)[0], 1e-7) << i;
  EXPECT_NE(together[0], together[1]);
}

TEST(Flock, DifferencesOverATinyChangeAreSensitivities) {
  constexpr double radius_m = 7.5e-3;
  const double h = 1e-9;
  const auto near = fly({with_radius(radius_m), with_radius(radius_m + h)}, 1e-5);  // a loose tolerance
  const auto wide = fly({with_radius(radius_m - 2e-6), with_radius(radius_m + 2e-6)}, 1e-11);
  const double slope = (near[1] - near[0]) / h, exact = (wide[1] - wide[0]) / 4e-6;
  EXPECT_GT(std::abs(exact), 1.0);
  EXPECT_NEAR(slope, exact, 5e-3 * std::abs(exact));
}

TEST(Flock, RefusesExactStickAndSlip) {
  plant::Rig rig;
  rig.friction.memory = plant::FrictionMemory::coulomb;
  const std::vector<plant::Plant> plants{{rig, 16.0}};
  EXPECT_THROW(make_flock(plants, 1e-6), std::invalid_argument);
  EXPECT_THROW(make_flock({}, 1e-6), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::engine
