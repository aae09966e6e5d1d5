// Heads of CSV files; see the header.
#include <algorithm>
#include <array>
#include <optional>

#include <sim/input/csv_layout.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t longest_head = 100, most_unit_lines = 5;  // lines
constexpr std::string_view between_cells = ",;\t";

/// What stands most often between the cells of a line; a comma if nothing does.
char separator_of(std::string_view line) {
  return *std::max_element(between_cells.begin(), between_cells.end(), [&](char a, char b) {
    return split_cells(line, a).size() < split_cells(line, b).size();
  });
}

/// What a first line such as sep=; says, also in quotes and with separators behind it.
std::optional<char> said_separator(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('"')) line.remove_prefix(1);
  constexpr std::string_view word = "sep=";
  const bool says =
      line.size() > word.size() && std::equal(word.begin(), word.end(), line.begin(), [](char a, char b) {
        return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b);
      });
  if (!says || between_cells.find(line[word.size()]) == std::string_view::npos) return std::nullopt;
  return line[word.size()];
}

bool is_number(const Cell& cell) {
  std::string text(cell.text);
  std::replace(text.begin(), text.end(), ',', '.');
  return parse_number(text).has_value();
}

/// Whether a line holds numbers: a word beside them is a remark, but most cells are numbers or empty.
bool is_row(const std::vector<Cell>& cells) {
  const auto numbers = std::count_if(cells.begin(), cells.end(), is_number);
  const auto empty = std::count_if(cells.begin(), cells.end(), is_missing);
  return numbers > 0 && 2 * (numbers + empty) >= static_cast<std::ptrdiff_t>(cells.size());
}

/// The same of a line between whose cells may stand anything: decimal commas look like separators.
bool is_row(std::string_view line) {
  return std::any_of(between_cells.begin(), between_cells.end(),
                     [&](char separator) { return is_row(split_cells(line, separator)); });
}

void drop_empty_ends(std::vector<Cell>& cells, std::size_t least) {
  while (cells.size() > least && cells.back().text.empty()) cells.pop_back();
}

/// A line that may be the heading.
struct Candidate {
  std::size_t line = 0, cells = 0;  ///< no cells: it is a row of numbers
  char separator = ',';
  std::ptrdiff_t missing = 0;  ///< names that are needed, and not there
};

Candidate candidate_in(const Source& source, std::size_t line, std::optional<char> said,
                       std::span<const WantedColumn> wanted) {
  const char separator = said.value_or(separator_of(source.line(line)));
  std::vector<Cell> cells = split_cells(source.line(line), separator);
  drop_empty_ends(cells, 1);
  const auto missing = std::count_if(wanted.begin(), wanted.end(), [&](const WantedColumn& column) {
    return column.needed && std::none_of(cells.begin(), cells.end(),
                                         [&](const Cell& cell) { return cell.text == column.in_file; });
  });
  return {line, is_row(source.line(line)) ? 0 : cells.size(), separator, missing};
}

Candidate heading_of(const Source& source, std::span<const WantedColumn> wanted) {
  const std::optional<char> said = said_separator(source.line(1));
  const std::size_t first = said ? 2 : 1;
  std::vector<Candidate> seen;
  std::string_view row;
  for (std::size_t line = first; line <= std::min(source.lines(), longest_head) && row.empty(); ++line) {
    seen.push_back(candidate_in(source, line, said, wanted));
    if (!wanted.empty() && seen.back().missing == 0) return seen.back();
    if (seen.back().cells == 0) row = source.line(line);
  }
  if (seen.empty()) return {first, 0, said.value_or(','), 0};
  const auto as_many = [&](const Candidate& one) {
    return one.cells > 0 && split_cells(row, one.separator).size() == one.cells;
  };
  const auto best = std::min_element(seen.begin(), seen.end(), [&](const Candidate& a, const Candidate& b) {
    return a.missing != b.missing ? a.missing < b.missing : as_many(a) && !as_many(b);
  });
  return *best;
}

/// How many lines below the heading are units, with what may stand between.
std::size_t lines_of_units(const Source& source, const CsvLayout& layout,
                           std::span<const WantedColumn> wanted) {
  const auto counts = [&](std::size_t index) {
    return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const WantedColumn& column) {
             return column.in_file == layout.headings[index];
           });
  };
  std::size_t found = 0;
  for (std::size_t lines = 1; lines <= most_unit_lines; ++lines) {
    const std::vector<Cell> cells = row_cells(source, layout, layout.heading + lines);
    bool has_unit = false;
    for (std::size_t i = 0; i < std::min(cells.size(), layout.headings.size()); ++i) {
      if (!counts(i)) continue;
      if (is_number(cells[i]) && cells[i].text != "1") return found;
      has_unit = has_unit || !unit_word(cells[i].text).empty();
    }
    if (has_unit && !is_row(cells)) found = lines;
  }
  return found;
}

}  // namespace

std::string unit_word(std::string_view text) {
  if (text.size() > 2 && std::string_view("[(<").find(text.front()) != std::string_view::npos) {
    text.remove_prefix(1);
    text.remove_suffix(1);
  }
  if (text.empty() || (text != "1" && text.find_first_of("0123456789+-.") == 0)) return "";
  if (text == "°") return "deg";
  if (text == "counts") return "count";
  constexpr std::array itself{"%", "count", "date", "1"};
  constexpr std::array measured{"s", "mA", "V", "bar", "N", "m", "rad", "kg", "K"};
  const bool known = std::find(itself.begin(), itself.end(), text) != itself.end() ||
                     std::any_of(measured.begin(), measured.end(),
                                 [&](const char* wanted) { return unit_problem(text, wanted).empty(); });
  return known ? std::string(text) : "";
}

std::vector<Cell> row_cells(const Source& source, const CsvLayout& layout, std::size_t line) {
  std::vector<Cell> cells = split_cells(source.line(line), layout.separator);
  drop_empty_ends(cells, layout.headings.size());
  return cells;
}

std::size_t last_row_line(const Source& source) {
  std::size_t last = source.lines();
  while (last > 1 && source.line(last).find_first_not_of(" \t,;\"") == std::string_view::npos) --last;
  return last;
}

CsvLayout layout_of(const Source& source, std::span<const WantedColumn> wanted) {
  const Candidate head = heading_of(source, wanted);
  CsvLayout layout{head.separator, head.line, head.line + 1, 0, {}, {}, {}};
  std::vector<Cell> cells = split_cells(source.line(head.line), head.separator);
  layout.cells = cells.size();
  drop_empty_ends(cells, 1);
  for (const Cell& cell : cells) {
    layout.headings.emplace_back(cell.text);
    layout.offsets.push_back(cell.offset);
  }
  layout.units.resize(layout.headings.size());
  if (layout.cells > most_columns) return layout;
  if (const std::size_t lines = lines_of_units(source, layout, wanted); lines > 0) {
    const std::vector<Cell> units = row_cells(source, layout, layout.heading + lines);
    for (std::size_t i = 0; i < std::min(units.size(), layout.units.size()); ++i)
      layout.units[i] = unit_word(units[i].text);
    layout.first_row += lines;
  }
  while (layout.first_row < source.lines() && trimmed(source.line(layout.first_row)).empty())
    ++layout.first_row;
  return layout;
}

}  // namespace mckibben::input
