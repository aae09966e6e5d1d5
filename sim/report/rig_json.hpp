// What the pictures of a rig need to know of it (rig.js, pair.js).
#pragma once

#include <plant/mechanics.hpp>
#include <sim/input/json.hpp>

namespace mckibben::report {

/// `gauge`: whether one is drawn.
input::Json drawn_rig_json(const plant::Rig& rig, const plant::Mechanics& mechanics, bool gauge);

}  // namespace mckibben::report
