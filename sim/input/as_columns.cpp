// Line by line; see the header.
#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/input/as_columns.hpp>
#include <sim/input/cells.hpp>
#include <sim/input/messages.hpp>
#include <sim/input/number.hpp>
#include <sim/input/text_block.hpp>

namespace mckibben::input {
namespace {

using Lines = std::vector<std::string>;
using Pairs = std::vector<std::pair<std::string_view, std::string_view>>;

constexpr std::size_t looked_at = 200;    // lines
constexpr std::size_t most_labels = 200;  // in a line

bool is_label_sign(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0 ||
         std::string_view("_.-/%").find(c) != std::string_view::npos;
}

bool holds_number(std::string_view line) {
  return std::ranges::any_of(line, [](char c) { return c >= '0' && c <= '9'; });
}

/// Where a value ends: at `from` is its first letter. A text in quotes ends with them; a unit belongs to the
/// number before it, unless it is the next label: `p:1.2 bar x:3`.
std::size_t end_of_value(std::string_view line, std::size_t from, char quote, std::string_view between) {
  if (quote != '\0') return std::min(line.find(quote, from), line.size());
  const std::size_t end = std::min(line.find_first_of(between, from), line.size());
  const std::size_t unit = line.find_first_not_of(' ', end);
  if (unit == std::string_view::npos || unit == end) return end;
  const std::size_t behind = std::min(line.find_first_of(between, unit), line.size());
  const std::size_t next = std::min(line.find_first_not_of(' ', behind), line.size());
  const bool is_label = next < line.size() && (line[next] == ':' || line[next] == '=');
  return is_label || unit_word(line.substr(unit, behind - unit)).empty() ? end : behind;
}

/// `p:1.2, x = 3`, and in braces `'state': 'on'`; none if anything else stands in the line, or a
/// label twice.
Pairs pairs_in(std::string_view line) {
  constexpr std::string_view between = " \t,;\"'{}[]|", ends = " \t,;\"{}[]|";
  const bool braces = trimmed(line).starts_with('{');
  Pairs pairs;
  for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;) {
    std::size_t end = at;
    while (end < line.size() && is_label_sign(line[end])) ++end;
    const std::string_view label = line.substr(at, end - at);
    if (label.empty() || std::isdigit(static_cast<unsigned char>(label.front())) != 0) return {};
    const std::size_t sign = line.find_first_not_of("\"' \t", end);
    if (sign == std::string_view::npos || (line[sign] != ':' && line[sign] != '=')) return {};
    std::size_t from = line.find_first_not_of(" \t", sign + 1);
    if (from == std::string_view::npos) return {};
    const bool quoted = line[from] == '"' || line[from] == '\'';
    const char quote = quoted ? line[from++] : '\0';
    const std::size_t to = end_of_value(line, from, quote, ends);
    const std::string_view value = line.substr(from, to - from);
    const bool text = braces && quoted && value.find('\t') == std::string_view::npos;
    if (!text && !is_number_like(value) && !is_missing({value, 0})) return {};
    if (std::ranges::find(pairs, label, &Pairs::value_type::first) != pairs.end()) return {};
    pairs.emplace_back(label, value);
    if (pairs.size() > most_labels) return {};
    at = line.find_first_not_of(between, to);
  }
  return pairs.size() > 1 ? pairs : Pairs{};
}

/// Records, wherever their lines end: a line for each, and the line where it begins.
/// Empty: there are none.
std::vector<std::pair<std::string, std::size_t>> records_in(const Source& source) {
  const std::string_view text = source.text();
  constexpr std::string_view blank = " \t\r\n";
  std::vector<std::pair<std::string, std::size_t>> records;
  const std::size_t list = std::min(text.find_first_not_of(blank), text.size());
  const std::size_t first = text.find_first_not_of(blank, list + 1);
  if (first == std::string_view::npos || text[list] != '[' || text[first] != '{') return records;
  auto line = static_cast<std::size_t>(1 + std::ranges::count(text.substr(0, first), '\n'));
  std::size_t open = 0, began = 0, depth = 0;
  for (std::size_t at = first; at < text.size(); ++at) {
    line += text[at] == '\n' ? 1 : 0;
    if (text[at] == '{' && depth++ == 0) open = at, began = line;
    if (text[at] != '}' || depth == 0 || --depth > 0) continue;
    records.emplace_back(text.substr(open, at + 1 - open), began);
    std::ranges::replace(records.back().first, '\n', ' ');
  }
  return records;
}

/// Whether most lines that hold numbers are such.
bool most(const Lines& lines, const std::function<bool(std::string_view)>& are_such) {
  std::size_t numbers = 0, such = 0;
  for (std::size_t k = 0; k < std::min(lines.size(), looked_at); ++k) {
    numbers += holds_number(lines[k]) ? 1 : 0;
    such += are_such(lines[k]) ? 1 : 0;
  }
  return such > 1 && 2 * such > numbers;
}

constexpr std::string_view arrow = " -> ";

/// The stamp that a serial monitor puts before each row, to its end.
bool move_stamps(Lines& lines) {
  const auto stamped = [](std::string_view line) {
    const std::size_t at = line.find(arrow);
    return at != std::string_view::npos && at > 7 && line.substr(0, at).find(':') != std::string_view::npos &&
           is_number_like(line.substr(0, at));
  };
  if (!most(lines, stamped)) return false;
  for (std::string& line : lines) {
    if (!stamped(line)) continue;
    const std::size_t at = line.find(arrow);
    const std::string rest = line.substr(at + arrow.size());
    const std::size_t separator = rest.find_first_of("\t;,");
    const char apart = separator == std::string::npos ? ' ' : rest[separator];
    const bool words = !holds_number(rest) ||
                       std::ranges::none_of(split_cells(rest, apart),
                                            [](const Cell& cell) { return is_number_like(cell.text); });
    if (!pairs_in(rest).empty()) {
      std::string stamp = line.substr(0, at);
      std::ranges::replace(stamp, ' ', 'T');
      line = rest + " monitor_time:" + stamp;
    } else if (!words)
      line = rest + apart + line.substr(0, at);
    else
      line = separator == std::string::npos ? rest : rest + apart + "monitor_time";
  }
  return true;
}

/// [0.1, 2, 3] or (0.1, 2, 3).
bool take_brackets(Lines& lines) {
  const auto in_brackets = [](std::string_view line) {
    line = trimmed(line);
    while (line.ends_with(',') || line.ends_with('\r')) line.remove_suffix(1);
    return line.size() > 2 &&
           ((line.front() == '[' && line.back() == ']') || (line.front() == '(' && line.back() == ')')) &&
           holds_number(line) && line.find_first_of("[(", 1) == std::string_view::npos;
  };
  if (!most(lines, in_brackets)) return false;
  for (std::string& line : lines)
    if (in_brackets(line)) {
      const std::size_t from = line.find_first_of("[("), to = line.find_last_of("])");
      line = line.substr(from + 1, to - from - 1);
    }
  return true;
}

/// Seconds and nanoseconds of one stamp in two columns side by side, as ROS has them: one column.
bool join_nanoseconds(Lines& lines) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> ends{
      {{"secs", "nsecs"}, {"sec", "nanosec"}, {"sec", "nsec"}}};
  for (std::size_t head = 0; head < std::min(lines.size(), looked_at); ++head) {
    const std::vector<Cell> cells = split_cells(lines[head], ',');
    for (std::size_t i = 0; i + 1 < cells.size(); ++i)
      for (const auto& [seconds, rest] : ends) {
        if (!cells[i].text.ends_with(seconds) || !cells[i + 1].text.ends_with(rest)) continue;
        std::string_view stem = cells[i].text.substr(0, cells[i].text.size() - seconds.size());
        if (stem != cells[i + 1].text.substr(0, cells[i + 1].text.size() - rest.size())) continue;
        while (stem.ends_with('.') || stem.ends_with('_')) stem.remove_suffix(1);
        const std::string name = stem.empty() ? "stamp" : std::string(stem);
        for (std::size_t k = head; k < lines.size(); ++k) {
          const std::vector<Cell> row = split_cells(lines[k], ',');
          if (row.size() != cells.size()) continue;
          const std::string_view nano = row[i + 1].text;
          const bool digits = !nano.empty() && nano.size() < 10 &&
                              nano.find_first_not_of("0123456789") == std::string_view::npos;
          if (k > head && !digits) continue;
          const std::string joined = k == head ? name
                                               : std::string(row[i].text) + '.' +
                                                     std::string(9 - nano.size(), '0') + std::string(nano);
          std::string line = lines[k].substr(0, row[i].offset) + joined;
          for (std::size_t after = i + 2; after < row.size(); ++after)
            line += ',' + std::string(row[after].text);
          lines[k] = std::move(line);
        }
        return true;
      }
  }
  return false;
}

