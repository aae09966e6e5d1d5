// Plan and metrics; see the header.
#include <cmath>

#include <plant/instruments.hpp>
#include <sim/run/track.hpp>

namespace mckibben::run {

RunPlan plan_of(const domain::Scenario& scenario, double load_kg, std::uint64_t stream) {
  return {.rig = scenario.rig,
          .load_kg = load_kg,
          .ticks = static_cast<std::size_t>(std::llround(scenario.duration_s / scenario.rig.tick_s)),
          .engine = scenario.rig.integrator,
          .noise = scenario.noise,
          .seed = scenario.seed,
          .stream = stream,
          .keep_ledger = true};
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

Metrics metrics_of(const domain::Scenario& scenario, const std::vector<double>& target,
                   const Recording& recording, const std::optional<controllers::CurrentRange>& limits) {
  std::vector<double> contraction, current_mA;
  for (const auto& sample : recording.samples) {
    contraction.push_back(sample.state.joint.contraction_ratio);
    current_mA.push_back(sample.current_mA);
  }
  return measure({.target = target,
                  .contraction = contraction,
                  .current_mA = current_mA,
                  .tick_s = scenario.rig.tick_s,
                  .last_change_s = controllers::last_change_s(scenario.target),
                  .air_kg = recording.ledger.air_drawn_kg,
                  .limits = limits});
}

}  // namespace mckibben::run
