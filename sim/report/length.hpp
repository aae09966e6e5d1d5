// Lengths on a page: what the load rises, in mm, and the contraction ratio that it is of the muscle's length.
// Both are written, the page's style shows one of them: mm unless the reader chooses the other.
#pragma once

#include <string>
#include <string_view>

#include <plant/rig.hpp>
#include <sim/diagnose/diagnosis.hpp>

namespace mckibben::report {

/// The unit of plots and axes that show mm or ratios, as the reader wants; their values are ratios.
inline constexpr std::string_view ratio_unit = "contraction ratio";

/// Height of the load for a contraction ratio of 1.
inline double length_mm(const plant::Rig& rig) {
  return 1e3 * rig.muscle.rest_length_m;
}

/// HTML, or SVG with `tag` "g" or "tspan": of the two the one that the reader wants.
std::string either(std::string_view mm, std::string_view ratio, std::string_view tag = "span");

/// A number in the unit that the reader wants. `mm_decimals`: of the mm; a ratio has two more.
std::string length_html(double ratio, const plant::Rig& rig, int mm_decimals = 3, bool sign = false);

/// The same with its unit: "1.180 mm" or "0.00393 (contraction ratio)".
std::string full_length_html(double ratio, const plant::Rig& rig, int mm_decimals = 3);

/// An error to three digits, never finer than a micrometre, with its unit:
/// "1.96 mm" or "0.00653". `tag` may be "tspan".
std::string height_html(double ratio, const plant::Rig& rig, std::string_view tag = "span",
                        bool sign = false);

/// The same of the reading that was judged: a height, or a force "13.3 N".
std::string amount_html(double value, diagnose::Judged judged, const plant::Rig& rig,
                        std::string_view tag = "span", bool sign = false);

/// Plain text as HTML in which heights and speeds of the load are in the unit that the reader wants. What
/// counts as one: "1.2 mm", "5 to 25 mm/s"; "a contraction ratio of 0.1", "reachable one is 0.1", "0.02 in
/// contraction ratio", "0.3 /s". The other unit has three digits. `tag` as above.
std::string text_html(const std::string& text, const plant::Rig& rig, std::string_view tag = "span");

/// The same of text in which every number is a contraction ratio: "0.05 to 0.1".
std::string ratios_html(const std::string& text, const plant::Rig& rig, std::string_view tag = "span");

/// The unit alone: "mm" or "ratio".
std::string length_unit_html();

/// Where the reader chooses.
extern const std::string_view unit_switch;

}  // namespace mckibben::report
