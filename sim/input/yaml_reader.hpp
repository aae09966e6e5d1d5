// Fills a struct from a YAML map by walking its field list, and collects every problem on the way: unknown
// and missing keys, units, ranges, spellings, and last the rules between fields. Keys that are absent keep
// the member's value, so a struct can be read as changes to another (a rig on its base).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <controllers/target.hpp>
#include <plant/command.hpp>
#include <plant/effects/own_laws.hpp>
#include <plant/rig.hpp>
#include <plant/sensors.hpp>
#include <sim/domain/columns.hpp>
#include <sim/domain/variation.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// What is around a value: what the rig's valves are commanded in, which lists call mA. And where values may
/// say how well they are known (`6 mm ± 0.1 mm`): into which list that goes, under the path `inside` and
/// their key. Without a list it is a problem.
struct ReadContext {
  plant::CommandUnit commands = plant::CommandUnit::mA;
  plant::Spreads* list = nullptr;
  std::string inside{};
  std::string base{};  ///< what the values that are not written are of; empty: defaults

  ReadContext below(std::string_view key) const {
    return {commands, list, list == nullptr ? "" : inside + std::string(key) + '.', base};
  }
};

/// Reads `node` into `into` by the field list of T, on top of what is there. `also_allowed` are keys that the
/// caller reads itself.
template <Listed T>
void read_struct(const Source& source, const Node& node, T& into, Problems& problems,
                 std::span<const std::string_view> also_allowed = {}, const ReadContext& context = {});

/// Reads a list of a user's own laws (hypothesis_file.hpp).
void read_named(const Source& source, const Node& node, plant::OwnLawsOf<double>& into, Problems& problems);

/// Reads the list of a rig's sensors on top of what is there (sensors_file.hpp).
void read_sensors(const Source& source, const Node& node, plant::Sensors& into, Problems& problems,
                  const ReadContext& context);

/// Notes that a file was opened and what was found in it, and checks its line `schema: NAME/VERSION`.
/// False if it is another kind of file, not worth reading on.
bool begin_file(const YamlFile& file, std::string_view schema, Problems& problems);

/// Reads another file, which is named at `node`; what is wrong with it is a problem of this one.
void read_other(const Source& source, const Node& node, Problems& problems, const auto& read) {
  try {
    read();
  } catch (const MissingInput& missing) {
    problems.missing_file(source, node.place, missing.what());
  } catch (const BadInput& bad) {
    problems.adopt(bad.problems());
  }
}

/// Reads single values; says what is wrong with them. The same for all structs.
class ValueReader {
 public:
  struct Limits {
    std::string_view unit;
    double lowest, highest;
    std::string_view meaning;
  };

  ValueReader(const Source& source, const Node& map, Problems& problems, const ReadContext& context = {})
      : source_(source),
        map_(map),
        problems_(problems),
        context_(context),
        errors_before_(problems.errors()) {}

  bool is_map();
  /// The value under `key`, noted as known. Null if absent, or left empty, which is a problem.
  const Node* take(std::string_view key);
  void require(std::string_view key, std::string_view meaning);
  void check_unknown(std::span<const std::string_view> also_allowed);
  bool clean() const { return problems_.errors() == errors_before_; }
  /// Keys of a part that is not there say nothing.
  void check_there(std::string_view by);
  /// Of an effect: keys of other laws do nothing; one that is absent says so.
  void check_law(std::string_view effect, std::span<const plant::Variant> laws, std::string_view chosen,
                 bool absent);
  /// A rule that is broken: shown at the key's value, or at the whole map. Of values that it names and that
  /// are not written there it says what they are, and whose.
  void broken_rule(std::string_view key, std::string_view message);

 protected:
  void quantity(std::string_view key, const Node& node, double& value, const Limits& limits);
  /// Of the widest integers: signed, unsigned.
  template <class T>
  void integer(std::string_view key, const Node& node, T& value, T lowest, T highest,
               std::string_view meaning);
  void boolean(std::string_view key, const Node& node, bool& value);
  void text(std::string_view key, const Node& node, std::string& value);
  void height(std::string_view key, const Node& node, controllers::Height& value);
  /// Index of the spelling among `choices`.
  std::optional<std::size_t> choice(std::string_view key, const Node& node,
                                    std::span<const std::string_view> choices);
  /// Index of `kind` of a map among `kinds`.
  std::optional<std::size_t> kind(std::string_view key, const Node& node,
                                  std::span<const std::string_view> kinds);
  bool is_list(std::string_view key, const Node& node);
  void not_written(std::string_view key, double value, std::string_view unit) {
    not_written_.push_back({key, value, unit});
  }

  const Source& source_;
  const Node& map_;
  Problems& problems_;
  ReadContext context_;

 private:
  /// Notes how well a value is known, or that nothing is said of it. Throws BadQuantity.
  void spread(std::string_view key, std::optional<std::string_view> said, double value,
              std::string_view unit);
  bool is_scalar(std::string_view key, const Node& node, std::string_view wanted);
  void bad(const Node& node, std::string message) {
    problems_.error(source_, node.place, std::move(message));
  }

  struct NotWritten {
    std::string_view key;
    double value;
    std::string_view unit;
  };
  std::vector<std::string_view> known_;
  std::vector<NotWritten> not_written_;
  bool is_unknown_kind_ = false;  ///< so nobody knows which keys it has
  std::size_t errors_before_;
};

/// The visitor of a field list.
class StructReader : public ValueReader {
 public:
  using ValueReader::ValueReader;

