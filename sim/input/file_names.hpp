// Names that become parts of file names: results are written under them, so they hold nothing that a path or
// a shell could mistake.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace mckibben::input {

inline constexpr std::string_view file_safe_rule = "use only letters a-z A-Z, digits, _ and -";

constexpr bool is_file_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// Whether all of `name` is file-safe, and there is some of it, but not too much.
constexpr bool is_file_safe(std::string_view name) {
  return !name.empty() && name.size() <= 100 &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_file_safe(c); });
}

/// `name` with every other character replaced by _.
inline std::string made_file_safe(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_file_safe(c); }, '_');
  return name.substr(0, 100);
}

}  // namespace mckibben::input
