// What a line of a table is; see text_layout.hpp.
#include <algorithm>
#include <cctype>
#include <optional>

#include <sim/input/column_hints.hpp>
#include <sim/input/number.hpp>
#include <sim/input/text_block.hpp>
#include <sim/input/text_layout.hpp>

namespace mckibben::input {
namespace {

/// Files that were put one behind the other bring each its mark.
std::string_view without_order_mark(std::string_view line) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return line.starts_with(mark) ? line.substr(mark.size()) : line;
}

/// A row of units, as below headings.
std::optional<Line> kind_of_units(const std::vector<Cell>& cells, const TextLayout& layout) {
  bool same = true;
  std::size_t units = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string unit = unit_word(cells[i].text);
    if (unit.empty() && !cells[i].text.empty()) return std::nullopt;
    units += unit.empty() ? 0 : 1;
    same = same && unit == (i < layout.units.size() ? layout.units[i] : "");
  }
  if (units < 2) return std::nullopt;
  return same ? Line::heading : Line::another;
}

/// A line that begins with a word where rows have a number: words between rows, or the headings of another
/// table.
std::optional<Line> kind_of_words(std::string_view text, const TextLayout& layout) {
  const std::size_t first = text.find_first_not_of(" \t\"");
  const auto begin = first == std::string_view::npos ? ' ' : static_cast<unsigned char>(text[first]);
  const bool bracket = begin == '[' || begin == '(';
  if (!layout.begins_with_number || (std::isalpha(begin) == 0 && begin < 0x80 && !bracket))
    return std::nullopt;
  const std::vector<Cell> cells = split_cells(text, layout.separator);
  if (const auto units = kind_of_units(cells, layout)) return units;
  if (bracket || cells.empty() || is_missing(cells.front()) || is_number_like(cells.front().text))
    return std::nullopt;
  const std::size_t size = trimmed_size(cells);
  const bool numbers = layout.separator != ' ' && numbers_in(cells).numbers > 0;
  if (numbers && layout.has_summaries && is_word(cells.front().text)) return Line::summary;
  if (numbers) return std::nullopt;
  if (size != layout.headings.size() && size != layout.usual_cells) return Line::remark;
  if (std::ranges::any_of(cells, [](const Cell& cell) { return names_time(cell.text); }))
    return Line::another;
  return std::nullopt;
}

/// `5 kg` alone in a table of several columns: the title of the rows below it.
bool is_title(std::string_view text, const TextLayout& layout) {
  const std::size_t last = text.find_last_not_of(" \t,;|\"\r");
  if (layout.headings.size() < 2 || last == std::string_view::npos ||
      std::isalpha(static_cast<unsigned char>(text[last])) == 0)
    return false;
  std::vector<Cell> cells{{trimmed(text), 0}};
  if (layout.separator != ' ') cells = split_cells(text, layout.separator);
  std::erase_if(cells, [](const Cell& cell) { return cell.text.empty(); });
  std::string unit;
  return cells.size() == 1 && take_unit(cells.front(), unit) && !unit.empty();
}

}  // namespace

Line kind_of(const Source& source, const TextLayout& layout, std::size_t line) {
  const std::string_view text = without_order_mark(source.line(line));
  if (is_blank(text)) return Line::blank;
  for (std::size_t head = layout.heading; head > 0 && head < layout.first_row; ++head)
    if (without_order_mark(source.line(head)) == text) return Line::heading;
  if (is_marked(text) || is_title(text, layout)) return Line::remark;
  if (const auto words = kind_of_words(text, layout)) return *words;
  const bool has_separator = layout.separator != ' ' && text.find(layout.separator) != std::string_view::npos;
  if (has_separator || layout.headings.size() < 2) return Line::row;
  const bool has_number =
      std::ranges::any_of(split_cells(text, ' '), [](const Cell& cell) { return is_number_like(cell.text); });
  return has_number && layout.separator == ' '                                       ? Line::row
         : is_number_like(trimmed(text)) || text.find('"') != std::string_view::npos ? Line::row
                                                                                     : Line::remark;
}

}  // namespace mckibben::input
