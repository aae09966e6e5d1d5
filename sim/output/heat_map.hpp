// One load's error maps as a picture: up and down beside each other, errors of contraction ratio above those
// of speed, with the border of what the rig can reach.
#pragma once

#include <string>

#include <sim/run/error_map.hpp>

namespace mckibben::output {

/// What its numbers are: contraction ratios and 1/s, or height of the load in mm and mm/s.
enum class MapUnit { ratio, mm };

/// `load` is one of the plan's that has a map.
std::string heat_map_svg(const run::MapPlan& plan, const run::ErrorMaps& maps, const run::LoadMap& load,
                         MapUnit unit = MapUnit::ratio);

}  // namespace mckibben::output
