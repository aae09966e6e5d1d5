// What all pictures share, and pages. Colours: Okabe & Ito's palette, told apart by the colour-blind.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

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

/// About how wide a text is drawn [px]: as the widest usual fonts draw it, which no picture knows.
double width_px(std::string_view text, double font_px, bool bold = false);

/// The text in lines that are no wider, broken at spaces; a word that is wider stands alone.
std::vector<std::string> wrapped(std::string_view text, double widest_px, double font_px, bool bold = false);

/// Such lines one below the other; `y_px`: of the first.
std::string lines_svg(const std::vector<std::string>& lines, double x_px, double y_px, double step_px,
                      std::string_view attributes = "");

/// Places names side by side, and in a further row where one is full.
class Rows {
 public:
  Rows(double left_px, double right_px, double first_px)
      : left_px_(left_px), right_px_(right_px), x_px_(left_px), y_px_(first_px) {}

  struct Place {
    double x_px, y_px;
  };
  Place next(double needed_px) {
    if (x_px_ > left_px_ && x_px_ + needed_px > right_px_) {
      x_px_ = left_px_;
      y_px_ += 18.0;
    }
    const Place place{x_px_, y_px_};
    x_px_ += needed_px;
    return place;
  }
  double bottom_px() const { return y_px_; }

 private:
  double left_px_, right_px_, x_px_, y_px_;
};

}  // namespace mckibben::output
