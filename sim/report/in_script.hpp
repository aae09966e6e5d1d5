// What pages hand to their scripts: JSON that can stand in them, and the rig for its pictures (rig.js,
// pair.js, lever.js).
#pragma once

#include <string>

#include <plant/rig.hpp>
#include <sim/input/json.hpp>

namespace mckibben::report {

/// As JSON that can stand inside <script>: no "</script>", no "<!--".
std::string in_script(const input::Json& data);

/// `gauge`: whether one is drawn.
input::Json drawn_rig_json(const plant::Rig& rig, bool gauge);

}  // namespace mckibben::report
