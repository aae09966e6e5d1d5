// One load under one controller: what is simulated, and how well the target was followed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/run/metrics.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {

RunPlan plan_of(const domain::Scenario& scenario, double load_kg, std::uint64_t stream);

/// Ends of a controller's current as the rig's DAC gives them; none if it has no limits.
std::optional<controllers::CurrentRange> limits_of(const controllers::Settings& settings,
                                                   const controllers::Knowledge& knowledge,
                                                   const plant::Rig& rig);

/// `target`: contraction ratio at each tick.
Metrics metrics_of(const domain::Scenario& scenario, const std::vector<double>& target,
                   const Recording& recording, const std::optional<controllers::CurrentRange>& limits);

}  // namespace mckibben::run
