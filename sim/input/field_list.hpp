// A field list as plain data: what a struct's keys are, their units, ranges, defaults and meaning. Made once
// from the struct's `fields`; the JSON Schema and the tables of the documentation are written from it.
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <controllers/target.hpp>
#include <plant/command.hpp>
#include <sim/domain/renamed.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/sensors_file.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {

// NOLINTNEXTLINE(bugprone-exception-escape): moving Json does not throw
struct FieldInfo {
  enum class Type {
    quantity,
    integer,
    boolean,
    choice,
    text,
    height,
    draws,
    laws,
    named,  ///< a map of names; what each is stands in a group, or it is a text
    structure,
    variant
  };
  /// The fields of a struct, or of one alternative of a variant.
  struct Group {
    std::string kind;  ///< empty for a plain struct
    std::vector<FieldInfo> fields;
  };

  std::string key;
  Type type = Type::text;
  bool required = false;
  bool is_list = false;
  bool by_name = false;  ///< may also be a name or a path
  std::string unit;      ///< of a quantity
  Json lowest, highest;  ///< of a quantity (in `unit`) or an integer
  Json default_value;    ///< as written in a file; null if there is none
  std::vector<std::string> choices;
  std::vector<Group> groups;
  std::string meaning;
  std::vector<std::string> in_place_of{};  ///< keys that are still read, but not to be written any more
};

/// Of a struct whose list depends on what is in it, as it is for these `defaults`.
template <Listed T>
std::vector<FieldInfo> list_fields(const T& defaults = {});

/// The visitor of a field list.
class FieldLister {
 public:
  static constexpr bool lists_all = true;

  explicit FieldLister(std::vector<FieldInfo>& list) : list_(list) {}

  void required(std::string_view key, const auto& value, const auto&... rest) {
    (*this)(key, value, rest...);
    list_.back().required = true;
    list_.back().default_value = nullptr;
  }

  template <class T>
  void operator()(std::string_view key, const T& value, std::string_view unit, double lowest, double highest,
                  std::string_view meaning) {
    FieldInfo& info = add(key, FieldInfo::Type::quantity, meaning);
    info.unit = unit;
    info.lowest = lowest;
    info.highest = highest;
    info.is_list = is_vector<T>;
    if constexpr (std::same_as<T, double>)  // one beyond the ends is none: it must be said
      if (value >= lowest && value <= highest) info.default_value = quantity_json(value, unit);
  }
  template <std::integral T>
  void operator()(std::string_view key, const T& value, std::type_identity_t<T> lowest,
                  std::type_identity_t<T> highest, std::string_view meaning) {
    FieldInfo& info = add(key, FieldInfo::Type::integer, meaning);
    info.lowest = lowest;
    info.highest = highest;
    info.default_value = value;
  }
  template <class T>
  void operator()(std::string_view key, const T& value, std::string_view meaning) {
    FieldInfo& info = add(key, FieldInfo::Type::text, meaning);
    if constexpr (is_vector<T>) {
      describe<typename T::value_type>(info);
      info.is_list = true;
    } else {
      describe<T>(info);
      if constexpr (!is_variant<T> && !Listed<T> && !is_optional<T> && !std::same_as<T, plant::Sensors>)
        if (!is_absent(value)) info.default_value = to_json(value);
    }
  }

 private:
  FieldInfo& add(std::string_view key, FieldInfo::Type type, std::string_view meaning) {
    FieldInfo& info = list_.emplace_back();
    info.key = key;
    info.type = type;
    info.meaning = meaning;
    for (const domain::Renamed& one : domain::renamed)
      if (one.now == key) info.in_place_of.emplace_back(one.before);
    return info;
  }
  template <class T>
  static void describe(FieldInfo& info) {
    if constexpr (std::same_as<T, bool>) {
      info.type = FieldInfo::Type::boolean;
    } else if constexpr (std::same_as<T, std::string>) {
      info.type = FieldInfo::Type::text;
    } else if constexpr (std::same_as<T, controllers::Height>) {
      info.type = FieldInfo::Type::height;
    } else if constexpr (Measured<T>) {
      info.type = FieldInfo::Type::quantity;
      info.unit = T::unit;
      info.lowest = T::lowest;
      info.highest = T::highest;
    } else if constexpr (is_optional<T>) {
      describe<typename T::value_type>(info);
    } else if constexpr (std::same_as<T, domain::RowFilter>) {
      info.type = FieldInfo::Type::named;
    } else if constexpr (std::same_as<T, domain::Variation>) {
      info.type = FieldInfo::Type::draws;
      for (const std::string_view text : spellings<domain::Sampling>()) info.choices.emplace_back(text);
    } else if constexpr (std::same_as<T, plant::OwnLawsOf<double>>) {
      info.type = FieldInfo::Type::laws;
    } else if constexpr (std::same_as<T, plant::Sensors>) {
      add_sensors(info);
    } else if constexpr (Named<T>) {
      info.type = FieldInfo::Type::choice;
      for (const std::string_view text : spellings<T>()) info.choices.emplace_back(text);
    } else if constexpr (is_variant<T>) {
      info.type = FieldInfo::Type::variant;
      add_alternatives(info, static_cast<T*>(nullptr));
    } else {
      info.type = FieldInfo::Type::structure;
      info.by_name = NamedStruct<T>;
      info.groups.push_back({"", list_fields<T>()});
    }
  }
  template <class... Ts>
  static void add_alternatives(FieldInfo& info, std::variant<Ts...>*) {
    (info.groups.push_back({std::string(Ts::kind), list_fields<Ts>()}), ...);
  }

  static void add_sensors(FieldInfo& info) {
    info.type = FieldInfo::Type::variant;
    info.is_list = true;
    for (const OldSensorKey& old : old_sensor_keys) info.in_place_of.emplace_back(old.key);
    const auto signal = [](FieldInfo::Group& group) -> FieldInfo& {
      FieldLister(group.fields).required("signal", plant::Sensed{}, "what it reads");
      return group.fields.back();
    };
    for (const plant::SensorSheet& sheet : plant::sensor_kinds) {
      FieldInfo::Group& group =
          info.groups.emplace_back(FieldInfo::Group{std::string(name_of(sheet.kind)), {}});
      std::erase_if(signal(group).choices, [&](const std::string& text) {
        return std::ranges::none_of(names(plant::Sensed{}), [&](const auto& named) {
          return named.second == text && may_read(sheet.kind, named.first);
        });
      });
      FieldLister lister(group.fields);
      const plant::Sensor sensor{.kind = sheet.kind};
      plant::Sensor::fields(sensor, lister);
    }
    signal(info.groups.emplace_back(FieldInfo::Group{std::string(no_sensor), {}}));
  }

  std::vector<FieldInfo>& list_;
};

template <Listed T>
std::vector<FieldInfo> list_fields(const T& defaults) {
  std::vector<FieldInfo> list;
  FieldLister lister(list);
  T::fields(defaults, lister);
  return list;
}

struct KindOfFile {
  std::string title;
  std::vector<FieldInfo> fields;
};

/// For the documentation: for each kind of file a section with a line for each key, then a section for each
/// alternative of a variant, titled by its path of keys. What has been there before is referred to.
std::string field_lists(const std::vector<KindOfFile>& kinds);

/// JSON Schema (draft 2020-12), for editors that complete and check while one types: of a file whose first
/// line is `schema: NAME` and whose other keys are `fields`.
Json json_schema(std::string_view schema, std::string_view title, const std::vector<FieldInfo>& fields);

}  // namespace mckibben::input
