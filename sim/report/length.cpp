// Both units, side by side.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/output/diagnosis_words.hpp>
#include <sim/report/length.hpp>

namespace mckibben::report {

std::string either(std::string_view mm, std::string_view ratio, std::string_view tag) {
  return fmt::format("<{0} class='mm'>{1}</{0}><{0} class='ratio'>{2}</{0}>", tag, mm, ratio);
}

std::string length_html(double ratio, const plant::Rig& rig, int mm_decimals, bool sign) {
  const double mm = ratio * length_mm(rig);
  return sign ? either(fmt::format("{:+.{}f}", mm, mm_decimals),
                       fmt::format("{:+.{}f}", ratio, mm_decimals + 2))
              : either(fmt::format("{:.{}f}", mm, mm_decimals),
                       fmt::format("{:.{}f}", ratio, mm_decimals + 2));
}

std::string full_length_html(double ratio, const plant::Rig& rig, int mm_decimals) {
  return either(fmt::format("{:.{}f} mm", ratio * length_mm(rig), mm_decimals),
                fmt::format("{:.{}f} ({})", ratio, mm_decimals + 2, ratio_unit));
}

std::string height_html(double ratio, const plant::Rig& rig, std::string_view tag, bool sign) {
  const std::string mm = output::height(ratio, rig),
                    plus = sign && mm[0] != '-' && mm != "0.000 mm" ? "+" : "";
  const double size = std::abs(ratio);
  const int decimals = size > 0.0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6) : 6;
  return either(plus + mm, plus + output::rounded(ratio, decimals), tag);
}

std::string length_unit_html() {
  return either("mm", "ratio");
}

const std::string_view unit_switch =
    "<fieldset class='unit-choice'><legend>Lengths in</legend>\n"
    "<label><input type='radio' name='unit' id='in-mm' checked> mm</label>\n"
    "<label><input type='radio' name='unit' id='in-ratio'> contraction ratio</label></fieldset>\n";

}  // namespace mckibben::report
