// Words that fit; see the header.
#include <algorithm>

#include <sim/output/svg.hpp>

namespace mckibben::output {

double width_px(std::string_view text, double font_px, bool bold) {
  const auto letters = std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });  // of UTF-8
  return static_cast<double>(letters) * font_px * (bold ? 0.68 : 0.6);
}

std::vector<std::string> wrapped(std::string_view text, double widest_px, double font_px, bool bold) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!lines.empty() && width_px(lines.back() + ' ' + word, font_px, bold) <= widest_px)
      lines.back() += ' ' + word;
    else
      lines.push_back(word);
  }
  return lines;
}

std::string lines_svg(const std::vector<std::string>& lines, double x_px, double y_px, double step_px,
                      std::string_view attributes) {
  std::string svg;
  for (const std::string& line : lines) {
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}'{}>{}</text>\n", x_px, y_px, attributes, escaped(line));
    y_px += step_px;
  }
  return svg;
}

}  // namespace mckibben::output
