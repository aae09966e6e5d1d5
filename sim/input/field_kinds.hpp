// What kinds of member a field list can hold, told apart at compile time. The lists themselves stand in the
// structs of the plant, the controllers and this room (`fields`); the visitors here all use these concepts.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <plant/names.hpp>

namespace mckibben::input {

/// A struct with a field list.
template <class T>
concept Listed = requires(T& value, int& visitor) {
  T::fields(value, visitor);
};

using plant::Named;

/// A struct that can be told the same in more than one way; `resolve` leaves one of them.
template <class T>
concept Resolved = requires(T& value) {
  value.resolve();
};

/// A struct with rules between its fields.
template <class T>
concept Ruled = requires(const T& value, int& report) {
  value.rules(report);
};

/// A struct that can be switched off; then it is not written.
template <class T>
concept Switchable = requires(const T& value) {
  { value.absent() } -> std::same_as<bool>;
};

/// A struct that may also be given by a name or a path (a rig).
template <class T>
concept NamedStruct = requires {
  requires T::by_name;
};

template <class T>
inline constexpr bool is_variant = false;
template <class... Ts>
inline constexpr bool is_variant<std::variant<Ts...>> = true;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

/// A number of a unit and range that its type knows.
template <class T>
concept Measured = requires(T value) {
  { value.value } -> std::same_as<double&>;
  { T::unit } -> std::convertible_to<std::string_view>;
};

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;

/// An enum of which one value is what is there if nothing is said.
template <class T>
concept HasDefault = std::is_enum_v<T> && requires(T value) {
  { absent(value) } -> std::same_as<bool>;
};

/// Whether a value is not written: it is switched off, or a variant that holds what is.
template <class T>
bool is_absent(const T& value) {
  if constexpr (is_variant<T>)
    return std::visit([](const auto& one) { return is_absent(one); }, value);
  else if constexpr (is_optional<T>)
    return !value;
  else if constexpr (HasDefault<T>)
    return absent(value);
  else if constexpr (Switchable<T>)
    return value.absent();
  else
    return false;
}

/// The spellings of an enum, in order.
template <Named T>
auto spellings() {
  constexpr auto list = names(T{});
  std::array<std::string_view, list.size()> texts;
  for (std::size_t i = 0; i < list.size(); ++i) texts[i] = list[i].second;
  return texts;
}

/// The kinds of a variant's alternatives, in order.
template <class T>
inline constexpr std::array<std::string_view, 0> kinds{};
template <class... Ts>
inline constexpr std::array<std::string_view, sizeof...(Ts)> kinds<std::variant<Ts...>>{Ts::kind...};

}  // namespace mckibben::input
