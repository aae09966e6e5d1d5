// See the header.
#include <algorithm>
#include <cmath>
#include <span>

#include <plant/instruments.hpp>
#include <sim/data/series.hpp>
#include <sim/run/track.hpp>

namespace mckibben::run {
namespace {

std::size_t ticks_of(const domain::Scenario& scenario) {
  return static_cast<std::size_t>(std::llround(scenario.duration_s / scenario.rig.tick_s));
}

/// From which tick errors count: the first that is not skipped, or that in which some value begins to move.
std::size_t first_tick(const domain::Scenario& scenario, const Wanted& wanted) {
  const std::size_t ticks = wanted.ratios.size();
  if (scenario.skip_s)
    return std::min(static_cast<std::size_t>(std::ceil(*scenario.skip_s / scenario.rig.tick_s - 1e-9)),
                    ticks - 1);
  std::size_t first = ticks;
  for (const auto* values : {&wanted.ratios, &wanted.stiffness_N_m_per_rad}) {
    const auto moves = std::ranges::adjacent_find(*values, std::not_equal_to<>());
    if (moves != values->end()) first = std::min(first, static_cast<std::size_t>(moves - values->begin()));
  }
  return first < ticks ? first : 0;  // a target that never moves counts whole
}

/// Whether a current is at an end of what the valve answers to, as the DAC gives it.
bool is_at_end(double current_mA, const plant::Rig& rig) {
  return current_mA <= plant::dac_output_mA(rig.dac, rig.valve.zero_command) ||
         current_mA >= plant::dac_output_mA(rig.dac, rig.valve.span_command);
}

}  // namespace

double per_ratio(const plant::Rig& rig) {
  return rig.has_angle() ? rig.muscle.rest_length_m / rig.joint.wheel_radius_m : 1.0;
}

std::vector<Wanted> wanted_of(const domain::Scenario& scenario) {
  const plant::Rig& rig = scenario.rig;
  const std::size_t ticks = ticks_of(scenario);
  if (rig.lever() != nullptr) {
    const double rad = per_ratio(rig);
    Wanted wanted{"",
                  controllers::sample(scenario.angle, ticks, rig.tick_s, rad),
                  {},
                  {},
                  controllers::last_change_s(scenario.angle)};
    for (const double ratio : wanted.ratios) wanted.values.push_back(ratio * rad);
    wanted.first = first_tick(scenario, wanted);
    return {std::move(wanted)};
  }
  if (rig.pair() == nullptr) {
    const auto ratios = controllers::sample(scenario.target, ticks, rig.tick_s, rig.muscle.rest_length_m);
    Wanted wanted{"", ratios, ratios, {}, controllers::last_change_s(scenario.target)};
    wanted.first = first_tick(scenario, wanted);
    return {std::move(wanted)};
  }
  std::vector<Wanted> all;
  for (const domain::JointTarget& target : scenario.targets) {
    Wanted wanted{target.name,
                  controllers::sample(target.angle, ticks, rig.tick_s, per_ratio(rig)),
                  {},
                  {},
                  controllers::last_change_s(target.angle)};
    for (const double ratio : wanted.ratios) wanted.values.push_back(ratio * per_ratio(rig));
    if (target.stiffness)
      wanted.stiffness_N_m_per_rad = controllers::sample(*target.stiffness, ticks, rig.tick_s, 1.0);
    wanted.first = first_tick(scenario, wanted);
    all.push_back(std::move(wanted));
  }
  return all;
}

controllers::Knowledge knowledge_of(const domain::Scenario& scenario, const Wanted& wanted) {
  controllers::Knowledge known = knowledge_of(scenario.rig, wanted.ratios);
  if (known.pair) known.pair->stiffness_N_m_per_rad = wanted.stiffness_N_m_per_rad;
  return known;
}

RunPlan plan_of(const domain::Scenario& scenario, double load_kg, std::uint64_t stream) {
  RunPlan plan{.rig = scenario.rig,
               .load_kg = load_kg,
               .ticks = ticks_of(scenario),
               .noise = scenario.noise,
               .seed = scenario.seed,
               .stream = stream,
               .keep_ledger = true,
               .outer_forces = scenario.outer_forces};
  for (const domain::OuterTorque& torque : scenario.outer_torques)
    plan.outer_forces.push_back(
        {torque.at_s, domain::as_force_N(torque.torque_N_m, scenario.rig.joint.wheel_radius_m)});
  if (plant::Pair* pair = plan.rig.pair()) *pair = plant::with_load_in_hand(*pair, load_kg, scenario.hand_m);
  return plan;
}

std::optional<controllers::CurrentRange> limits_of(const controllers::Settings& settings,
                                                   const controllers::Knowledge& knowledge,
                                                   const plant::Rig& rig) {
  auto limits = controllers::limits_of(settings, knowledge);
  if (limits)
    limits = {plant::dac_output_mA(rig.dac, limits->lowest_mA),
              plant::dac_output_mA(rig.dac, limits->highest_mA)};
  return limits;
}

Metrics metrics_of(const domain::Scenario& scenario, const Wanted& wanted, const Recording& recording,
                   const std::optional<controllers::CurrentRange>& limits) {
  const bool angle = scenario.rig.has_angle();
  std::vector<double> followed, current_mA;
  for (const auto& sample : recording.samples) {
    followed.push_back(angle ? sample.angle_rad : sample.state.joint.contraction_ratio);
    current_mA.push_back(sample.current_mA);
  }
  const double from_s = static_cast<double>(wanted.first) * scenario.rig.tick_s;
  std::optional<double> last_change_s = wanted.last_change_s;
  if (last_change_s) *last_change_s -= from_s;
  return measure({.target = std::span(wanted.values).subspan(wanted.first),
                  .contraction = std::span(followed).subspan(wanted.first),
                  .current_mA = std::span(current_mA).subspan(wanted.first),
                  .tick_s = scenario.rig.tick_s,
                  .last_change_s = last_change_s,
                  .air_kg = recording.ledger.air_drawn_kg,
                  .limits = limits});
}

JointFigures joint_figures(const plant::Rig& rig, const Recording& recording, const Wanted* wanted) {
  const auto& rows = recording.samples;
  JointFigures found{
      .angle_rad = span_of(rows, [](const Sample& row) { return row.angle_rad; }),
      .cord_force_N = span_of(rows, [](const Sample& row) { return row.cord_force_N; }),
      .opposite_cord_force_N = span_of(rows, [](const Sample& row) { return row.opposite.cord_force_N; })};
  const plant::Rig opposite = plant::opposite_rig(rig);
  const std::span counted = std::span(rows).subspan(std::min(wanted ? wanted->first : 0, rows.size() - 1));
  std::vector<double> stiffness;
  std::size_t at_end = 0;
  for (const Sample& row : counted) {
    stiffness.push_back(row.stiffness_N_m_per_rad);
    if (is_at_end(row.current_mA, rig) || is_at_end(row.opposite.current_mA, opposite)) ++at_end;
  }
  found.at_limit = static_cast<double>(at_end) / static_cast<double>(counted.size());
  found.stiffness_had = data::mean(stiffness);
  if (wanted == nullptr || wanted->stiffness_N_m_per_rad.empty()) return found;
  const auto& asked = wanted->stiffness_N_m_per_rad;
  const std::size_t first = rows.size() - counted.size();
  found.stiffness_asked = data::mean({asked.begin() + static_cast<std::ptrdiff_t>(first), asked.end()});
  double squares = 0.0;
  for (std::size_t k = 0; k < stiffness.size(); ++k) squares += std::pow(stiffness[k] - asked[first + k], 2);
  found.stiffness_rmse = std::sqrt(squares / static_cast<double>(stiffness.size()));
  return found;
}

}  // namespace mckibben::run
