// Rigs by name, path and change; see the header. Bases are followed to a shipped rig; a chain that comes back
// to a file it has passed is an error.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/geometry.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/renamed.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/muscles.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/sensors_file.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> shipped{
    "thesis", "thesis_pair", "festo_dmsp_5", "festo_dmsp_10", "festo_dmsp_20", "festo_dmsp_40", "home_made"};

bool looks_like_path(std::string_view text) {
  return text.find_first_of("/.") != std::string_view::npos;
}

/// Files being read, outermost first.
using Chain = std::vector<fs::path>;

void read_changes(const Source& source, const Node& map, Rig& into, Problems& problems, Chain& chain,
                  std::span<const std::string_view> also_allowed);

void read_rig_map(const YamlFile& file, Rig& into, Problems& problems, Chain& chain) {
  constexpr std::string_view also_allowed[] = {"schema", "base"};
  if (begin_file(file, rig_schema, problems))
    read_changes(file.source, file.root, into, problems, chain, also_allowed);
}

/// A stop that no file writes follows the muscle: it bears what the muscle lifts at the valve's largest
/// pressure, and is never softer than the thesis's. Until all files of a rig are read it is `unwritten`.
constexpr double unwritten = 0.0;

void forget_stops(Rig& rig) {
  rig.muscle.stop_stiffness_N_per_m = unwritten;
  if (plant::Pair* pair = rig.pair()) pair->opposite.muscle.stop_stiffness_N_per_m = unwritten;
}

void follow_muscle(plant::Muscle& muscle, const plant::Valve& valve) {
  if (muscle.stop_stiffness_N_per_m != unwritten) return;
  muscle.stop_stiffness_N_per_m = plant::Muscle{}.stop_stiffness_N_per_m;
  const plant::Braid braid(muscle);
  const double lifts_kg = braid.largest_force_N(valve.span_pressure_Pa) / plant::gravity_m_per_s2;
  const double stiffer = lifts_kg / braid.largest_load_kg();
  if (stiffer > 1.0) muscle.stop_stiffness_N_per_m *= 0.01 * std::ceil(100.0 * stiffer);
}

Rig with_stops(Rig rig) {
  follow_muscle(rig.muscle, rig.valve);
  if (plant::Pair* pair = rig.pair()) follow_muscle(pair->opposite.muscle, pair->opposite.valve);
  return rig;
}

/// The text of a muscle by catalogue; empty of the thesis's rigs, which are built in as they are.
std::string_view catalogue_text(std::string_view name) {
  const std::array<std::pair<std::string_view, std::string_view>, 5> texts{{{"festo_dmsp_5", festo_dmsp_5},
                                                                            {"festo_dmsp_10", festo_dmsp_10},
                                                                            {"festo_dmsp_20", festo_dmsp_20},
                                                                            {"festo_dmsp_40", festo_dmsp_40},
                                                                            {"home_made", home_made}}};
  const auto found =
      std::find_if(texts.begin(), texts.end(), [&](const auto& text) { return text.first == name; });
  return found == texts.end() ? std::string_view{} : found->second;
}

Rig shipped_rig(std::string_view name) {
  Rig rig = name == "thesis_pair" ? plant::thesis_pair() : Rig{};
  forget_stops(rig);
  if (const std::string_view text = catalogue_text(name); !text.empty()) {
    Problems problems;
    Chain chain;
    read_rig_map(parse_yaml(Source(std::string(name), std::string(text), "")), rig, problems, chain);
    problems.raise();
  }
  return rig;
}

void read_file(const Source& source, const Node& node, const fs::path& path, Rig& into, Problems& problems,
               Chain& chain) {
  std::error_code ignored;
  fs::path real = fs::weakly_canonical(path, ignored);
  if (real.empty()) real = path;
  if (std::find(chain.begin(), chain.end(), real) != chain.end()) {
    problems.error(source, node.place, fmt::format("the base {} leads back to itself", shortened(node.text)));
    return;
  }
  chain.push_back(real);
  read_other(source, node, problems, [&] { read_rig_map(load_yaml(path), into, problems, chain); });
  chain.pop_back();
}

void read_reference(const Source& source, const Node& node, Rig& into, Problems& problems, Chain& chain) {
  if (is_shipped(node.text)) {
    into = shipped_rig(node.text);
  } else if (looks_like_path(node.text)) {
    read_file(source, node, (source.folder() / node.text).lexically_normal(), into, problems, chain);
  } else {
    problems.error(
        source, node.place,
        fmt::format("unknown rig {}{} (shipped: {}; or the path of a rig file, such as rigs/mine.yaml)",
                    shortened(node.text), did_you_mean(node.text, shipped), join(shipped)));
  }
}

