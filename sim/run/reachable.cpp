// The largest speed is where the flow needed meets the flow to be had; both come from the plant's own laws.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <plant/geometry.hpp>
#include <plant/plant.hpp>
#include <sim/run/reachable.hpp>

namespace mckibben::run {
namespace {

using plant::Held;
using plant::State;

constexpr std::size_t grid_rows = 50, grid_columns = 30;
constexpr double lightest_kg = 1.0;
constexpr double slope_step = 1e-4;  // in e, for dP/de
constexpr double slow_per_s = 1e-3;  // a ramp so slow that only its lag is left
constexpr double far_too_fast_per_s = 100.0;

// Where an ascending function passes through zero: regula falsi (Illinois).
// The end nearer to zero if it does not.
double root(const auto& f, double low, double high) {
  double at_low = f(low), at_high = f(high);
  if (at_low >= 0.0) return low;
  if (at_high <= 0.0) return high;
  int side = 0;
  double x = low;
  for (int i = 0; i < 60; ++i) {
    const double before = x;
    x = (low * at_high - high * at_low) / (at_high - at_low);
    const double value = f(x);
    if (value == 0.0 || (i > 0 && std::abs(x - before) <= 1e-9 * std::abs(x))) break;
    if (value < 0.0) {
      low = x;
      at_low = value;
      if (side == -1) at_high *= 0.5;
      side = -1;
    } else {
      high = x;
      at_high = value;
      if (side == 1) at_low *= 0.5;
      side = 1;
    }
  }
  return x;
}

/// One load moving in one direction.
class Moving {
 public:
  Moving(const plant::Rig& rig, double load_kg, double direction)
      : rig_(rig),
        plant_(rig, load_kg),
        braid_(rig.muscle),
        weight_N_((load_kg + rig.joint.load_offset_kg) * plant::gravity_m_per_s2),
        direction_(direction) {}

  /// Contraction ratio at which the load comes to rest when the muscle is at that pressure, moving so.
  double rest_ratio(double pressure_Pa) const {
    const double top = braid_.largest_contraction_ratio();
    return root([&](double e) { return -surplus_N(e, 0.0, pressure_Pa); }, 0.0, top);
  }

  /// Largest speed [1/s], positive, at which the load can pass a contraction ratio.
  double largest_speed_per_s(double e) const {
    return root([&](double speed) { return -spare_flow(e, speed); }, 0.0, far_too_fast_per_s);
  }

  /// Time [s] by which muscle pressure stays behind the valve's reference in a slow ramp.
  double lag_s(double e) const {
    const Need need = need_at(e, slow_per_s);
    Held held;
    State<double> state = state_at(e, need.muscle_Pa);
    state.side.valve_pressure_Pa = need.valve_Pa;
    const plant::Valve& valve = rig_.valve;
    const double most_Pa =
        valve.is_servo() ? valve.proportional_band_Pa : valve.span_pressure_Pa - valve.zero_pressure_Pa;
    const double opened_Pa = root(
        [&](double ahead_Pa) {
          held.reference_pressure_Pa = need.valve_Pa + direction_ * ahead_Pa;
          return direction_ * valve_flow(plant_.moment(state, held)) - need.valve_flow;
        },
        0.0, most_Pa);
    const double behind_Pa = direction_ * (need.valve_Pa - need.muscle_Pa) + opened_Pa;
    return behind_Pa / (need.pressure_slope_Pa * slow_per_s);
  }

 private:
  struct Need {
    double muscle_Pa, valve_Pa;
    double valve_flow;         // kg/s through the valve, positive in the direction of the movement
    double pressure_slope_Pa;  // dP/de
  };

  static double valve_flow(const plant::Moment<double>& now) { return now.supply_flow - now.vent_flow; }

  State<double> state_at(double e, double pressure_Pa, double speed_per_s = 0.0) const {
    return {{e, direction_ * speed_per_s}, {pressure_Pa, pressure_Pa, 0.0}, {}};
  }

  // Force left over for moving up, with friction and guide against the movement. Ascends with pressure,
  // falls with e.
  double surplus_N(double e, double speed_per_s, double pressure_Pa) const {
    Held held;
    held.slip = plant::Slip::sticking;
    const auto now = plant_.moment(state_at(e, pressure_Pa, speed_per_s), held);
    return now.braid_force_N + now.effects_pull_N + now.spring_force_N - weight_N_ + now.guide_force_N -
           direction_ * now.friction_level_N;
  }

  double pressure_Pa(double e, double speed_per_s) const {
    return root([&](double pressure) { return surplus_N(e, speed_per_s, pressure); }, 0.0, 1e8);
  }

