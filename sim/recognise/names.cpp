// See the header.
#include <algorithm>
#include <regex>

#include <fmt/format.h>

#include <sim/recognise/names.hpp>

namespace mckibben::recognise {

std::optional<std::string> load_in(const std::string& text) {
  static const std::regex number_and_unit(
      R"((^|[^0-9.,])([0-9]{1,6})([.,p]([0-9]{1,6}))?[ _-]?(kg|g|lb)(?![a-zA-Z]))", std::regex::icase);
  std::smatch found;
  if (text.size() > 500 || !std::regex_search(text, found, number_and_unit)) return std::nullopt;
  std::string unit = found[5];
  std::transform(unit.begin(), unit.end(), unit.begin(),
                 [](char c) { return c < 'a' ? static_cast<char>(c + 'a' - 'A') : c; });
  const std::string whole = std::to_string(std::stol(found[2])), fraction = found[4];
  return fmt::format("{}{}{} {}", whole, fraction.empty() ? "" : ".", fraction, unit);
}

std::optional<LoadGuess> load_of(const UnknownTable& table) {
  if (auto load = load_in(table.path.stem().string())) return LoadGuess{*load, "the file's name says so"};
  for (const std::string& line : table.remarks)
    if (auto load = load_in(line)) return LoadGuess{*load, "a line above its headings says so"};
  if (auto load = load_in(table.path.parent_path().filename().string()))
    return LoadGuess{*load, "the folder's name says so"};
  return std::nullopt;
}

}  // namespace mckibben::recognise