/// The mechanics that a map goes on from: what it says of the side of muscle 1 holds for muscle 2 as well,
/// until `opposite` says otherwise.
plant::Mechanics with_both_sides(const Source& source, const Node& map, const Rig& base) {
  const Node *said = map.find("mechanics"), *kind = said != nullptr ? said->find("kind") : nullptr;
  const bool pair = kind != nullptr ? kind->text == plant::Pair::kind : base.pair() != nullptr;
  if (!pair) return base.mechanics;
  plant::Pair both;
  if (base.pair() != nullptr)
    both = *base.pair();
  else
    both.opposite = plant::side_of(base);
  Problems of_muscle_1;  // is told of them when its own are read
  read_struct(source, map, both.opposite, of_muscle_1, {}, {base.command_unit()});
  return both;
}

/// A number with one of the units of commands.
std::optional<std::pair<plant::CommandUnit, double>> command_in(const Node* node) {
  for (const plant::CommandUnit unit :
       {plant::CommandUnit::mA, plant::CommandUnit::V, plant::CommandUnit::bar})
    try {
      if (node != nullptr) return {{unit, read_quantity(split_spread(node->text).value, name_of(unit))}};
    } catch (const BadQuantity&) {
    }
  return std::nullopt;
}

/// The pressures of a base belong to its own commands: what it gives at 20 mA it hardly gives at 10 V.
void require_pressures(const Source& source, const Node& valve, const plant::Valve& base,
                       Problems& problems) {
  const Node* kind = valve.find("kind");
  const auto is = [&](plant::ValveKind one) {
    return kind != nullptr ? kind->text == name_of(one) : base.kind == one;
  };
  if (!is(plant::ValveKind::servo) && !is(plant::ValveKind::regulator)) return;
  const auto require = [&](const char* key, const char* command_key, double base_Pa, double base_command,
                           const char* usual, const char* without) {
    const Node& command = *valve.find(command_key);
    if (valve.find(key) != nullptr) return;
    const bool is_pressure = command_in(&command)->first == plant::CommandUnit::bar;
    problems.error(
        source, command.place,
        fmt::format("{} = {}: the key {} is missing, the gauge pressure there: for example {}: {}; "
                    "the base's {} is at {} {}{}",
                    command_key, shortened(command.text), key, key,
                    is_pressure ? split_spread(command.text).value : usual,
                    show_limit(base_Pa, "Pa", "1 bar"), domain::write_number(base_command),
                    name_of(base.command_unit), without));
  };
  require("zero_pressure", "zero_command", base.zero_pressure_Pa, base.zero_command, "0 bar",
          "; a flow valve (5/3) has none: kind: on_off, switching: averaged");
  require("span_pressure", "span_command", base.span_pressure_Pa, base.span_command, "6 bar", "");
}

/// What a valve is commanded in stands behind its zero_command and span_command: both, where the base's is
/// another. All else that a rig measures in that unit is read with it.
void read_command_unit(const Source& source, const Node& map, Rig& into, Problems& problems) {
  const Node* valve = map.find("valve");
  if (valve == nullptr) return;
  const Node *zero = valve->find("zero_command"), *span = valve->find("span_command");
  const auto from = command_in(zero), to = command_in(span);
  if (!from && !to) return;
  const plant::CommandUnit unit = (to ? to : from)->first, old = into.valve.command_unit;
  const bool differ = from && to && from->first != to->first;
  if (unit == old && !differ) return;
  if (zero == nullptr || span == nullptr || differ)
    problems.error(source, (to ? span : zero)->place,
                   "zero_command and span_command are both in V, both in bar, or both in mA");
  else if (from && to)
    require_pressures(source, *valve, into.valve, problems);
  into.valve.command_unit = unit;
  if (!from || !to || to->second <= from->second) return;  // is told of where they are read
  plant::command_in(into, to->first, from->second, to->second);
  into.dac = plant::dac_for(into.valve);
  if (plant::Pair* pair = into.pair()) plant::command_in(pair->opposite, to->first, from->second, to->second);
}

/// Pulses that end before a valve has opened.
void check_pulses(const Source& source, const Node& map, const plant::Valve& valve, Problems& problems) {
  const Node* part = map.find("valve");
  if (part == nullptr || !valve.is_on_off() || valve.switching != plant::Switching::pwm ||
      valve.pwm_frequency_Hz * valve.opening_delay_s < 1.0)
    return;
  const Node* said = part->find("pwm_frequency");
  problems.warning(
      source, (said != nullptr ? said : part)->place,
      fmt::format("a period of pwm_frequency lasts {:.3g} ms, and opening_delay {:.3g} ms: no duty "
                  "below 100 % opens the valve",
                  1e3 / valve.pwm_frequency_Hz, 1e3 * valve.opening_delay_s));
}

