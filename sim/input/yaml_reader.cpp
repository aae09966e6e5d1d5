// Single values and their messages: each names key, value and rule; see the header.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include <sim/domain/fill_in.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/renamed.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

/// A plain whole number without leading zeros.
template <class T>
std::optional<T> parse_integer(const Node& node) {
  const std::string_view text = node.text;
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (node.quoted || (digits.size() > 1 && digits.front() == '0')) return std::nullopt;
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// As a whole word.
bool names_key(std::string_view message, std::string_view key) {
  const auto is_part = [&](std::size_t at) {
    return at < message.size() &&
           (std::isalnum(static_cast<unsigned char>(message[at])) != 0 || message[at] == '_');
  };
  for (std::size_t at = message.find(key); at != std::string_view::npos; at = message.find(key, at + 1))
    if (!is_part(at - 1) && !is_part(at + key.size())) return true;
  return false;
}

}  // namespace

bool ValueReader::is_map() {
  if (map_.kind == Node::Kind::map) return true;
  bad(map_, fmt::format("{} must be a map of keys, not {}", map_.key.empty() ? "this" : map_.key,
                        map_.kind_name()));
  return false;
}

const Node* ValueReader::take(std::string_view key) {
  known_.push_back(key);
  const Node* node = map_.find(key);
  if (node == nullptr) return nullptr;
  if (node->text == domain::fill_in)
    bad(*node, fmt::format("{} = {}: the recorded data do not contain it; write its value", key, node->text));
  else if (node->kind == Node::Kind::null)
    bad(*node, fmt::format("{} has no value", key));
  else
    return node;
  return nullptr;
}

void ValueReader::require(std::string_view key, std::string_view meaning) {
  if (map_.find(key) == nullptr) bad(map_, fmt::format("the key {} is missing: {}", key, meaning));
}

void ValueReader::check_unknown(std::span<const std::string_view> also_allowed) {
  if (is_unknown_kind_) return;
  std::vector<std::string_view> allowed(also_allowed.begin(), also_allowed.end());
  allowed.insert(allowed.end(), known_.begin(), known_.end());
  for (const Node& child : map_.children) {
    const std::string_view today = domain::name_today(child.key);
    if (std::ranges::find(allowed, today) != allowed.end() &&
        (child.key == today || map_.find(today) == &child))  // not beside the key of today
      continue;
    // `0,05` in a map in one line: YAML takes the rest of the number for a key.
    const bool cut_number = child.kind == Node::Kind::null && child.key.find_first_of("0123456789") == 0;
    problems_.unknown_key(source_, child.key_place, child.key,
                          fmt::format("unknown key {}{} (allowed: {})", shortened(child.key),
                                      cut_number ? "; decimals are written with a point, as in 0.05"
                                                 : did_you_mean(child.key, allowed),
                                      join(allowed)));
  }
  if (!map_.children.empty() && map_.children.front().key_place.column == 1)
    problems_.known_at_top(source_, known_);
}

void ValueReader::check_there(std::string_view by) {
  if (map_.find(by) == nullptr && !map_.children.empty())
    broken_rule(map_.children.front().key, fmt::format("says nothing without {}: give that, too", by));
}

void ValueReader::check_law(std::string_view effect, std::span<const plant::Variant> laws,
                            std::string_view chosen, bool absent) {
  const auto law = std::ranges::find(laws, chosen, &plant::Variant::name);
  if (law == laws.end()) return;
  const auto uses = [&](const plant::Variant& one, std::string_view key) {
    const auto base = std::ranges::find(laws, one.adds_to, &plant::Variant::name);
    return one.amplitude == key || (base != laws.end() && !one.adds_to.empty() && base->amplitude == key);
  };
  for (const plant::Variant& other : laws) {  // what is only theirs does nothing
    const Node* node = map_.find(other.amplitude);
    if (node == nullptr || uses(*law, other.amplitude) ||
        std::strtod(node->text.c_str(), nullptr) == other.absent)
      continue;
    std::string names;
    for (const plant::Variant& one : laws)
      if (uses(one, other.amplitude)) names += (names.empty() ? "" : " or ") + std::string(one.name);
    if (absent && map_.find("variant") == nullptr)
      return bad(map_,
                 fmt::format("the key variant is missing: {} is of variant {}", other.amplitude, names));
    problems_.warning(source_, node->place,
                      fmt::format("{} = {} does nothing: it is of variant {}, and this is {}",
                                  other.amplitude, shortened(node->text), names, chosen));
  }
  if (absent)
    require(law->amplitude,
            fmt::format("without it {0} does nothing; `mckibben effects {0}` shows an example", effect));
}

