// Message by message, by yaml-cpp; see the header.
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include <sim/input/diagnostics.hpp>
#include <sim/input/messages.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view border = "---";
constexpr std::size_t most_cells = 200, deepest = 10;  // in a message: an image is no row

/// `key:` at the beginning of a line; empty if there is none.
std::string_view key_of(std::string_view line) {
  const std::size_t end = line.find(':');
  const bool ends = end != std::string_view::npos && (end + 1 == line.size() || line[end + 1] == ' ');
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return ends && line.substr(0, end).find_first_not_of(letters) == std::string_view::npos
             ? line.substr(0, end)
             : std::string_view();
}

/// The line where the first message begins: its key begins the second one too, which settings above a table
/// do not do. 0 where there are no messages.
std::size_t first_message(const Source& source) {
  constexpr std::size_t longest = 1000;  // lines of one message
  std::size_t line = 1;
  const auto is_border = [&] { return source.line(line) == border && line > 1; };
  while (!is_border() && line < std::min(source.lines(), longest)) ++line;
  if (!is_border()) return 0;
  const std::string_view key = key_of(source.line(line + 1));
  for (std::size_t before = 1; before < line && !key.empty(); ++before)
    if (key_of(source.line(before)) == key) return before;
  return 0;
}

struct Row {
  std::vector<std::pair<std::string, std::string>> cells;  ///< key, value
  bool too_long = false;

  void add(const YAML::Node& node, const std::string& key, std::size_t depth = 0) {
    const auto inside = [&](const std::string& part) { return key.empty() ? part : key + '.' + part; };
    if (cells.size() > most_cells || depth > deepest) {
      too_long = true;
    } else if (node.IsMap()) {
      for (const auto& pair : node) add(pair.second, inside(pair.first.Scalar()), depth + 1);
    } else if (node.IsSequence()) {
      for (std::size_t k = 0; k < node.size() && !too_long; ++k)
        add(node[k], inside(std::to_string(k)), depth + 1);
    } else {
      std::string value = node.IsScalar() ? node.Scalar() : "";
      for (char& c : value)
        if (c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ') c = ' ';
      cells.emplace_back(key, std::move(value));
    }
  }
};

}  // namespace

std::optional<Source> as_rows(const Source& source) {
  const std::size_t first = first_message(source);
  if (first == 0) return std::nullopt;
  if (source.thinned().step > 1)
    throw BadInput({{Severity::error, source.name(), nowhere,
                     "a log of messages that is too large; write parts of it, or CSV: "
                     "ros2 topic echo --csv TOPIC > run.csv",
                     ""}});
  std::vector<std::string> keys;
  std::string rows;
  std::vector<std::size_t> numbers{1};  // of the headings
  for (std::size_t at = first; at <= source.lines();) {
    const std::size_t begin = at;
    std::string text;
    for (; at <= source.lines() && source.line(at) != border; ++at) text.append(source.line(at)) += '\n';
    if (at > source.lines()) break;  // the last one was cut, perhaps within a number
    ++at;
    Row row;
    try {
      row.add(YAML::Load(text), "");
    } catch (const YAML::Exception&) {
      continue;
    }
    if (row.too_long) return std::nullopt;
    if (row.cells.empty()) continue;
    if (keys.empty())
      for (const auto& cell : row.cells) keys.push_back(cell.first);
    for (const std::string& key : keys) {
      const auto cell = std::ranges::find(row.cells, key, &decltype(row.cells)::value_type::first);
      if (&key != &keys.front()) rows += ',';
      if (cell != row.cells.end()) rows += cell->second;
    }
    rows += '\n';
    numbers.push_back(source.line_in_file(begin));
  }
  if (keys.empty()) return std::nullopt;
  std::string table;
  for (const std::string& key : keys) table += (table.empty() ? "" : ",") + key;
  table += '\n' + rows;
  Thinned lines = source.thinned();
  lines.numbers = std::move(numbers);
  return Source(source.name(), std::move(table), source.folder(), source.sha256(), std::move(lines));
}

}  // namespace mckibben::input
