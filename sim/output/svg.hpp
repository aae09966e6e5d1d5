// What all pictures share, and pages. Colours: Okabe & Ito's palette, told apart by the colour-blind.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace mckibben::output {

inline constexpr std::array<const char*, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                    "#E69F00", "#56B4E9", "#F0E442"};

/// `text` as it may stand in a picture or a page, between tags or in an attribute.
inline std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

/// The first lines of a picture: its size in pixels, what overrules its inks, a white ground.
inline std::string svg_begin(double width, double height, int font_px = 12, std::string_view style = "") {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "font-family='sans-serif' font-size='{2}'>\n{3}"
      "<rect class='ground' width='100%' height='100%' fill='white'/>\n",
      width, height, font_px, style);
}

}  // namespace mckibben::output