/// Where each number has its label, and labels come again: labels as headings, numbers below. Where the
/// headings stand; npos: there are no labels.
std::size_t take_labels(Lines& lines) {
  if (!most(lines, [](std::string_view line) { return !pairs_in(line).empty(); })) return std::string::npos;
  std::vector<std::string> labels;
  std::size_t again = 0;
  for (std::size_t k = 0; k < std::min(lines.size(), looked_at); ++k)
    for (const auto& [label, value] : pairs_in(lines[k]))
      if (std::ranges::find(labels, label) == labels.end())
        labels.emplace_back(label);
      else
        ++again;
  if (again == 0) return std::string::npos;  // settings
  std::size_t first = std::string::npos;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Pairs pairs = pairs_in(lines[k]);
    if (pairs.empty()) continue;
    if (first == std::string::npos) first = k;
    std::string row;
    for (const std::string& label : labels) {
      const auto found = std::ranges::find(pairs, label, &Pairs::value_type::first);
      if (&label != &labels.front()) row += '\t';
      if (found != pairs.end()) row += found->second;
    }
    lines[k] = std::move(row);
  }
  std::string heading;
  for (const std::string& label : labels) heading += (heading.empty() ? "" : "\t") + label;
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(first), heading);
  return first;
}

}  // namespace

