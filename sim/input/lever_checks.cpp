// See the header.
#include <fmt/format.h>

#include <plant/plant.hpp>
#include <sim/input/lever_checks.hpp>

namespace mckibben::input {

void check_lever_target(const domain::Scenario& scenario, const Source& source, Place target,
                        Problems& problems) {
  const auto [lowest, highest] = controllers::range(scenario.angle, scenario.duration_s, 1.0);
  const plant::Rig& rig = scenario.rig;
  const double most = plant::plant_of(rig).ratio_at_rad(highest),
               largest = plant::Braid(rig.muscle).largest_contraction_ratio();
  if (!(most <= largest))
    problems.error(source, target,
                   fmt::format("the target takes the muscle to a contraction ratio of {:.4g}; its limit is "
                               "{:.4g} (T 2.10)",
                               most, largest));
  else if (lowest < rig.joint.lowest_rad || highest > rig.joint.highest_rad)
    problems.error(source, target,
                   fmt::format("the target goes from {:.4g} to {:.4g} deg, beyond the rig's "
                               "joint.lowest_angle or highest_angle",
                               lowest / plant::degree_rad, highest / plant::degree_rad));
}

}  // namespace mckibben::input
