// See the header.
#include <algorithm>
#include <cctype>

#include <sim/input/number.hpp>
#include <sim/input/text_block.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t looked_at = 3000;  // lines

/// Lines before the first that has numbers wherever most rows have them are settings and headings: a
/// spreadsheet gives each of its lines as many cells.
void drop_leading_words(const Source& source, Block& block) {
  constexpr double most = 0.8;
  std::vector<std::size_t> numbers(block.raw), filled(block.raw), lines;
  for (std::size_t line = block.first; line <= source.lines() && lines.size() < block.rows; ++line) {
    if (is_blank(source.line(line)) || is_marked(source.line(line))) continue;
    const std::vector<Cell> cells = split_cells(source.line(line), block.separator);
    for (std::size_t i = 0; i < std::min(cells.size(), block.raw); ++i) {
      filled[i] += is_missing(cells[i]) ? 0 : 1;
      numbers[i] += !is_missing(cells[i]) && is_number_like(cells[i].text) ? 1 : 0;
    }
    lines.push_back(line);
  }
  for (const std::size_t line : lines) {
    const std::vector<Cell> cells = split_cells(source.line(line), block.separator);
    bool words = false;
    for (std::size_t i = 0; i < std::min(cells.size(), block.raw); ++i)
      words = words || (!is_missing(cells[i]) && !is_number_like(cells[i].text) &&
                        static_cast<double>(numbers[i]) > most * static_cast<double>(filled[i]));
    if (!words || block.rows <= 1) return;
    --block.rows;
    block.first = *std::ranges::upper_bound(lines, line);
  }
}

Block longest_block(const Source& source, char separator, std::size_t from) {
  Block best{separator}, now{separator};
  const auto close = [&] {
    if (now.score > best.score) best = now;
    now = {separator};
  };
  for (std::size_t line = from; line <= std::min(source.lines(), from + looked_at); ++line) {
    const std::string_view text = source.line(line);
    if (is_blank(text) || is_marked(text)) continue;
    const std::vector<Cell> cells = split_cells(text, separator);
    const Numbers found = numbers_in(cells);
    if (!found.is_row()) {
      // Words between rows that are no cells of theirs are a remark, as kind_of has it.
      const bool apart = separator != ' ' && (text.find(separator) == std::string_view::npos ||
                                              (found.numbers == 0 && cells.size() != now.raw));
      if (!apart || now.raw < 2) close();
      continue;
    }
    if (now.rows > 0 && cells.size() != now.raw) close();
    if (now.rows++ == 0) now.first = line, now.raw = cells.size();
    now.width = std::max(now.width, trimmed_size(cells));
    const double share = static_cast<double>(found.numbers + found.empty) / static_cast<double>(cells.size());
    now.score += share * share;
  }
  close();
  if (best.rows > 0) drop_leading_words(source, best);
  return best;
}

}  // namespace

bool is_blank(std::string_view line) {
  if (line.find_first_not_of(" \t,;|\"\r") == std::string_view::npos) return true;
  return line.find_first_not_of("-=+|: \t\r") == std::string_view::npos &&
         (line.find("---") != std::string_view::npos || line.find("===") != std::string_view::npos);
}

/// `#`, `%` or `//` before a heading or a remark.
std::string_view without_mark(std::string_view text) {
  const std::size_t marks = text.find_first_not_of(text.starts_with("//") ? "/" : "#%");
  return marks == std::string_view::npos ? std::string_view() : trimmed(text.substr(marks));
}
bool is_marked(std::string_view line) {
  line = trimmed(line);
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

bool is_word(std::string_view text) {
  return text.size() > 1 && std::ranges::all_of(text, [](unsigned char c) {
           return std::isalpha(c) != 0 || c >= 0x80 || c == ' ' || c == '.' || c == ':';
         });
}

std::size_t trimmed_size(const std::vector<Cell>& cells) {
  std::size_t size = cells.size();
  while (size > 0 && cells[size - 1].text.empty()) --size;
  return size;
}

Numbers numbers_in(const std::vector<Cell>& cells) {
  Numbers found{cells.size()};
  for (const Cell& cell : cells) {
    found.empty += is_missing(cell) ? 1 : 0;
    found.numbers += !is_missing(cell) && is_number_like(cell.text) ? 1 : 0;
  }
  return found;
}

/// A table of one column says least of its separator; blanks may stand beside tabs.
Block block_of(const Source& source, std::optional<char> said, std::size_t from) {
  if (said) return longest_block(source, *said, from);
  Block best;
  for (const char separator : separators) {
    const Block block = longest_block(source, separator, from);
    const bool wider = block.width > 1 && best.width <= 1 && block.score > 0.5 * best.score;
    if (wider || (block.score > best.score && (block.width > 1 || best.width <= 1))) best = block;
  }
  return best;
}

Block with_ragged(const Source& source, const Block& found_first, std::size_t from) {
  Block block = found_first;
  std::size_t wide = 0;
  for (std::size_t line = block.first - 1; line >= from && line > 0; --line) {
    if (is_blank(source.line(line)) || is_marked(source.line(line))) continue;
    const Numbers found = numbers_in(split_cells(source.line(line), block.separator));
    const bool is_wide = found.cells > block.raw && found.is_row();
    if (!is_wide && (found.numbers == 0 || found.numbers + found.empty != found.cells)) break;
    wide += is_wide ? 1 : 0;
    block.first = line;
  }
  constexpr std::size_t most = 10;  // one in so many is a row with a remark; more are another table
  return most * wide > found_first.first - block.first ? found_first : block;
}

}  // namespace mckibben::input
