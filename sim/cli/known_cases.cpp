// The known cases; see the header.
#include <algorithm>
#include <cmath>
#include <functional>

#include <sim/cli/known_cases.hpp>
#include <sim/engine/failure.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::cli {
namespace {

constexpr double tick_s = 0.012;

/// Holds a current [mA] for some ticks.
void hold(ride::Ride& ride, double current_mA, int ticks) {
  const auto begun = std::lround(ride.time_s() / tick_s);
  for (int k = 1; k <= ticks; ++k)
    ride.step({{.current_mA = current_mA}}, tick_s * static_cast<double>(begun + k));
}

/// Through a choked valve air flows at a constant rate: the pressure rises along a straight line, R T / V
/// times the flow (ISO 6358). Returns the relative error after a tick.
double choked_filling(const solver::Settings& settings) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
  rig.valve.supply_pressure_Pa = 20e5;       // choked up to 5.3 bar of gauge pressure
  ride::Ride ride(ride::Hanging{rig, 10.0}, settings);
  ride.start({{.current_mA = 4.0}}, 0.0);
  hold(ride, 20.0, 1);  // more than a proportional band away: fully open
  const double flow_kg_per_s = 4e-9 * 1.185 * (20e5 + 101325.0);
  const double rise_Pa = 287.05 * 293.15 / 5e-5 * flow_kg_per_s * tick_s;
  return std::abs((ride.flow().state.side.valve_pressure_Pa - 0.5e5) / rise_Pa - 1.0);
}

/// Without pull and friction the load falls freely: e - g t^2 / (2 l0). Returns the error of e.
double free_fall(const solver::Settings& settings) {
  plant::Rig rig;
  rig.muscle.rest_radius_m = 5e-4;  // a thread: its pull is a few millionths of the weight
  rig.valve.zero_pressure_Pa = 0.0;
  rig.friction.memory = plant::FrictionMemory::coulomb;  // with next to no level
  rig.friction.scale = 0.0;
  rig.friction.floor_N = 1e-3;
  rig.joint.guide_damping_N_s_per_m = 0.0;
  rig.joint.wheel_inertia_kg_m2 = 0.0;
  ride::Ride ride(ride::Hanging{rig, 400.0}, settings);
  ride.start({{.current_mA = 4.0}}, 0.0);
  auto lifted = ride.save();
  lifted.riders[0].flow.state.joint.contraction_ratio = 0.28;
  lifted.riders[0].held.slip = plant::Slip::falling;
  ride.restore(lifted);
  hold(ride, 4.0, 10);
  const double t_s = 10 * tick_s;
  const double expected = 0.28 - 0.5 * 9.80665 * t_s * t_s / 0.3;
  return std::abs(ride.flow().state.joint.contraction_ratio - expected);
}

/// The thesis's rig under steps of current. Returns the largest error of e at the stored rows; those of the
/// pressure count as much if they are fifty times as large in bar.
double stored_steps(const solver::Settings& settings) {
  ride::Ride ride(ride::Hanging{plant::Rig{}, stored_load_kg}, settings);
  ride.start({{.current_mA = stored_rows[0].current_mA}}, 0.0);
  hold(ride, stored_rows[0].current_mA, 167);  // settling
  double worst = 0.0;
  for (const StoredRow& row : stored_rows) {
    const auto& state = ride.flow().state;
    worst = std::max({worst, std::abs(state.joint.contraction_ratio - row.contraction_ratio),
                      std::abs(state.side.muscle_pressure_Pa / 1e5 - row.muscle_pressure_bar) / 50.0});
    hold(ride, row.current_mA, stored_ticks);
  }
  return worst;
}

}  // namespace

std::vector<KnownCase> known_cases(double tolerance) {
  struct Case {
    const char *name, *unit;
    double allowed;
    std::function<double(const solver::Settings&)> error;
  };
  const Case cases[] = {{"choked filling, closed form", "of the rise in pressure", 1e-4, choked_filling},
                        {"free fall, closed form", "contraction ratio", 2e-5, free_fall},
                        {"steps of current, stored", "contraction ratio", 2e-6, stored_steps}};
  std::vector<KnownCase> results;
  for (const Case& one : cases)
    for (const solver::Method method : {solver::Method::erk, solver::Method::cvode}) {
      KnownCase result{
          .name = one.name, .method = method, .allowed = one.allowed, .unit = one.unit, .failure = {}};
      try {
        result.error = one.error({method, tolerance});
      } catch (const engine::NumericalFailure& failure) {
        result.failure = failure.what();
      }
      results.push_back(std::move(result));
    }
  return results;
}

}  // namespace mckibben::cli
