// Enums whose spellings a function `names` lists, as files and messages have them.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>

namespace mckibben::plant {

template <class T>
concept Named = std::is_enum_v<T> && requires(T value) {
  names(value);
};

/// How a value of such an enum is spelled.
template <Named T>
constexpr std::string_view name_of(T value) {
  for (const auto& [known, name] : names(value))
    if (known == value) return name;
  return {};
}

/// The one that is spelled so, if there is one.
template <Named T>
constexpr std::optional<T> named(std::string_view spelling) {
  for (const auto& [known, name] : names(T{}))
    if (name == spelling) return known;
  return std::nullopt;
}

}  // namespace mckibben::plant
