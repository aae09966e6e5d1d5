// Cells and their numbers; see the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/input/cells.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::size_t longest_shown = 40;

std::vector<Cell> split_at_blanks(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t;", at), line.size());
    cells.push_back({line.substr(at, end - at), at});
    at = line.find_first_not_of(blanks, end);
    if (at != std::string_view::npos && line[at] == ';') at = line.find_first_not_of(blanks, at + 1);
  }
  return cells;
}

}  // namespace

std::vector<Cell> split_cells(std::string_view line, char separator) {
  if (separator == ' ') return split_at_blanks(line);
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    bool in_quotes = false;
    std::size_t end = start;
    for (; end < line.size() && (in_quotes || line[end] != separator); ++end)
      if (line[end] == '"') in_quotes = !in_quotes;
    if (in_quotes) return {};
    Cell cell{trimmed(line.substr(start, end - start)), start};
    if (!cell.text.empty()) cell.offset = static_cast<std::size_t>(cell.text.data() - line.data());
    if (cell.text.size() >= 2 && cell.text.front() == '"' && cell.text.back() == '"')
      cell.text = trimmed(cell.text.substr(1, cell.text.size() - 2));
    cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

bool is_missing(const Cell& cell) {
  return cell.text.empty() || cell.text == "nan" || cell.text == "NaN" || cell.text == "NAN";
}

std::optional<double> NumberReader::read(std::string_view name, const Cell& cell, std::string& problem) {
  const std::string_view shown = cell.text.substr(0, longest_shown);
  problem.clear();
  if (cell.text.empty()) {
    problem = fmt::format("{} is missing here", name);
    return std::nullopt;
  }
  const std::size_t at = cell.text.find_first_of(".,");
  const char sign = at == std::string_view::npos ? '\0' : cell.text[at];
  if (sign_ == '\0') sign_ = sign;
  if (sign_ != ',' || sign == '\0') {
    const auto value = parse_number(cell.text);
    if (!value) problem = fmt::format("{}: {}", name, why_no_number(shown));
    return value;
  }
  std::string with_point(cell.text);
  with_point[at] = '.';
  const auto value = sign == ',' ? parse_number(with_point) : std::nullopt;
  if (!value)
    problem = fmt::format("{}: {} is not a number: the decimal sign of this file is a comma", name, shown);
  return value;
}

}  // namespace mckibben::input