std::optional<Source> as_columns(const Source& source) {
  if (const auto messages = as_rows(source)) {
    auto joined = as_columns(*messages);
    return joined ? std::move(joined) : messages;
  }
  const std::string_view text = source.text();
  const std::string_view begin = text.substr(0, 20'000);
  const bool may =
      begin.find(arrow) != std::string_view::npos || begin.find_first_of("[({") != std::string_view::npos ||
      begin.find("sec") != std::string_view::npos || begin.find_first_of(":=") != std::string_view::npos;
  if (!may) return std::nullopt;
  Lines lines;
  auto records = records_in(source);
  for (auto& [record, line] : records) lines.push_back(std::move(record));
  for (std::size_t number = 1; records.empty() && number <= source.lines(); ++number) {
    lines.emplace_back(source.line(number));
    if (number == looked_at) {  // most files are no such log
      Lines first = lines;
      const bool changed = move_stamps(first) || take_brackets(first) || join_nanoseconds(first) ||
                           take_labels(first) != std::string::npos;
      if (!changed) return std::nullopt;
    }
  }
  const bool moved = move_stamps(lines), bracketed = take_brackets(lines), joined = join_nanoseconds(lines);
  const std::size_t heading = take_labels(lines);
  if (!moved && !bracketed && !joined && heading == std::string::npos) return std::nullopt;
  Thinned numbers = source.thinned();
  numbers.numbers.clear();
  std::string columns;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    columns += lines[k] + '\n';
    const std::size_t line = k - (heading != std::string::npos && k > heading ? 1 : 0);
    numbers.numbers.push_back(records.empty() ? source.line_in_file(line + 1) : records[line].second);
  }
  return Source(source.name(), std::move(columns), source.folder(), source.sha256(), std::move(numbers));
}

}  // namespace mckibben::input
