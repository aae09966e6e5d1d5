// See the header.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/spelling.hpp>

namespace mckibben::input {
namespace {

/// What columns tell by `sign`, if they agree; 0: nothing, or two signs.
char agreed(const std::vector<Spelling>& columns, const auto& sign) {
  char told = '\0';
  for (const Spelling& each : columns) {
    const char own = (each.*sign)();
    if (own == '\0') continue;
    if (told != '\0' && told != own) return '\0';
    told = own;
  }
  return told;
}

}  // namespace

std::string Look::note_of_short_rows(std::size_t line_in_file) const {
  return fmt::format("{} row{} lack{} cells, the first in line {}; which ones, it does not say: not read",
                     short_rows, short_rows == 1 ? "" : "s", short_rows == 1 ? "s" : "", line_in_file);
}

std::string Look::note_of_summaries(std::size_t line_in_file) const {
  return fmt::format(
      "{} row{} with a word where the others have their first number, the first in line {}: not read",
      summaries, summaries == 1 ? "" : "s", line_in_file);
}

Look look_at(const Source& source, const TextLayout& layout) {
  constexpr std::size_t enough_rows = 3000;  // where they have decimals
  constexpr std::size_t few = 10;            // one in so many has lost cells; more are written so
  std::vector<Spelling> columns(layout.headings.size());
  const auto has_decimals = [](const Spelling& each) { return each.decimal() != '\0'; };
  Look look;
  std::size_t rows = 0;
  for (std::size_t line = layout.first_row; line <= layout.last_row; ++line) {
    const Line kind = kind_of(source, layout, line);
    if (kind == Line::another && look.another_heading == 0) look.another_heading = line;
    if (kind == Line::summary && look.summaries++ == 0) look.first_summary = line;
    if (kind != Line::row) continue;
    const std::vector<Cell> cells = row_cells(source, layout, line);
    if (!cells.empty() && cells.size() < layout.usual_cells && look.short_rows++ == 0)
      look.first_short = line;
    if (++rows > enough_rows && std::ranges::any_of(columns, has_decimals)) continue;
    for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i)
      columns[i].look_at(cells[i].text);
  }
  if (few * look.short_rows > rows) {
    if (layout.separator == ' ') look.blank_cells = look.first_short;
    look.short_rows = 0;
  }
  if (const auto first = std::ranges::find_if(columns, has_decimals); first != columns.end())
    look.decimal = first->decimal();
  else
    look.decimal = agreed(columns, &Spelling::goes_on);
  for (const Spelling& each : columns) {
    ColumnSpelling own;
    std::string unit;
    Cell mass{each.group(), 0};
    const bool is_mass = take_unit(mass, unit) && !unit.empty() && unit_problem(unit, "kg").empty();
    if (is_mass && each.decimal() == '\0' && each.mark() != look.decimal)
      own = {each.mark(), each.group()};  // in quotes, by another program or hand than the numbers beside it
    else if (look.decimal != '\0')
      own.decimal = look.decimal;
    else if (!each.group().empty())
      own = {each.mark(), each.group()};
    look.columns.push_back(std::move(own));
  }
  return look;
}

}  // namespace mckibben::input
