// Pressures at the ends of the valves' lines, and where forces balance; see the header.
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <controllers/current_range.hpp>
#include <plant/geometry.hpp>
#include <plant/joint_stiffness.hpp>
#include <sim/data/joint_reach.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::data {
namespace {

/// Where something changes its sign between two ends at which it has different ones.
double crossing(double low, double high, const std::function<double(double)>& f) {
  const bool above = f(low) > 0.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == above ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Ends of what a valve gives.
JointReach::Ends pressures_Pa(const plant::Rig& rig) {
  const plant::Valve& valve = rig.valve;
  if (valve.seals()) return {valve.fill_pressure_Pa, valve.fill_pressure_Pa};
  if (valve.is_on_off()) return {0.0, valve.supply_pressure_Pa};
  const controllers::ValveLine line = domain::valve_line(valve);
  const auto range = controllers::working_range(line, rig.dac.largest_command);
  return {line.pressure_Pa(range.lowest_mA), line.pressure_Pa(range.highest_mA)};
}

plant::Rig with_taut_cords(plant::Rig rig) {
  rig.muscle.cord = {};
  if (plant::Pair* pair = rig.pair()) pair->opposite.muscle.cord = {};
  return rig;
}

}  // namespace

JointReach::JointReach(const plant::Rig& rig)
    : plant_(plant::plant_of(with_taut_cords(rig))),
      one_Pa_(pressures_Pa(rig)),
      two_Pa_(pressures_Pa(plant::opposite_rig(rig))) {
  constexpr double short_of = 0.999;  // where the braid pulls no more
  const plant::Pair& pair = *rig.pair();
  const auto end_rad = [&](const plant::Muscle& muscle, double mounted) {
    return short_of * (plant::Braid(muscle).largest_contraction_ratio() - mounted) * muscle.rest_length_m /
           rig.joint.wheel_radius_m;
  };
  ends_rad_ = {-end_rad(pair.opposite.muscle, pair.opposite_contraction_ratio),
               end_rad(rig.muscle, pair.contraction_ratio)};
}

plant::State<double> JointReach::state_at(const At& at) const {
  plant::State<double> state{};
  state.joint.contraction_ratio = plant_.ratio_at_rad(at.angle_rad);
  state.side.valve_pressure_Pa = state.side.muscle_pressure_Pa = at.one_Pa;
  state.opposite.valve_pressure_Pa = state.opposite.muscle_pressure_Pa = at.two_Pa;
  return state;
}

JointReach::Pull JointReach::pull(const At& at) const {
  plant::Held held;
  held.length_is_given = true;  // what holds it there takes all that is not friction
  const plant::Moment<double> now = plant_.moment(state_at(at), held);
  return {-now.bench_force_N, now.friction_level_N + now.opposite.friction_level_N};
}

JointReach::Ends JointReach::angle_rad() const {
  const auto end = [&](double way, double one_Pa, double two_Pa) {
    const auto spare_N = [&](double angle_rad) { return way * pull({angle_rad, one_Pa, two_Pa}).net_N; };
    const double far_rad = way > 0.0 ? ends_rad_.highest : ends_rad_.lowest,
                 back_rad = way > 0.0 ? ends_rad_.lowest : ends_rad_.highest;
    if (spare_N(far_rad) >= 0.0) return far_rad;
    if (spare_N(0.0) > 0.0) return crossing(0.0, far_rad, spare_N);
    return spare_N(back_rad) > 0.0 ? crossing(back_rad, 0.0, spare_N) : 0.0;
  };
  return {end(-1.0, one_Pa_.lowest, two_Pa_.highest), end(1.0, one_Pa_.highest, two_Pa_.lowest)};
}

// Both pressures at an end, but for the one of the muscle that would then pull the joint away.
std::optional<JointReach::Ends> JointReach::stiffness_N_m_per_rad(double angle_rad) const {
  const auto at_end = [&](double one_Pa, double two_Pa, bool stiffest) -> std::optional<double> {
    At at{angle_rad, one_Pa, two_Pa};
    const Pull both = pull(at);
    if (std::abs(both.net_N) > both.friction_N) {
      const double way = both.net_N > 0.0 ? 1.0 : -1.0;
      const bool first = (way > 0.0) == stiffest;  // too strong at the upper end, or the other too weak
      double& changed_Pa = first ? at.one_Pa : at.two_Pa;
      const Ends& ends = first ? one_Pa_ : two_Pa_;
      const auto too_much_N = [&](double pressure_Pa) {
        changed_Pa = pressure_Pa;
        const Pull has = pull(at);
        return way * has.net_N - has.friction_N;
      };
      if ((too_much_N(ends.lowest) > 0.0) == (too_much_N(ends.highest) > 0.0)) return std::nullopt;
      changed_Pa = crossing(ends.lowest, ends.highest, too_much_N);
    }
    return plant::joint_stiffness_N_m_per_rad(plant_, state_at(at), {}, {});
  };
  const auto least = at_end(one_Pa_.lowest, two_Pa_.lowest, false),
             most = at_end(one_Pa_.highest, two_Pa_.highest, true);
  if (!least || !most) return std::nullopt;
  return Ends{std::min(*least, *most), std::max(*least, *most)};
}

BeyondJoint beyond_joint(const domain::Scenario& scenario, const domain::JointTarget& target,
                         double load_kg) {
  constexpr std::size_t looks = 400;  // along the way
  plant::Rig rig = scenario.rig;
  *rig.pair() = plant::with_load_in_hand(*rig.pair(), load_kg, scenario.hand_m);
  const JointReach reach(rig);
  const JointReach::Ends ends = reach.angle_rad();
  const std::string loaded =
      load_kg > 0.0 ? fmt::format("with {} kg in the hand ", domain::write_kg(load_kg)) : "";
  BeyondJoint found;
  const auto [lowest, highest] = controllers::range(target.angle, scenario.duration_s, 1.0);
  if (lowest < ends.lowest || highest > ends.highest) {
    found.angle_rad = highest - ends.highest > ends.lowest - lowest ? highest : lowest;
    found.angle = fmt::format(
        "an angle of {:.4g} deg is out of reach: {}commands give {:.4g} to {:.4g} deg; an angle within, or a "
        "higher valve.span_pressure (and supply_pressure) would help",
        found.angle_rad / plant::degree_rad, loaded, ends.lowest / plant::degree_rad,
        ends.highest / plant::degree_rad);
  }
  if (!target.stiffness || !found.angle.empty()) return found;  // first of all it is to get there
  const double step_s = scenario.duration_s / static_cast<double>(looks);
  const auto angles = controllers::sample(target.angle, looks, step_s, 1.0),
             wanted = controllers::sample(*target.stiffness, looks, step_s, 1.0);
  double farthest = 0.0;
  for (std::size_t i = 0; i < looks; ++i) {
    if (i > 0 && angles[i] == angles[i - 1] && wanted[i] == wanted[i - 1]) continue;
    const auto can = reach.stiffness_N_m_per_rad(angles[i]);
    if (!can) continue;
    const double beyond = std::max(wanted[i] - can->highest, can->lowest - wanted[i]);
    if (beyond <= farthest) continue;
    farthest = beyond;
    found.stiffness_N_m_per_rad = wanted[i];
    found.stiffness = fmt::format(
        "a stiffness of {:.4g} N.m/rad is out of reach at {:.3g} deg: {}commands give {:.4g} to {:.4g} "
        "N.m/rad there; a stiffness within, or another valve.zero_pressure or span_pressure would help",
        wanted[i], angles[i] / plant::degree_rad, loaded, can->lowest, can->highest);
  }
  return found;
}

}  // namespace mckibben::data
