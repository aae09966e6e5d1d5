// The comparison as one SVG picture: for each load a panel with the target and every controller's
// contraction.
#pragma once

#include <string>

#include <sim/domain/scenario.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::output {

std::string tracking_svg(const domain::Scenario& scenario, const run::Comparison& comparison);

}  // namespace mckibben::output
