// Placing, and a style that needs no page; see the header.
#include <cmath>

#include <fmt/format.h>

#include <sim/output/svg.hpp>
#include <sim/report/files.hpp>
#include <sim/report/sheet.hpp>

namespace mckibben::report {
namespace {

/// The style of pictures with its colours written out: drawing programs know no variables.
std::string style() {
  std::string css(picture_css);
  const std::size_t root = css.find(":root {"), end = css.find("}\n", root) + 2;
  const std::string set = css.substr(root, end - root);
  css.erase(0, end);
  const std::string_view begin = "var(";
  for (std::size_t at = css.find(begin); at != std::string::npos; at = css.find(begin, at)) {
    const std::size_t close = css.find(')', at);
    const std::string name = css.substr(at + begin.size(), close - at - begin.size()) + ": ";
    const std::size_t value = set.find(name) + name.size();
    css.replace(at, close + 1 - at, set.substr(value, set.find(';', value) - value));
  }
  return "<style>\n" + css + "</style>\n";
}

}  // namespace

std::string sheet_svg(const std::vector<Picture>& pictures, double wide_px, double high_px,
                      const std::vector<std::pair<std::string, std::string>>& keys, std::string_view words) {
  constexpr double edge_px = 14.0, line_px = 18.0;
  if (pictures.empty()) return "";
  const double width = 3.0 * edge_px + 2.0 * wide_px;
  std::string svg;
  double y_px = edge_px + 10.0, x_px = edge_px;
  for (const std::string& line : output::wrapped(words, width - 2.0 * edge_px, 13.0)) {
    svg += output::lines_svg({line}, edge_px, y_px, line_px);
    y_px += line_px;
  }
  for (const auto& [kind, name] : keys) {
    svg += fmt::format("<path class='{}' d='M{:g} {:g}h34'/><text x='{:g}' y='{:g}'>{}</text>\n", kind, x_px,
                       y_px - 4.0, x_px + 40.0, y_px, output::escaped(name));
    x_px += 60.0 + output::width_px(name, 13.0);
  }
  y_px += edge_px;
  const bool headed = !pictures.front().caption.empty();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const double left = edge_px + static_cast<double>(i % 2) * (wide_px + edge_px);
    if (headed)
      svg += output::lines_svg({pictures[i].caption}, left, y_px + 14.0, line_px, " class='strong'");
    const double top = y_px + (headed ? 24.0 : 0.0);
    if (!pictures[i].svg.empty())
      svg += fmt::format("<svg x='{:g}' y='{:g}' width='{:g}' height='{:g}'", left, top, wide_px, high_px) +
             pictures[i].svg.substr(std::string_view("<svg").size());
    if (i % 2 == 1 || i + 1 == pictures.size()) y_px = top + high_px + edge_px;
  }
  return output::svg_begin(width, y_px, 13, style()) + "<g class='opening'>\n" + svg + "</g>\n</svg>\n";
}

std::vector<std::pair<std::string, std::string>> keys_of(const Group& group, bool measured) {
  std::vector<std::pair<std::string, std::string>> keys;
  if (measured) keys.emplace_back("given", "measured");
  for (const Run& one : group.runs)
    keys.emplace_back(fmt::format("run c{} d{}", one.style % 7, one.style % 4), one.name);
  return keys;
}

}  // namespace mckibben::report
