// How often a page says something.
#pragma once

#include <string>
#include <string_view>

namespace mckibben::report {

inline std::size_t count(const std::string& text, std::string_view what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

}  // namespace mckibben::report