void ValueReader::broken_rule(std::string_view key, std::string_view message) {
  const Node* node = map_.find(key);
  const bool has_text = node != nullptr && node->kind == Node::Kind::scalar;
  std::string others;
  for (const auto& [other, value, unit] : not_written_)
    if (other == key || names_key(message, other))
      others += fmt::format("{}{} = {}", others.empty() ? "" : ", ", other,
                            unit == "1" ? domain::write_number(value)
                                        : usual_quantity(value, in_unit(context_.commands, unit)));
  if (!others.empty())
    others = fmt::format(" ({}, {})", others,
                         context_.base.empty() ? "by default" : "of the base " + shortened(context_.base));
  bad(node != nullptr ? *node : map_,
      fmt::format("{}{}: {}{}", key, has_text ? " = " + shortened(node->text) : "", message, others));
}

bool ValueReader::is_scalar(std::string_view key, const Node& node, std::string_view wanted) {
  if (node.kind == Node::Kind::scalar) return true;
  bad(node, fmt::format("{} must be {}, not {}", key, wanted, node.kind_name()));
  return false;
}

bool ValueReader::is_list(std::string_view key, const Node& node) {
  if (node.kind == Node::Kind::list) return true;
  std::string items = node.text;
  for (const Node& child : node.children) items += (items.empty() ? "{" : ", ") + child.key + ": ...";
  if (node.kind == Node::Kind::map) items += '}';
  bad(node, node.kind == Node::Kind::null ? fmt::format("{} must be a list, not {}", key, node.kind_name())
                                          : fmt::format("{} must be a list: [{}]", key, shortened(items)));
  return false;
}

void ValueReader::spread(std::string_view key, std::optional<std::string_view> said, double value,
                         std::string_view unit) {
  if (context_.list == nullptr) {
    if (!said) return;
    throw BadQuantity(
        fmt::format("± {}: only values of a rig may say how well they are known", shortened(*said)));
  }
  const std::string path = context_.inside + std::string(key);
  context_.list->erase(path);  // what a base says is of the base's value
  if (said) context_.list->emplace(path, read_spread(*said, value, unit));
}

void ValueReader::quantity(std::string_view key, const Node& node, double& value, const Limits& limits) {
  const Usual usual{std::isfinite(value) ? value : 0.0, limits.lowest, limits.highest};
  const std::string unit = limits.unit == "1" ? "" : fmt::format(" in {}", limits.unit);
  const std::string example =
      usual.value == 0.0 ? unit : ", for example " + usual_quantity(usual.value, limits.unit);
  if (!is_scalar(key, node, "one value" + example)) return;
  try {
    const WithSpread said = split_spread(node.text);
    const double read = read_quantity(said.value, limits.unit, usual);
    if (read >= limits.lowest && read <= limits.highest) {
      value = read;
      return spread(key, said.spread, read, limits.unit);
    }
    // Where nothing is usual only a mass's number tells its unit: 10200 kg.
    const std::string meant =
        usual.value == 0.0 && limits.unit != "kg" ? "" : meant_quantity(said.value, limits.unit, usual);
    bad(node, fmt::format("{} = {} is out of range: {} to {} ({}){}", key, shortened(node.text),
                          show_limit(limits.lowest, limits.unit, said.value),
                          show_limit(limits.highest, limits.unit, said.value), limits.meaning,
                          meant.empty() ? "" : fmt::format("; is {} meant?", meant)));
  } catch (const BadQuantity& error) {
    bad(node, fmt::format("{} = {} ({})", key, error.what(), limits.meaning));
  }
}

template <class T>
void ValueReader::integer(std::string_view key, const Node& node, T& value, T lowest, T highest,
                          std::string_view meaning) {
  if (!is_scalar(key, node, "a whole number")) return;
  const auto read = parse_integer<T>(node);
  if (read && *read >= lowest && *read <= highest)
    value = *read;
  else
    bad(node, fmt::format("{} = {} must be a whole number from {} to {}{} ({})", key, shortened(node.text),
                          lowest, highest, node.quoted ? ", without quotes" : "", meaning));
}
template void ValueReader::integer(std::string_view, const Node&, std::int64_t&, std::int64_t, std::int64_t,
                                   std::string_view);
