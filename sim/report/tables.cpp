// See the header.
#include <fmt/format.h>

#include <sim/output/svg.hpp>
#include <sim/report/tables.hpp>

namespace mckibben::report {

using output::escaped;

std::string row(const std::string& head, std::initializer_list<std::string> cells) {
  std::string html = "<tr><th scope='row'>";
  for (const char c : escaped(head)) html += c == '_' ? "_<wbr>" : std::string(1, c);
  html += "</th>";
  for (const auto& cell : cells) html += "<td>" + escaped(cell) + "</td>";
  return html + "</tr>\n";
}

std::string folded(const std::string& summary, const std::string& html) {
  return "<details><summary>" + escaped(summary) + "</summary>\n" + html + "</details>\n";
}

std::string table(const std::string& caption, std::initializer_list<const char*> head,
                  const std::string& rows) {
  std::string html = "<table><caption>" + escaped(caption) + "</caption>\n<thead><tr>";
  for (const char* name : head) html += fmt::format("<th scope='col'>{}</th>", name);
  return html + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string paragraph(const std::string& text) {
  return "<p>" + escaped(text) + "</p>\n";
}

}  // namespace mckibben::report
