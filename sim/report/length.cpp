// Both units, side by side.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>

#include <fmt/format.h>

#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/length.hpp>

namespace mckibben::report {

namespace {

using output::escaped;

constexpr const char* number_like = "[-+]?[0-9][0-9.]*(?:e[-+]?[0-9]+)?";

/// Its groups: 1 in mm, 2 whether in mm/s; ratios 3 after these words, 5 after those in 4; 6 in 1/s.
const std::regex& any_length() {
  static const std::regex pattern(
      fmt::format("((?:{0} to )?{0}) mm\\b(/s)?|"
                  "contraction ratio(s? of {0}(?: to {0})?)|"
                  "(reachable one[^.;]*? is )({0})|"
                  "({0}) /s",
                  number_like));
  return pattern;
}

/// The number that a text begins with; whatever the locale, its decimals stand behind a point.
double number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Every number of the text times `factor`.
std::string scaled(const std::string& text, double factor) {
  static const std::regex any_number(number_like);
  std::string result;
  auto from = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), any_number), end; at != end; ++at) {
    result.append(from, (*at)[0].first);
    result += fmt::format("{:.3g}", factor * number_in(at->str()));
    from = (*at)[0].second;
  }
  return result.append(from, text.end());
}

std::string length_found(const std::smatch& found, double mm, std::string_view tag) {
  const std::string all = found.str();
  if (found[1].matched)
    return either(all, scaled(found.str(1), 1.0 / mm) + (found[2].matched ? " /s" : ""), tag);
  if (found[3].matched) return either("contraction" + scaled(found.str(3), mm) + " mm", all, tag);
  if (found[5].matched)
    return escaped(found.str(4)) + either(scaled(found.str(5), mm) + " mm", found.str(5), tag);
  return either(scaled(found.str(6), mm) + " mm/s", all, tag);
}

}  // namespace

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

std::string amount_html(double value, diagnose::Judged judged, const plant::Rig& rig, std::string_view tag,
                        bool sign) {
  if (judged == diagnose::Judged::contraction) return height_html(value, rig, tag, sign);
  return (sign && value > 0.0 ? "+" : "") + output::amount(value, judged, rig);
}

std::string text_html(const std::string& text, const plant::Rig& rig, std::string_view tag) {
  std::string html;
  auto from = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), any_length()), end; at != end; ++at) {
    html += escaped({from, (*at)[0].first}) + length_found(*at, length_mm(rig), tag);
    from = (*at)[0].second;
  }
  return html + escaped({from, text.end()});
}

std::string ratios_html(const std::string& text, const plant::Rig& rig, std::string_view tag) {
  return either(escaped(scaled(text, length_mm(rig)) + " mm"), escaped(text), tag);
}

std::string length_unit_html() {
  return either("mm", "ratio");
}

const std::string_view unit_switch =
    "<fieldset class='unit-choice'><legend>Lengths in</legend>\n"
    "<label><input type='radio' name='unit' id='in-mm' checked> mm</label>\n"
    "<label><input type='radio' name='unit' id='in-ratio'> contraction ratio</label></fieldset>\n";

}  // namespace mckibben::report
