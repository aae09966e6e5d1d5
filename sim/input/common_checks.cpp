// Checks shared by the readers of scenarios and campaigns; see the header.
#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include <sim/domain/rig_number.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/current_checks.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {

void check_duration(const YamlFile& file, double duration_s, const plant::Rig& rig, Problems& problems) {
  constexpr double most_ticks = 1e6;
  const double ticks = duration_s / rig.tick_s;
  const Node& node = *file.root.find("duration");
  if (ticks < 1.0 - 1e-9 || ticks > most_ticks)
    problems.error(
        file.source, node.place,
        fmt::format("duration = {}: with the rig's tick of {} that is {:.4g} ticks; a run has 1 to {:g}",
                    node.text, write_quantity(rig.tick_s, "s"), ticks, most_ticks));
}

std::string no_load(const plant::Rig& rig) {
  if (rig.lifts_a_load()) return "";
  return rig.pair() != nullptr ? "the rig's two muscles turn a link, no load hangs there; see "
                                 "docs/two_muscles.md for what a pair can do"
                               : "the rig's muscle is held at a length, no load hangs there; see "
                                 "docs/two_muscles.md for what can be "
                                 "done with it";
}

void check_lifts_a_load(const YamlFile& file, const plant::Rig& rig, Problems& problems) {
  const Node* given = file.root.find("rig");
  if (const std::string why = no_load(rig); !why.empty())
    problems.error(file.source, given != nullptr ? given->place : file.root.place, "rig: " + why);
}

void require_load(const plant::Rig& rig, const std::string& file, std::string_view verb) {
  std::string why = no_load(rig);
  if (why.empty() && rig.lever() != nullptr)
    why = "the rig's muscle turns a lever, and this verb needs a load's height; see docs/lever.md";
  if (!why.empty())
    throw BadInput(
        {{Severity::error, file, nowhere, fmt::format("{} cannot take it yet: {}", verb, why), ""}});
}

std::string no_mass(const plant::Rig& rig) {
  if (rig.joint.load_offset_kg != 0.0)
    return fmt::format("with the rig's joint.load_offset of {} no load is left",
                       write_quantity(rig.joint.load_offset_kg, "kg"));
  return "without a load nothing moves: give joint.moving_mass, or wheel_inertia, of the rig";
}

void check_name(const YamlFile& file, const std::string& name, Problems& problems) {
  const Node* given = file.root.find("name");
  if (given != nullptr && !is_file_safe(name))
    problems.error(file.source, given->place, fmt::format("name = {}: {}", name, file_safe_rule));
}

void check_different(const std::vector<double>& loads_kg, const Node& nodes, const Source& source,
                     Problems& problems) {
  std::set<double> earlier;
  for (std::size_t i = 0; i < loads_kg.size(); ++i)
    if (!earlier.insert(loads_kg[i]).second)
      problems.error(source, nodes.children[i].place,
                     fmt::format("loads: {} stands in the list already", nodes.children[i].text));
}

void check_has_gauge(const Source& source, const Node& node, std::string_view what, const plant::Rig& rig,
                     Problems& problems) {
  if (rig.sensors.of(plant::Sensed::muscle_pressure) == nullptr)
    problems.warning(source, node.place,
                     fmt::format("{} has no effect: the rig has no gauge (sensors: [{{signal: "
                                 "muscle_pressure, kind: gauge}}])",
                                 what));
}

void check_gauge_error(const YamlFile& file, const plant::Rig& rig, Problems& problems) {
  const auto errs = [](const plant::Rig& one) { return !one.effects.get<plant::GaugeError>().absent(); };
  const Node* const node = file.root.find("rig");
  if (errs(rig) || (rig.pair() != nullptr && errs(plant::opposite_rig(rig))))
    check_has_gauge(file.source, node == nullptr ? file.root : *node, "effects.gauge_error", rig, problems);
}

/// Of a usual load: g are written for kg.
constexpr double hardly_anything = 1.0 / 200.0;

void check_loads(const YamlFile& file, const std::vector<double>& loads_kg, const plant::Rig& rig,
                 Problems& problems) {
  const Node& nodes = *file.root.find("loads");
  if (loads_kg.empty()) problems.error(file.source, nodes.place, "loads: at least one load is needed");
  check_different(loads_kg, nodes, file.source, problems);
  for (std::size_t i = 0; i < loads_kg.size(); ++i) {
    const Node& node = nodes.children[i];
    if (!rig.can_hang(loads_kg[i]))
      problems.error(file.source, node.place, fmt::format("loads: {}: {}", node.text, no_mass(rig)));
    else if (const auto why = domain::too_heavy(loads_kg[i], rig, loads_kg); !why.empty())
      problems.error(file.source, node.place, fmt::format("loads: {}: {}", node.text, why));
    else if (const auto never =
                 domain::never_lifted(loads_kg[i], rig, domain::most_pressure_Pa(rig), loads_kg);
             !rig.has_angle() && !never.empty())
      problems.warning(file.source, node.place, fmt::format("loads: {} is {}", node.text, never));
    else if (loads_kg[i] > 0.0 && loads_kg[i] < hardly_anything * domain::usual_load_kg(rig))
      problems.warning(
          file.source, node.place,
          fmt::format("loads: {} is next to nothing for this muscle, which usually lifts {:g} kg: "
                      "is the unit right?",
                      node.text, domain::usual_load_kg(rig)));
  }
}

void load_recording(controllers::RecordedCurrent& recorded, const Source& source, const Node& node,
                    const plant::Rig& rig, Problems& problems) {
  const std::string ours = plant::Channel{&plant::command_of(rig.command_unit())}.name();
  if (recorded.column == controllers::RecordedCurrent{}.column) recorded.column = ours;
  read_other(source, node, problems, [&] {
    const Source table_source =
        Source::load((source.folder() / recorded.file).lexically_normal(), most_text_bytes);
    problems.opened(table_source);
    const std::string_view required[] = {"time_s", recorded.column};
    TableProblems found(table_source, problems);
    const Table table = read_table(table_source, required, {}, found);
    const Table::Column* current = table.find(recorded.column);
    if (current == nullptr) return;
    check_ticks(table, rig.tick_s, found);
    check_range(table, *current, rig.dac.lowest_command, rig.dac.largest_command, "range of the rig's DAC",
                found);
    recorded.samples_mA = current->values;
  });
}

void complete_current(domain::CampaignWaveform& waveform, const Source& source, const Node& node,
                      const plant::Rig& rig, Problems& problems) {
  if (auto* recorded = std::get_if<controllers::RecordedCurrent>(&waveform))
    load_recording(*recorded, source, *node.find("file"), rig, problems);
  auto settings = controllers::settings_as<controllers::Settings>(waveform);
  follow_valve(settings, source, node, rig, problems);
  waveform = controllers::settings_as<domain::CampaignWaveform>(settings);
}

}  // namespace mckibben::input
