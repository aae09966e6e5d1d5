// What a scenario may ask of a lever.
#pragma once

#include <sim/domain/scenario.hpp>
#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

/// A target goes as far as the muscle and the joint's stops let it.
void check_lever_target(const domain::Scenario& scenario, const Source& source, Place target,
                        Problems& problems);

}  // namespace mckibben::input