void read_changes(const Source& source, const Node& map, Rig& into, Problems& problems, Chain& chain,
                  std::span<const std::string_view> also_allowed) {
  into = {};
  forget_stops(into);
  const Node* base = map.find("base");
  if (base != nullptr) {
    if (base->kind == Node::Kind::scalar)
      read_reference(source, *base, into, problems, chain);
    else
      problems.error(source, base->place,
                     fmt::format("base must be the name or the path of a rig, not {}", base->kind_name()));
  }
  read_command_unit(source, map, into, problems);
  into.mechanics = with_both_sides(source, map, into);
  std::vector<std::string_view> allowed(also_allowed.begin(), also_allowed.end());
  for (const OldSensorKey& old : old_sensor_keys)
    if (map.find(old.key) != nullptr) allowed.push_back(old.key);
  const plant::CommandUnit commands = into.command_unit();
  read_old_sensors(source, map, into.sensors, problems, {commands, &into.spreads, "sensors."});
  read_struct(source, map, into, problems, allowed,
              {commands, &into.spreads, "", base != nullptr ? base->text : ""});
  check_pulses(source, map, into.valve, problems);
}

}  // namespace

std::span<const std::string_view> shipped_rigs() {
  return shipped;
}

bool is_shipped(std::string_view name) {
  return std::ranges::find(shipped, name) != shipped.end();
}

std::string shipped_rig_where(const std::function<bool(const Rig&)>& holds) {
  for (const std::string_view name : shipped)
    if (holds(with_stops(shipped_rig(name)))) return std::string(name);
  return "";
}

void read_named(const Source& source, const Node& node, Rig& into, Problems& problems) {
  Chain chain;
  constexpr std::string_view also_allowed[] = {"base"};
  if (node.kind == Node::Kind::scalar)
    read_reference(source, node, into, problems, chain);
  else if (node.kind == Node::Kind::map)
    read_changes(source, node, into, problems, chain, also_allowed);
  else
    problems.error(source, node.place,
                   fmt::format("rig must be a name, a path or a map of changes, not {}", node.kind_name()));
  into = with_stops(std::move(into));
}

namespace {

/// Adds the keys that rig files write; returns the shipped rig beneath them.
std::string add_written(const Source& source, const Node& node, std::set<std::string>& keys) {
  if (node.kind != Node::Kind::map) {
    if (is_shipped(node.text)) return node.text;
    const YamlFile file = load_yaml((source.folder() / node.text).lexically_normal());
    return add_written(file.source, file.root, keys);
  }
  for (const Node& part : node.children)
    for (const Node& child : part.children)
      keys.insert(part.key + '.' + std::string(domain::name_today(child.key)));
  const Node* base = node.find("base");
  return base == nullptr ? std::string(shipped.front()) : add_written(source, *base, keys);
}

}  // namespace

std::string taken_over(const YamlFile& file, const Rig& rig) {
  const Node* named = file.root.find("rig");
  const Node& root = named != nullptr ? *named : file.root;
  std::set<std::string> written;
  const std::string base = add_written(file.source, root, written);
  std::vector<std::string> unlike;
  for (const auto& [key, deviation] : shipped_rig("home_made").spreads) unlike.push_back(key);
  unlike.emplace_back("valve.conductance");
  if (std::ranges::none_of(
          unlike, [&](const auto& key) { return key.starts_with("muscle.") && written.contains(key); }))
    return "";
  std::erase_if(unlike, [&](const std::string& key) {
    return written.contains(key) || rig.spreads.contains(key) ||
           (rig.valve.seals() && !key.starts_with("muscle.") && !key.starts_with("friction."));
  });
  return unlike.empty() ? "" : fmt::format("{}: {}", base, fmt::join(unlike, ", "));
}

Rig read_base(const Source& source, const Node& node) {
  Rig rig;
  Problems seen;  // when the rig itself was read
  const auto read = [&](const Source& from, const Node& map) {
    if (const Node* base = map.find("base")) read_named(from, *base, rig, seen);
  };
  if (node.kind == Node::Kind::map) {
    read(source, node);
  } else if (is_shipped(node.text)) {
    rig = with_stops(shipped_rig(node.text));
  } else {
    const YamlFile file = load_yaml((source.folder() / node.text).lexically_normal());
    read(file.source, file.root);
  }
  return rig;
}

Rig read_rig(const std::string& name_or_path, std::vector<InputFile>& inputs,
             std::vector<Problem>* warnings) {
  if (is_shipped(name_or_path)) return with_stops(shipped_rig(name_or_path));
  std::error_code ignored;
  if (!looks_like_path(name_or_path) && !fs::exists(name_or_path, ignored))
    throw MissingInput(fmt::format("unknown rig {}{} (shipped: {}; or the path of a rig file)", name_or_path,
                                   did_you_mean(name_or_path, shipped), join(shipped)));
  return read_rig(Source::load(name_or_path, largest_yaml_bytes), inputs, warnings);
}

Rig read_rig(Source source, std::vector<InputFile>& inputs, std::vector<Problem>* warnings) {
  Rig rig;
  Problems problems;
  const YamlFile file = parse_yaml(std::move(source));
  std::error_code ignored;
  Chain chain{fs::weakly_canonical(file.source.name(), ignored)};
  read_rig_map(file, rig, problems, chain);
  problems.raise(inputs, warnings);
  return with_stops(std::move(rig));
}

Json rig_json(const Rig& rig) {
  return file_json(rig_schema, rig);
}

}  // namespace mckibben::input
