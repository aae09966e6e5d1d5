// Ends of a current, and those that the rig itself sets: what a setting means that leaves a limit open.
#pragma once

#include <optional>

#include <controllers/controller.hpp>

namespace mckibben::controllers {

struct CurrentRange {
  double lowest_mA = 0.0, highest_mA = 0.0;
  std::optional<double> closed_mA = std::nullopt;  ///< at which the valve does nothing, if there is one

  double width_mA() const { return highest_mA - lowest_mA; }
};

/// Currents to which the valve answers and which a DAC up to `largest_mA` gives.
CurrentRange working_range(const ValveLine& valve, double largest_mA);
CurrentRange working_range(const Knowledge& knowledge);

}  // namespace mckibben::controllers
