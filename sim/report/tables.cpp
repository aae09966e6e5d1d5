// See the header.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/length.hpp>
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

namespace {

double median(const std::vector<const RunError*>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half]->rmse : 0.5 * (sorted[half - 1]->rmse + sorted[half]->rmse);
}

}  // namespace

std::string link_html(std::size_t group, const std::string& text) {
  return fmt::format("<a href='#group-{0}' data-group='{0}'>{1}</a>", group, output::escaped(text));
}

std::string by_load_html(const std::vector<RunError>& runs, const plant::Rig& rig) {
  std::map<double, std::vector<const RunError*>> loads;
  for (const RunError& run : runs) loads[run.load_kg].push_back(&run);
  const std::string unit = length_unit_html();
  std::string html = fmt::format(
      "<table class='by-load'><caption>Root mean square error of height, by load</caption>\n<thead><tr><th "
      "scope='col'>load, kg</th><th scope='col'>runs</th><th scope='col'>median, {0}</th><th "
      "scope='col'>worst, {0}</th><th scope='col'>worst run</th></tr></thead>\n<tbody>\n",
      unit);
  for (auto& [load_kg, of_load] : loads) {
    std::stable_sort(of_load.begin(), of_load.end(),
                     [](const RunError* a, const RunError* b) { return a->rmse < b->rmse; });
    const RunError& worst = *of_load.back();
    html += fmt::format("<tr><th scope='row'>{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        domain::write_kg(load_kg), of_load.size(), length_html(median(of_load), rig),
                        length_html(worst.rmse, rig), link_html(worst.group, worst.id));
  }
  return html + "</tbody></table>\n";
}

}  // namespace mckibben::report
