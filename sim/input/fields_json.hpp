// Writes a struct as JSON by walking its field list: the resolved input, all defaults in place. Quantities
// carry their unit, so what is written can be read again (JSON is YAML) and gives the same struct. What is
// switched off (an effect) is left out.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include <controllers/target.hpp>
#include <plant/command.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/json.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {

/// Any value that a field list can hold.
template <class T>
Json to_json(const T& value);

/// A quantity: a number for the unit "1", else a text.
inline Json quantity_json(double value, std::string_view unit) {
  return unit == "1" ? Json(value) : Json(write_quantity(value, unit));
}

/// The visitor of a field list.
class JsonWriter {
 public:
  explicit JsonWriter(Json& object) : object_(object) {}

  void required(std::string_view key, const auto& value, const auto&... rest) {
    (*this)(key, value, rest...);
  }

  template <class T>
  void operator()(std::string_view key, const T& value, std::string_view unit, double, double,
                  std::string_view) {
    if constexpr (std::same_as<T, double>) {
      put(key, quantity_json(value, unit));
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      if (value) put(key, quantity_json(*value, unit));
    } else {
      Json list = Json::array();
      for (const double each : value) list.push_back(quantity_json(each, unit));
      put(key, std::move(list));
    }
  }
  template <std::integral T>
  void operator()(std::string_view key, const T& value, auto, auto, std::string_view) {
    put(key, value);
  }
  template <class T>
  void operator()(std::string_view key, const T& value, std::string_view) {
    if (is_absent(value)) return;
    put(key, to_json(value));
  }

 private:
  void put(std::string_view key, Json value) { object_[std::string(key)] = std::move(value); }

  Json& object_;
};

template <class T>
Json to_json(const T& value) {
  if constexpr (std::same_as<T, bool> || std::same_as<T, std::string>) {
    return value;
  } else if constexpr (std::same_as<T, controllers::Height>) {
    return quantity_json(value.value, value.in_metres ? "m" : "1");
  } else if constexpr (std::same_as<T, plant::RatedCommand>) {
    return quantity_json(value.value, plant::name_of(value.unit));
  } else if constexpr (Named<T>) {
    return std::string(spelling(value));
  } else if constexpr (is_vector<T>) {
    Json list = Json::array();
    for (const auto& each : value) list.push_back(to_json(each));
    return list;
  } else if constexpr (is_variant<T>) {
    return std::visit(
        [](const auto& alternative) {
          Json object{{"kind", std::string(alternative.kind)}};
          object.update(to_json(alternative));
          return object;
        },
        value);
  } else {
    Json object = Json::object();
    JsonWriter writer(object);
    T::fields(value, writer);
    return object;
  }
}

}  // namespace mckibben::input
