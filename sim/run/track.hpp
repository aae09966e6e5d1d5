// One run of a scenario: what is wanted, what is simulated, and how well the target was followed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/run/metrics.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {

/// A target of a scenario, tick by tick.
struct Wanted {
  std::string name;                           ///< empty for one muscle, which has one target
  std::vector<double> ratios;                 ///< of muscle 1; of a pair from angle 0 on
  std::vector<double> values;                 ///< the same as it is shown: ratios, or joint angles [rad]
  std::vector<double> stiffness_N_m_per_rad;  ///< of a pair; empty if none is asked for
  std::optional<double> last_change_s;
  std::size_t first = 0;  ///< tick from which errors count
};
std::vector<Wanted> wanted_of(const domain::Scenario& scenario);

/// What controllers are told of a target.
controllers::Knowledge knowledge_of(const domain::Scenario& scenario, const Wanted& wanted);

/// Of what is followed and shown, for a whole contraction ratio that the wheel shows: 1, or of a pair or a
/// lever the joint angle [rad].
double per_ratio(const plant::Rig& rig);

RunPlan plan_of(const domain::Scenario& scenario, double load_kg, std::uint64_t stream);

/// Ends of a controller's current as the rig's DAC gives them; none if it has no limits.
std::optional<controllers::CurrentRange> limits_of(const controllers::Settings& settings,
                                                   const controllers::Knowledge& knowledge,
                                                   const plant::Rig& rig);

/// In the unit of what is wanted, from its `first` tick on.
Metrics metrics_of(const domain::Scenario& scenario, const Wanted& wanted, const Recording& recording,
                   const std::optional<controllers::CurrentRange>& limits);

/// What else two muscles and their joint did.
struct JointFigures {
  Span angle_rad{}, cord_force_N{}, opposite_cord_force_N{};
  /// Means over the ticks that count, and the root mean square of what the stiffness missed.
  std::optional<double> stiffness_asked{}, stiffness_rmse{};
  double stiffness_had = 0.0;
  /// Share of the ticks at which some current is at an end of what its valve answers to.
  double at_limit = 0.0;
};
/// Of one row or more; `wanted`: null under given currents.
JointFigures joint_figures(const plant::Rig& rig, const Recording& recording, const Wanted* wanted);

}  // namespace mckibben::run