  template <class... Rest>
  void required(std::string_view key, Rest&&... rest) {
    require(key, std::get<sizeof...(rest) - 1>(std::tie(rest...)));
    (*this)(key, std::forward<Rest>(rest)...);
  }

  /// Quantities: one, one that may be absent, or a list.
  template <class T>
  void operator()(std::string_view key, T& value, std::string_view unit, double lowest, double highest,
                  std::string_view meaning) {
    const Node* node = take(key);
    if constexpr (std::same_as<T, double>)
      if (node == nullptr) not_written(key, value, unit);
    if (node == nullptr) return;
    const auto [least, most] = in_unit(context_.commands, unit, plant::Limits{lowest, highest});
    const std::string named = in_unit(context_.commands, unit);
    const Limits limits{named, least, most, meaning};
    if constexpr (std::same_as<T, double>) {
      quantity(key, *node, value, limits);
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      quantity(key, *node, value.emplace(), limits);
    } else {
      static_assert(std::same_as<T, std::vector<double>>);
      if (!is_list(key, *node)) return;
      value.assign(node->children.size(), 0.0);
      for (std::size_t i = 0; i < value.size(); ++i) quantity(key, node->children[i], value[i], limits);
    }
  }

  /// Whole numbers.
  template <std::integral T>
  void operator()(std::string_view key, T& value, std::type_identity_t<T> lowest,
                  std::type_identity_t<T> highest, std::string_view meaning) {
    const Node* node = take(key);
    if (node == nullptr) return;
    using Wide = std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>;
    Wide wide = value;
    integer<Wide>(key, *node, wide, lowest, highest, meaning);
    value = static_cast<T>(wide);
  }

  /// Everything without unit and range. Of a rig all that follows has its unit of commands.
  template <class T>
  void operator()(std::string_view key, T& value, std::string_view) {
    if (const Node* node = take(key)) read(key, *node, value, std::string(key));
    if constexpr (requires { value.command_unit(); }) context_.commands = value.command_unit();
  }

 private:
  /// `path`: the key, in a list with the element's number.
  template <class T>
  void read(std::string_view key, const Node& node, T& value, const std::string& path) {
    if constexpr (std::same_as<T, bool>) {
      boolean(key, node, value);
    } else if constexpr (std::same_as<T, std::string>) {
      text(key, node, value);
    } else if constexpr (std::same_as<T, controllers::Height>) {
      height(key, node, value);
    } else if constexpr (Measured<T>) {
      quantity(key, node, value.value, {T::unit, T::lowest, T::highest, T::meaning});
    } else if constexpr (is_optional<T>) {
      read(key, node, value.emplace(), path);
    } else if constexpr (Named<T>) {
      if (const auto index = choice(key, node, spellings<T>())) value = names(T{})[*index].first;
    } else if constexpr (is_vector<T>) {
      if (!is_list(key, node)) return;
      value.assign(node.children.size(), {});
      for (std::size_t i = 0; i < value.size(); ++i)
        read(key, node.children[i], value[i], std::string(key) + '.' + std::to_string(i));
    } else if constexpr (is_variant<T>) {
      if (const auto index = kind(key, node, kinds<T>)) read_alternative(node, value, *index, path);
    } else if constexpr (std::same_as<T, domain::RowFilter>) {
      if (ValueReader(source_, node, problems_).is_map())
        for (const Node& each : node.children) text(each.key, each, value.cells[each.key]);
    } else if constexpr (std::same_as<T, domain::Variation>) {
      // Read once the rig is known whose numbers it names (variation_file.hpp).
    } else if constexpr (std::same_as<T, plant::Sensors>) {
      if (is_list(key, node)) read_sensors(source_, node, value, problems_, context_.below(path));
    } else if constexpr (NamedStruct<T>) {
      read_named(source_, node, value, problems_);  // stands beside the reader of T
    } else {
      read_struct(source_, node, value, problems_, {}, context_.below(path));
    }
  }

  /// Makes `value` hold the alternative of that index and reads it.
  template <std::size_t I = 0, class... Ts>
  void read_alternative(const Node& node, std::variant<Ts...>& value, std::size_t index,
                        const std::string& path) {
    if constexpr (I < sizeof...(Ts)) {
      if (index != I) return read_alternative<I + 1>(node, value, index, path);
      if (value.index() != I) value.template emplace<I>();
      constexpr std::string_view also_allowed[] = {"kind"};
      read_struct(source_, node, std::get<I>(value), problems_, also_allowed, context_.below(path));
    }
  }
};

/// The law that an effect has now.
template <class Effect>
std::string_view law_of(const Effect& effect) {
  if constexpr (requires { effect.variant; }) return name_of(effect.variant);
  return Effect::variants.empty() ? std::string_view() : Effect::variants.front().name;
}

template <Listed T>
void read_struct(const Source& source, const Node& node, T& into, Problems& problems,
                 std::span<const std::string_view> also_allowed, const ReadContext& context) {
  StructReader reader(source, node, problems, context);
  if (!reader.is_map()) return;
  T::fields(into, reader);
  reader.check_unknown(also_allowed);
  if constexpr (requires { T::there_by; })
    if (into.absent()) reader.check_there(T::there_by);
  if constexpr (requires { T::variants; })
    if (reader.clean()) reader.check_law(T::name, T::variants, law_of(into), into.absent());
  if constexpr (Resolved<T>) into.resolve();
  if constexpr (Ruled<T>) {
    const auto report = [&](std::string_view key, std::string_view message) {
      reader.broken_rule(key, message);
    };
    if (reader.clean()) into.rules(report);
  }
}

}  // namespace mckibben::input
