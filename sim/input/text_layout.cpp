// What stands above the longest block; see the header.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include <sim/input/column_hints.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/text_block.hpp>
#include <sim/input/text_layout.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t most_head_lines = 6;

/// What a first line such as sep=; says, also in quotes and with separators behind it.
std::optional<char> said_separator(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('"')) line.remove_prefix(1);
  constexpr std::string_view word = "sep=";
  const bool says =
      line.size() > word.size() && std::equal(word.begin(), word.end(), line.begin(), [](char a, char b) {
        return a == std::tolower(static_cast<unsigned char>(b));
      });
  if (!says || separators.find(line[word.size()]) == std::string_view::npos) return std::nullopt;
  return line[word.size()];
}

/// Names of several words between two blanks or more, if they are as many as the columns.
std::optional<std::vector<Cell>> split_at_gaps(std::string_view line, std::string_view bare,
                                               std::size_t width) {
  std::vector<Cell> cells;
  for (std::size_t at = bare.find_first_not_of(" \t");
       at != std::string_view::npos && cells.size() <= width;) {
    const std::size_t end = std::min({bare.find("  ", at), bare.find('\t', at), bare.size()});
    cells.push_back(
        {trimmed(bare.substr(at, end - at)), at + static_cast<std::size_t>(bare.data() - line.data())});
    at = bare.find_first_not_of(" \t", end);
  }
  if (cells.size() != width) return std::nullopt;
  return cells;
}

/// Cells of a line that may be a heading: in one between blanks a unit in brackets belongs to the word
/// before.
std::vector<Cell> heading_cells(std::string_view line, char separator, std::size_t width) {
  const std::string_view bare = is_marked(line) && separator == ' ' ? without_mark(line) : line;
  std::vector<Cell> cells = split_cells(bare, separator);
  if (separator != ' ') return cells;
  std::vector<Cell> joined;
  for (Cell& cell : cells) {
    cell.offset += static_cast<std::size_t>(bare.data() - line.data());
    if (!joined.empty() && (cell.text.front() == '[' || cell.text.front() == '('))
      joined.back().text =
          line.substr(joined.back().offset, cell.offset + cell.text.size() - joined.back().offset);
    else
      joined.push_back(cell);
  }
  return joined.size() == width ? joined : split_at_gaps(line, bare, width).value_or(std::move(joined));
}

/// Lines of words above a block that belong to its columns.
struct Head {
  std::size_t line;
  std::vector<Cell> cells;
  bool names_all = false;   ///< a different word for each column
  bool fits = false;        ///< as many as there are columns
  bool clock = false;       ///< one of them names the time
  bool says_units = false;  ///< one of them has a unit in brackets
  bool units = false;       ///< nothing but units
  std::size_t wanted = 0;   ///< names that are looked for
};

class Heads {
 public:
  Heads(const Source& source, const Block& block, std::size_t from, std::span<const WantedColumn> wanted)
      : source_(&source), block_(block), wanted_(wanted) {
    std::size_t blanks = 0;
    for (std::size_t line = block.first - 1; line >= from && line > 0 && list_.size() < most_head_lines;
         --line) {
      if (is_blank(source.line(line))) {
        if (++blanks > 2) break;
        continue;
      }
      if (!take(line)) break;
    }
    std::ranges::reverse(list_);
  }

  const std::vector<Head>& list() const { return list_; }
  /// The heading among them: what is looked for, then the first that names each column, with time among them,
  /// with units in brackets, then the last of words.
  const Head* heading() const {
    const Head* best = nullptr;
    for (const Head& head : list_)
      if (!head.units && (best == nullptr || rank(head) > rank(*best))) best = &head;
    return best != nullptr ? best : list_.empty() ? nullptr : &list_.front();
  }

 private:
  static std::size_t rank(const Head& head) {
    return 16 * head.wanted + (head.names_all ? 8 : 0) + (head.clock ? 4 : 0) + (head.says_units ? 2 : 0) +
           (head.fits ? 1 : 0);
  }

