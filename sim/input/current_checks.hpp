// Currents of controllers against the rig's valve: those that are left open follow it, those that are given
// must not contradict it.
#pragma once

#include <controllers/settings.hpp>
#include <plant/rig.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// Currents to which the rig's valve answers and which its DAC can give.
controllers::CurrentRange working_range(const plant::Rig& rig);

/// Fills in what `settings` leaves open; `node` is the controller's map. Limits with no current of the valve
/// between them are errors, limits and commands beyond the valve's or the DAC's warnings.
void follow_valve(controllers::Settings& settings, const Source& source, const Node& node,
                  const plant::Rig& rig, Problems& problems);

/// A DAC that cannot drive the valve is an error, one that does not reach its span a warning; shown at
/// `place`.
void check_dac(const plant::Rig& rig, const Source& source, Place place, Problems& problems);

}  // namespace mckibben::input
