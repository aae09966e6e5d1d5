// Amounts of what was read, in the units in which they are told.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <sim/domain/dataset.hpp>

namespace mckibben::data {

using domain::Judged;

/// An amount of the judged reading: "1.2 mm" of the load's height, "3.4 N", "0.25 deg".
std::string amount_of(Judged judged, double value, const plant::Rig& rig, int digits = 2);
/// What such numbers are in: "in contraction ratio", "N", "rad".
std::string_view unit_in_words(Judged judged);

/// A reading beside the one that is judged, and its SI unit.
std::pair<std::string, std::string_view> told(domain::Beside which, bool pair);

}  // namespace mckibben::data