  bool take(std::size_t line) {
    Head head{line, heading_cells(source_->line(line), block_.separator, block_.width)};
    const std::size_t size = trimmed_size(head.cells);
    head.units = size > 0 && std::ranges::all_of(head.cells, [](const Cell& cell) {
                   return cell.text.empty() || !unit_word(cell.text).empty();
                 });
    const bool fits =
        size == block_.width || (size > block_.width && block_.separator != ' ') || (head.units && size > 1);
    if (!fits || size == 0 || (block_.width > 1 && size < 2 && !head.units)) return false;
    if (std::any_of(head.cells.begin(),
                    head.cells.begin() + static_cast<std::ptrdiff_t>(std::min(size, block_.width)),
                    [](const Cell& cell) { return !is_missing(cell) && is_number_like(cell.text); }))
      return false;
    if (is_marked(source_->line(line)) && block_.separator == ' ' && size != block_.width) return false;
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < std::min(size, block_.width); ++i) {
      names.push_back(head.cells[i].text);
      head.wanted += static_cast<std::size_t>(std::ranges::count_if(wanted_, [&](const WantedColumn& column) {
        return column.in_file == names.back() || column.in_file == without_mark(names.back());
      }));
    }
    head.fits = size == block_.width;
    head.clock = std::ranges::any_of(names, names_time);
    head.says_units = std::ranges::any_of(names, [](std::string_view name) {
      const std::size_t open = name.find_last_of("[(");
      return open != std::string_view::npos && open > 0 && !unit_word(name.substr(open)).empty();
    });
    std::ranges::sort(names);
    head.names_all = names.size() == block_.width && !names.front().empty() &&
                     std::ranges::adjacent_find(names) == names.end();
    list_.push_back(std::move(head));
    return true;
  }

  const Source* source_;
  Block block_;
  std::span<const WantedColumn> wanted_;
  std::vector<Head> list_;
};

/// Without rows: the line that has most of what is looked for, or the first that holds anything.
void headings_alone(const Source& source, std::span<const WantedColumn> wanted, std::optional<char> said,
                    std::size_t from, TextLayout& layout) {
  std::size_t most = 0;
  for (std::size_t line = from; line <= std::min(source.lines(), from + 100); ++line) {
    if (is_blank(source.line(line)) || is_marked(source.line(line))) continue;
    for (const char separator : separators) {
      if (said && separator != *said) continue;
      const std::vector<Cell> cells = split_cells(source.line(line), separator);
      std::size_t found = 1;
      for (const WantedColumn& column : wanted)
        found += std::ranges::count(cells, column.in_file, &Cell::text) > 0 ? 1 : 0;
      if (found <= most && !(found == most && layout.heading == line && cells.size() > layout.cells))
        continue;
      most = found;
      layout.heading = line;
      layout.separator = separator;
      layout.cells = cells.size();
    }
  }
  layout.first_row = layout.heading + 1;
}

void name_columns(const Source& source, std::size_t width, TextLayout& layout) {
  if (layout.heading > 0) {
    const std::vector<Cell> cells = heading_cells(source.line(layout.heading), layout.separator, width);
    layout.cells = std::max(layout.cells, cells.size());
    const std::size_t size = width > 0 ? width : trimmed_size(cells);
    for (std::size_t i = 0; i < std::min(size, cells.size()); ++i) {
      layout.headings.emplace_back(cells[i].text);
      layout.offsets.push_back(cells[i].offset);
    }
  }
  while (layout.headings.size() < width) {
    layout.headings.push_back(layout.heading > 0 ? "" : std::to_string(layout.headings.size() + 1));
    layout.offsets.push_back(0);
  }
  layout.units.resize(layout.headings.size());
}

/// Of a row of words and numbers above rows of numbers; it may name the columns, if it begins with a word.
std::string word_among_numbers(const std::vector<Cell>& cells) {
  const auto number = std::ranges::find_if(cells, is_number_like, &Cell::text);
  const auto word = std::ranges::find_if(
      cells, [](const Cell& cell) { return !is_missing(cell) && !is_number_like(cell.text); });
  if (word == cells.end()) return "this row has other cells than those below";
  return fmt::format("this row has a word, {}, where the others have numbers{}", word->text.substr(0, 40),
                     word > number
                         ? ""
                         : fmt::format("; if it names the columns, no name may begin as a number, as "
                                       "{0} does: write x_{0}, and put columns of several loads or "
                                       "runs into a file each",
                                       number->text.substr(0, 40)));
}