  // Gas balance of muscle and valve volume at a steady speed, the two pressures rising alike.
  Need need_at(double e, double speed_per_s) const {
    const double RT = rig_.gas.gas_constant_J_per_kg_K * rig_.gas.temperature_K;
    const double muscle_Pa = pressure_Pa(e, speed_per_s);
    const double slope_Pa =
        (pressure_Pa(e + slope_step, speed_per_s) - pressure_Pa(e - slope_step, speed_per_s)) /
        (2.0 * slope_step);
    const double absolute_Pa = muscle_Pa + rig_.gas.atmosphere_Pa;
    const double hose_flow =
        (slope_Pa * braid_.volume_m3(e) + absolute_Pa * braid_.volume_slope_m3(e)) * speed_per_s / RT;
    State<double> state = state_at(e, muscle_Pa);
    const auto hose = [&](double drop_Pa) {
      state.side.valve_pressure_Pa = muscle_Pa + direction_ * drop_Pa;
      return direction_ * plant_.moment(state, Held{}).hose_flow - hose_flow;
    };
    const double largest_drop_Pa = direction_ > 0.0 ? 1e7 : muscle_Pa;
    const double valve_Pa = muscle_Pa + direction_ * root(hose, 0.0, largest_drop_Pa);
    return {muscle_Pa, valve_Pa, hose_flow + slope_Pa * rig_.valve.volume_m3 * speed_per_s / RT, slope_Pa};
  }

  // Flow that the valve can give beyond what is needed, its reference at the end of its range.
  double spare_flow(double e, double speed_per_s) const {
    const Need need = need_at(e, speed_per_s);
    State<double> state = state_at(e, need.muscle_Pa);
    state.side.valve_pressure_Pa = need.valve_Pa;
    Held held;
    held.reference_pressure_Pa = direction_ > 0.0 ? rig_.valve.span_pressure_Pa : rig_.valve.zero_pressure_Pa;
    (direction_ > 0.0 ? held.fills : held.vents) = 1.0;
    return direction_ * valve_flow(plant_.moment(state, held)) - need.valve_flow;
  }

  const plant::Rig& rig_;
  plant::Plant plant_;
  plant::Braid braid_;
  double weight_N_, direction_;
};

controllers::ReachOfLoad reach_of(const plant::Rig& rig, double load_kg, const std::vector<double>& ratios) {
  // On a cord that stretches the muscle is shorter, always by as much.
  const plant::Cord& cord = rig.muscle.cord;
  plant::Rig taut = rig;
  taut.muscle.cord = {};
  const double shorter =
      cord.absent() ? 0.0
                    : load_kg * plant::gravity_m_per_s2 / cord.stiffness_N_per_m / rig.muscle.rest_length_m;
  const Moving up(taut, load_kg, 1.0), down(taut, load_kg, -1.0);
  controllers::ReachOfLoad reach;
  reach.load_kg = load_kg;
  reach.lowest_rising = up.rest_ratio(rig.valve.zero_pressure_Pa);
  reach.lowest_falling = down.rest_ratio(rig.valve.zero_pressure_Pa);
  reach.highest = up.rest_ratio(rig.valve.span_pressure_Pa);
  for (const double ratio : ratios) {
    const double e = std::min(ratio + shorter, ratios.back());
    reach.rising_per_s.push_back(e < reach.highest ? up.largest_speed_per_s(e) : 0.0);
    reach.falling_per_s.push_back(e > reach.lowest_falling ? down.largest_speed_per_s(e) : 0.0);
    const double within =
        std::min(e, reach.highest);  // beyond it no pressure of the valve's carries the load
    reach.rising_lag_s.push_back(up.lag_s(within));
    reach.falling_lag_s.push_back(down.lag_s(within));
  }
  for (double* at : {&reach.lowest_rising, &reach.lowest_falling, &reach.highest}) *at -= shorter;
  return reach;
}

/// What is known of a rig (the rubber tube is part of its muscle), the same to slow ramps, without a memory.
/// A regulator's dead band is an error that stays, no lag.
plant::Rig in_slow_ramps(const plant::Rig& true_rig) {
  plant::Rig rig = plant::nominal(true_rig);
  rig.effects.get<plant::BladderElasticity>() = true_rig.effects.get<plant::BladderElasticity>();
  plant::Valve& valve = rig.valve;
  valve.time_constant_s = valve.slow_lag_s();
  valve.lag = plant::RegulatorLag::first_order;
  valve.dead_band_Pa = 0.0;
  return rig;
}

}  // namespace

controllers::Reach reachable(const plant::Rig& true_rig) {
  const plant::Rig rig = in_slow_ramps(true_rig);
  const plant::Braid braid(rig.muscle);
  controllers::Reach reach;
  // Just short of e_max, where the braid pulls no more and every pressure is infinite.
  const double top = 0.95 * braid.largest_contraction_ratio();
  for (std::size_t i = 0; i < grid_rows; ++i)
    reach.ratio.push_back(top * static_cast<double>(i) / static_cast<double>(grid_rows - 1));
  const double heaviest_kg = std::max(
      braid.largest_force_N(rig.valve.span_pressure_Pa) / plant::gravity_m_per_s2, 2.0 * lightest_kg);
  for (std::size_t i = 0; i < grid_columns; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(grid_columns - 1);
    reach.loads.push_back(
        reach_of(rig, lightest_kg * std::pow(heaviest_kg / lightest_kg, share), reach.ratio));
  }
  return reach;
}

controllers::ReachOfLoad ends_of_way(const plant::Rig& rig, double load_kg) {
  return reach_of(rig, load_kg, {});
}

}  // namespace mckibben::run
