// See the header.
#include <sim/law/names.hpp>

namespace mckibben::law {

std::span<const std::string_view> reserved_names() {
  static const auto list = [] {
    std::array<std::string_view, inputs.size() + functions.size() + 1> names;
    auto next = names.begin();
    for (const Input& one : inputs) *next++ = one.name;
    for (const Function& one : functions) *next++ = one.name;
    *next = pi;
    return names;
  }();
  return list;
}

}  // namespace mckibben::law