/// Words right above the rows that are fewer than the cells below: decimal commas between commas, or a
/// heading that lacks one. Which column is which cannot be told.
void check_belongs(const Source& source, const Block& block, TextLayout& layout) {
  if (layout.heading > 0 || block.first < 2) return;
  const std::size_t above = block.first - 1;
  if (is_marked(source.line(above)) || is_blank(source.line(above))) return;
  const std::vector<Cell> words = heading_cells(source.line(above), block.separator, block.width);
  const std::size_t size = trimmed_size(words);
  if (size == block.width && numbers_in(words).numbers > 0) {
    layout.problem_line = above;
    layout.problem = word_among_numbers(words);
    return;
  }
  if (size < 2 || block.separator == ' ' || numbers_in(words).numbers > 0 || size >= block.width) return;
  layout.problem_line = block.first;
  layout.problem = fmt::format(
      "this row has {} cells; the header has {}{}", block.raw, size,
      block.separator == ',' ? "; with decimal commas columns must stand between semicolons or tabs" : "");
}

/// Rows may lack their last cells where the block was found: as many as the widest has, of those with
/// headings.
std::size_t widest_row(const Source& source, const Block& block, std::size_t headings) {
  constexpr std::size_t looked_at_below = 3000;
  std::size_t width = block.width;
  const std::size_t last = std::min(source.lines(), block.first + looked_at_below);
  for (std::size_t line = block.first; line <= last && width < headings; ++line) {
    const std::vector<Cell> cells = split_cells(source.line(line), block.separator);
    if (numbers_in(cells).is_row()) width = std::max(width, std::min(trimmed_size(cells), headings));
  }
  return width;
}

/// Where a recorder began anew, an earlier and shorter block is of the same table: under the same heading,
/// or, without one, with as many cells.
void begin_with_the_first(const Source& source, const Block& block, std::size_t from, TextLayout& layout) {
  for (std::size_t line = from; line < layout.head; ++line) {
    if (layout.heading > 0) {
      if (source.line(line) != source.line(layout.heading)) continue;
      layout.first_row -= layout.heading - line;
      layout.head = layout.heading = line;
      return;
    }
    const std::string_view text = source.line(line);
    const std::vector<Cell> cells = split_cells(text, block.separator);
    const Numbers found = numbers_in(cells);
    if (is_marked(text) || cells.size() != block.raw || found.numbers + found.empty != found.cells) continue;
    layout.head = layout.first_row = line;
    return;
  }
}

/// Lines below the headings that are no rows: below a line of units those without a number, as remarks on the
/// columns and ranges are; the columns' numbers, behind which the clock falls back.
void leave_out_between(const Source& source, const Block& block, TextLayout& layout) {
  if (layout.heading == 0 || layout.headings.size() < 2) return;
  const auto numbers_columns = [&](std::size_t line, const std::vector<Cell>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i].text != std::to_string(i + 1)) return false;
    const std::vector<Cell> next = split_cells(source.line(line + 1), layout.separator);
    std::string problem;
    return cells.size() > 2 && cells.size() == layout.headings.size() && next.size() == cells.size() &&
           NumberReader('\0').read("", next.front(), problem).value_or(1.0) < 1.0;
  };
  const bool has_units = layout.first_row > layout.heading + 1;
  for (std::size_t line = layout.first_row; line <= block.first && line < layout.last_row; ++line) {
    if (is_blank(source.line(line)) || is_marked(source.line(line))) continue;
    const std::vector<Cell> cells = split_cells(source.line(line), layout.separator);
    const Numbers found = numbers_in(cells);
    const bool words = has_units && line < block.first && found.numbers == 0 && found.empty < found.cells;
    if (!words && !numbers_columns(line, cells)) return;
    if (layout.between == 0) layout.between = line;
    layout.first_row = line + 1;
  }
}

/// Whether few rows begin with a word.
bool has_summaries(const Source& source, const TextLayout& layout) {
  constexpr std::size_t looked_at_below = 3000, few = 10;
  if (!layout.begins_with_number || layout.headings.size() < 2 || layout.separator == ' ') return false;
  std::size_t words = 0, rows = 0;
  for (std::size_t line = layout.first_row;
       line <= std::min(layout.last_row, layout.first_row + looked_at_below); ++line) {
    const std::vector<Cell> cells = split_cells(source.line(line), layout.separator);
    if (!numbers_in(cells).is_row()) continue;
    ++rows;
    words += is_word(cells.front().text) && !is_missing(cells.front()) ? 1 : 0;
  }
  return few * words <= rows;
}