template void ValueReader::integer(std::string_view, const Node&, std::uint64_t&, std::uint64_t,
                                   std::uint64_t, std::string_view);

void ValueReader::boolean(std::string_view key, const Node& node, bool& value) {
  if (!is_scalar(key, node, "true or false")) return;
  if (!node.quoted && (node.text == "true" || node.text == "false"))
    value = node.text == "true";
  else
    bad(node, fmt::format("{} = {} must be true or false{}", key, shortened(node.text),
                          node.quoted ? ", without quotes" : ""));
}

void ValueReader::text(std::string_view key, const Node& node, std::string& value) {
  if (is_scalar(key, node, "a text")) value = node.text;
}

void ValueReader::height(std::string_view key, const Node& node, controllers::Height& value) {
  constexpr double usual_m = 0.03;
  if (!is_scalar(key, node, "a contraction ratio or a length, for example 0.1 or 30 mm")) return;
  try {
    const std::string_view whole = trimmed(node.text);
    const bool is_ratio = number_length(whole) == whole.size() || whole.ends_with('%');
    const double read = read_quantity(whole, is_ratio ? "1" : "m", {usual_m});
    if (!std::isfinite(read)) throw BadQuantity(shortened(node.text) + " is too large");
    value = {read, !is_ratio};
  } catch (const BadQuantity& error) {
    bad(node, fmt::format("{} = {} (or a contraction ratio, without a unit)", key, error.what()));
  }
}

std::optional<std::size_t> ValueReader::choice(std::string_view key, const Node& node,
                                               std::span<const std::string_view> choices) {
  if (!is_scalar(key, node, "one of: " + join(choices))) return std::nullopt;
  const auto found = std::find(choices.begin(), choices.end(), node.text);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  is_unknown_kind_ = is_unknown_kind_ || key == "kind";
  bad(node, fmt::format("{} = {} is not one of: {}{}", key, shortened(node.text), join(choices),
                        did_you_mean(node.text, choices)));
  return std::nullopt;
}

std::optional<std::size_t> ValueReader::kind(std::string_view key, const Node& node,
                                             std::span<const std::string_view> kinds) {
  if (node.kind != Node::Kind::map) {
    bad(node, fmt::format("{} must be a map of keys with its kind, not {}", key, node.kind_name()));
    return std::nullopt;
  }
  const Node* given = node.find("kind");
  if (given == nullptr) {
    bad(node, fmt::format("the key kind is missing in {}; it is one of: {}", key, join(kinds)));
    return std::nullopt;
  }
  return choice("kind", *given, kinds);
}

namespace {

/// Which verbs take a file of that kind, to hang on a message.
std::string taken_by(std::string_view schema) {
  static constexpr std::pair<std::string_view, std::string_view> kinds[] = {
      {"scenario", "a scenario is for `run`, `control` or `linearise`"},
      {"pair", "a scenario of a pair is for `run`, `control` or `linearise`"},
      {"campaign", "a campaign is for `dataset`"},
      {"dataset", "a data set is for `replay`, `diagnose` or `calibrate`"},
      {"calibration", "a calibration is for `map`"},
      {"hypothesis", "a hypothesis is for `diagnose --hypothesis`"},
      {"rig", "a rig is for `live`, `linearise` or `fmu`; scenarios and campaigns name it: `rig: FILE`"}};
  for (const auto& [kind, what] : kinds)
    if (schema.starts_with(fmt::format("mckibben-{}/", kind))) return fmt::format("; {}", what);
  return "";
}

}  // namespace

bool begin_file(const YamlFile& file, std::string_view schema, Problems& problems) {
  problems.opened(file.source);
  problems.adopt(file.found);
  const Node* given = file.root.find("schema");
  if (given == nullptr) {
    problems.error(file.source, file.root.place,
                   fmt::format("the key schema is missing; the file should begin with `schema: {}`", schema));
    return true;
  }
  if (given->kind == Node::Kind::scalar && given->text == schema) return true;
  const std::string found =
      given->kind == Node::Kind::scalar ? shortened(given->text) : std::string(given->kind_name());
  const bool other_kind = found.substr(0, found.find('/')) != schema.substr(0, schema.find('/'));
  problems.error(file.source, given->place,
                 fmt::format("schema = {} is not what is read here: {}{}", found, schema,
                             other_kind ? taken_by(found) : ""));
  return false;
}

}  // namespace mckibben::input
