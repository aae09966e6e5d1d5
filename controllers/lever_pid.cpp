// The same loop in contraction ratios, as the wheel measures the angle; see the header.
#include <controllers/lever_pid.hpp>

namespace mckibben::controllers {

void LeverPidSettings::follow(const CurrentRange& range) {
  OutputLimits::follow(range);
  RestTerms::follow(*this, range);
}

std::unique_ptr<Controller> LeverPidSettings::make(const Knowledge& knowledge) const {
  const double per_rad = ratio_per_rad(knowledge);
  PidSettings pid;
  static_cast<PidForm&>(pid) = *this;
  static_cast<OutputLimits&>(pid) = *this;
  static_cast<RestTerms&>(pid) = *this;
  if (proportional_mA) pid.proportional_mA = *proportional_mA / per_rad;
  if (dead_zone_rad) pid.dead_zone = *dead_zone_rad * per_rad;
  pid.largest_current_speed_mA_per_s = largest_current_speed_mA_per_s;
  pid.fastest_load_per_s = fastest_load_per_s(knowledge);
  return pid.make(within_angles(knowledge));
}

}  // namespace mckibben::controllers