/// Sums and the like below the last row: a word where rows have their first number.
void leave_out_footer(const Source& source, std::size_t some_row, TextLayout& layout) {
  constexpr std::size_t most_below = 20;
  const auto first_of = [&](std::size_t line) {
    const std::vector<Cell> cells = split_cells(source.line(line), layout.separator);
    return cells.empty() ? std::string_view() : cells.front().text;
  };
  if (layout.headings.size() < 2 || !is_number_like(first_of(some_row))) return;
  const std::size_t last = layout.last_row;
  for (std::size_t line = last; line > some_row && line + most_below > last; --line) {
    if (is_blank(source.line(line))) continue;
    if (!is_word(first_of(line)) || is_missing({first_of(line), 0})) break;
    layout.footer = line;
    layout.last_row = line - 1;
  }
}

}  // namespace

std::vector<Cell> row_cells(const Source& source, const TextLayout& layout, std::size_t line) {
  std::vector<Cell> cells = split_cells(source.line(line), layout.separator);
  while (cells.size() > layout.headings.size() && cells.back().text.empty()) cells.pop_back();
  return cells;
}

std::size_t index_of(const TextLayout& layout, std::string_view name) {
  for (std::size_t i = 0; i < layout.headings.size(); ++i)
    if (layout.headings[i] == name) return i;
  for (std::size_t i = 0; i < layout.headings.size(); ++i)
    if (!name.empty() && without_mark(layout.headings[i]) == name) return i;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc{} && end == name.data() + name.size() && number >= 1 &&
      number <= layout.headings.size())
    return number - 1;
  return std::string_view::npos;
}

TextLayout layout_of(const Source& source, std::span<const WantedColumn> wanted) {
  const std::optional<char> said = said_separator(source.line(1));
  const std::size_t from = said ? 2 : 1;
  TextLayout layout;
  layout.last_row = source.lines();
  while (layout.last_row > from && is_blank(source.line(layout.last_row))) --layout.last_row;
  Block block = block_of(source, said, from);
  if (block.rows == 0) {
    headings_alone(source, wanted, said, from, layout);
    layout.head = layout.heading;
    name_columns(source, 0, layout);
    return layout;
  }
  Heads heads(source, block, from, wanted);
  if (heads.heading() == nullptr)  // a row that lacks cells may stand below the heading
    if (const Block longer = with_ragged(source, block, from); longer.first < block.first)
      if (Heads above(source, longer, from, wanted); above.heading() != nullptr) {
        block = longer;
        heads = std::move(above);
      }
  layout.separator = block.separator;
  layout.first_row = layout.head = block.first;
  layout.cells = block.raw;
  const std::vector<Cell> first = split_cells(source.line(block.first), block.separator);
  layout.begins_with_number =
      !first.empty() && !is_missing(first.front()) && is_number_like(first.front().text);
  if (const Head* heading = heads.heading()) {
    layout.heading = heading->line;
    layout.head = heads.list().front().line;
    block.width = widest_row(source, block, trimmed_size(heading->cells));
  }
  name_columns(source, block.width, layout);
  if (layout.heading > 0 && heads.heading()->units) {  // units without names
    layout.heading = 0;
    for (std::size_t i = 0; i < block.width; ++i) layout.headings[i] = std::to_string(i + 1);
  }
  layout.usual_cells = std::min(block.raw, layout.headings.size());
  check_belongs(source, block, layout);
  if (layout.cells > most_columns) return layout;
  // Lines of words below the last that says units are no part of the head: rows, and wrong ones.
  if (layout.heading > 0) layout.first_row = layout.heading + 1;
  for (const Head& head : heads.list()) {
    if (head.line == layout.heading) continue;
    bool says = false;
    for (std::size_t i = 0; i < std::min(head.cells.size(), layout.units.size()); ++i)
      if (const std::string unit = unit_word(head.cells[i].text); !unit.empty()) {
        layout.units[i] = unit;
        says = true;
      }
    if (says && head.line > layout.heading) layout.first_row = head.line + 1;
  }
  leave_out_between(source, block, layout);
  begin_with_the_first(source, block, from, layout);
  leave_out_footer(source, block.first, layout);
  layout.has_summaries = has_summaries(source, layout);
  if (layout.head > from && !is_marked(source.line(layout.head - 1))) {
    const Numbers above = numbers_in(split_cells(source.line(layout.head - 1), layout.separator));
    if (above.cells > 1 && above.numbers == above.cells) layout.unread = layout.head - 1;
  }
  return layout;
}

}  // namespace mckibben::input
