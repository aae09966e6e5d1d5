// Writes a struct as JSON by walking its field list: the resolved input, all defaults in place. Quantities
// carry their unit, so what is written can be read again (JSON is YAML) and gives the same struct. What is
// switched off (an effect) is left out.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include <controllers/target.hpp>
#include <plant/command.hpp>
#include <plant/effects/own_laws.hpp>
#include <plant/rig.hpp>
#include <plant/sensors.hpp>
#include <sim/domain/columns.hpp>
#include <sim/domain/variation.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/json.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {

/// What is around a value: what the rig's valves are commanded in, which lists call mA; and how well values
/// are known that stand inside the key `inside`.
struct WriteContext {
  plant::CommandUnit commands = plant::CommandUnit::mA;
  const plant::Spreads* list = nullptr;
  std::string inside{};

  WriteContext below(std::string_view key) const {
    return {commands, list, list == nullptr ? "" : inside + std::string(key) + '.'};
  }
  std::optional<double> of(std::string_view key) const {
    if (list == nullptr) return std::nullopt;
    const auto found = list->find(inside + std::string(key));
    return found == list->end() ? std::nullopt : std::optional(found->second);
  }
};

/// Any value that a field list can hold.
template <class T>
Json to_json(const T& value, const WriteContext& context = {});

/// What a rig file says of muscle 1 holds for both: effects that muscle 2 has not are said to be absent.
void say_absent_effects(const auto& rig, Json& file) {
  if (rig.pair() == nullptr) return;
  const auto say = [&]<class E>(const E&) {
    if (rig.effects.template get<E>().absent() || !rig.pair()->opposite.effects.template get<E>().absent())
      return;
    file["mechanics"]["opposite"]["effects"][std::string(E::name)] = to_json(E{});
  };
  std::apply([&](const auto&... effect) { (say(effect), ...); }, rig.effects.all);
}

/// A quantity: a number for the unit "1", else a text; a text as well with how well it is known.
inline Json quantity_json(double value, std::string_view unit, std::optional<double> spread = {}) {
  if (spread) return write_with_spread(value, *spread, unit);
  return unit == "1" ? Json(value) : Json(write_quantity(value, unit));
}

/// The contents of a hypothesis's file (hypothesis_file.hpp), with its parameters as they stand.
Json hypothesis_json(const plant::OwnLawOf<double>& law);

/// The visitor of a field list.
class JsonWriter {
 public:
  explicit JsonWriter(Json& object, const WriteContext& context = {}) : object_(object), context_(context) {}

  void required(std::string_view key, const auto& value, const auto&... rest) {
    (*this)(key, value, rest...);
  }

  template <class T>
  void operator()(std::string_view key, const T& value, std::string_view listed, double, double,
                  std::string_view) {
    const std::string unit = in_unit(context_.commands, listed);
    if constexpr (std::same_as<T, double>) {
      put(key, quantity_json(value, unit, context_.of(key)));
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      if (value) put(key, quantity_json(*value, unit, context_.of(key)));
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
    put(key, to_json(value, context_.below(key)));
    if constexpr (requires { value.command_unit(); }) context_.commands = value.command_unit();
  }

 private:
  void put(std::string_view key, Json value) { object_[std::string(key)] = std::move(value); }

  Json& object_;
  WriteContext context_;
};

template <class T>
Json to_json(const T& value, const WriteContext& context) {
  if constexpr (std::same_as<T, bool> || std::same_as<T, std::string>) {
    return value;
  } else if constexpr (std::same_as<T, controllers::Height>) {
    return quantity_json(value.value, value.in_metres ? "m" : "1");
  } else if constexpr (Measured<T>) {
    return quantity_json(value.value, T::unit);
  } else if constexpr (is_optional<T>) {
    return to_json(*value, context);
  } else if constexpr (std::same_as<T, domain::RowFilter>) {
    return value.cells;
  } else if constexpr (std::same_as<T, domain::Variation>) {
    Json object{{"sampling", std::string(plant::name_of(value.sampling))}};
    for (const auto& each : value.numbers)
      object[each.path] = each.law == domain::DrawLaw::normal
                              ? "normal " + write_quantity(each.middle, each.unit) + " ± " +
                                    write_quantity(each.deviation, each.unit)
                              : "uniform " + write_quantity(each.low, each.unit) + " .. " +
                                    write_quantity(each.high, each.unit);
    return object;
  } else if constexpr (std::same_as<T, plant::OwnLawsOf<double>>) {
    Json list = Json::array();
    for (const auto& law : value.list)
      if (!law.absent()) list.push_back(hypothesis_json(law));
    return list;
  } else if constexpr (Named<T>) {
    return std::string(plant::name_of(value));
  } else if constexpr (is_vector<T>) {
    Json list = Json::array();
    for (const auto& each : value) list.push_back(to_json(each, context.below(std::to_string(list.size()))));
    return list;
  } else if constexpr (std::same_as<T, plant::Sensors>) {
    Json list = Json::array();
    for (const plant::Sensor& sensor : value) {
      const std::string signal(name_of(sensor.signal));
      list.push_back({{"signal", signal}, {"kind", std::string(name_of(sensor.kind))}});
      list.back().update(to_json(sensor, context.below(signal)));
    }
    return list;
  } else if constexpr (is_variant<T>) {
    return std::visit(
        [&](const auto& alternative) {
          Json object{{"kind", std::string(alternative.kind)}};
          object.update(to_json(alternative, context));
          return object;
        },
        value);
  } else {
    Json object = Json::object();
    const auto own = [&] {
      WriteContext inside = context;
      if constexpr (requires { value.command_unit(); }) inside.commands = value.command_unit();
      if constexpr (requires { value.spreads; }) inside = {inside.commands, &value.spreads, {}};
      return inside;
    };
    JsonWriter writer(object, own());
    T::fields(value, writer);
    if constexpr (requires { value.pair()->opposite.effects; }) say_absent_effects(value, object);
    return object;
  }
}

/// The contents of a file of that schema that holds every field.
template <class T>
Json file_json(std::string_view schema, const T& value, const WriteContext& context = {}) {
  Json file{{"schema", schema}};
  file.update(to_json(value, context));
  return file;
}

}  // namespace mckibben::input
