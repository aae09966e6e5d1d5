// Whether a picture's words lie inside it, drawn in a font as wide as Debian's (DejaVu Sans).
#pragma once

#include <regex>
#include <string>

#include <gtest/gtest.h>

#include <sim/output/svg.hpp>

namespace mckibben::cli {

inline testing::AssertionResult words_fit(const std::string& svg) {
  std::smatch found;
  if (!std::regex_search(svg, found, std::regex("viewBox='0 0 ([0-9.]+) ([0-9.]+)'")))
    return testing::AssertionFailure() << "no picture";
  const double width_px = std::stod(found[1]), height_px = std::stod(found[2]);
  const std::regex text("<text x='([-0-9.]+)' y='([-0-9.]+)'([^>]*)>([^<]*)</text>");
  for (auto one = std::sregex_iterator(svg.begin(), svg.end(), text); one != std::sregex_iterator(); ++one) {
    const std::string style = (*one)[3], words = (*one)[4];
    if (style.find("rotate") != std::string::npos) continue;
    const bool bold = style.find("bold") != std::string::npos;
    const double wide_px =
        output::width_px(words, style.find("font-size='15'") != std::string::npos ? 15.0 : 12.0, bold);
    const bool middle = style.find("middle") != std::string::npos,
               end = style.find("end") != std::string::npos;
    const double from_px = std::stod((*one)[1]) - (middle ? 0.5 : end ? 1.0 : 0.0) * wide_px;
    if (from_px < 0.0 || from_px + wide_px > width_px || std::stod((*one)[2]) > height_px)
      return testing::AssertionFailure() << '"' << words << "\" is cut";
  }
  return testing::AssertionSuccess();
}

}  // namespace mckibben::cli
