// Commands that were recorded as a share of the valve's range, or as a duty; see columns.hpp.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {
namespace {

constexpr double percent = 100.0, eight_bits = 255.0;

/// What shares are of a valve's commands. Of two valves that are open or shut they go from -1, venting, to 1.
struct Share {
  explicit Share(const plant::Valve& valve)
      : two(valve.is_on_off() && valve.ports == plant::Ports::two),
        unit(name_of(valve.command_unit)),
        of_whole((valve.span_command - valve.zero_command) / (two ? 2.0 : 1.0)),
        at_0(valve.zero_command + (two ? of_whole : 0.0)) {}

  std::string factor(double whole) const { return fmt::format("{:.12g}", of_whole / whole); }
  std::string zero(double whole) const { return fmt::format("{:.12g}", 0.0 - at_0 * whole / of_whole); }
  /// What to write if that is the whole.
  std::string line(double whole) const {
    return fmt::format("unit: {}, zero: {}, factor: {}", unit, zero(whole), factor(whole));
  }
  std::string either() const {
    return fmt::format("if {} is the whole, {}; if {}, {}", percent, line(percent), eight_bits,
                       line(eight_bits));
  }
  /// If the command at 0 is where they vent, and half of the whole shuts both.
  std::string line_from_venting(double whole) const {
    const double factor = 2.0 * of_whole / whole;
    return fmt::format("unit: {}, zero: {:.12g}, factor: {:.12g}", unit, 0.0 - (at_0 - of_whole) / factor,
                       factor);
  }

  bool two;
  std::string unit;
  double of_whole, at_0;  ///< commands
};

/// Whether pressure or muscle go both ways while the command stays above 0, so that something vents there.
bool vents_above_0(const std::string& command, const std::vector<const UnknownTable*>& tables) {
  constexpr double windows = 100.0, both = 0.3;
  double up = 0.0, down = 0.0;
  for (const UnknownTable* table : tables) {
    const Values* commands = column_of(*table, command);
    if (commands == nullptr) return false;
    const auto rows =
        std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(commands->size()) / windows));
    for (const UnknownColumn& column : table->columns) {
      const domain::Quantity* quantity = heading_of(column).quantity;
      if (quantity == nullptr || (quantity->key != "muscle_pressure" && quantity->key != "contraction"))
        continue;
      const Range range = range_of(column.values);
      for (std::size_t k = 0; k + rows < std::min(commands->size(), column.values.size()); k += rows) {
        const auto at = commands->begin() + static_cast<std::ptrdiff_t>(k);
        const double moves = column.values[k + rows] - column.values[k];
        if (!std::all_of(at, at + static_cast<std::ptrdiff_t>(rows), [](double one) { return one > 0.0; }) ||
            !std::isfinite(moves) || range.high <= range.low)
          continue;
        (moves > 0.0 ? up : down) += std::abs(moves) / (range.high - range.low);
      }
    }
  }
  return std::min(up, down) > both * std::max(up, down);
}

constexpr const char* as_one_column =
    "where one fills and the other vents, write into the tables one column duty of both, filling less "
    "venting";

}  // namespace

std::string of_two(const domain::Quantity& quantity, bool duties) {
  if (quantity.is_command() && duties) return fmt::format("; {}, and name it here", as_one_column);
  if (quantity.key == "muscle_pressure" || quantity.is_command())
    return fmt::format("; of two muscles write {0}_1 and {0}_2, and angle", quantity.key);
  return "";
}

void unit_of_either_duty(ColumnGuess& command, const KnownRig& rig) {
  if (rig.valve && rig.valve->is_on_off())
    command.unit =
        left_open("the unit of the column that you write; of a duty, " + Share(*rig.valve).either());
}

std::vector<Setting> valve_of_duties(const MapGuess& map, const UnknownTable& table) {
  const ColumnGuess* command = map.find("command");
  if (command == nullptr || !command->unit.open()) return {};
  const auto is_duty = [&](const UnknownColumn& column) {
    return (command->column.open() || column.name == command->column.value) && heading_of(column).is_duty;
  };
  if (std::ranges::none_of(table.columns, is_duty)) return {};
  return {{"valve.kind", {"on_off", "a duty commands valves that are open or shut"}},
          {"valve.ports", left_open("2/2: one fills, one vents; 3/2: one does either")},
          {"valve.switching", left_open("pwm, and its pwm_frequency; or averaged")},
          {"valve.zero_command", {"0 V", "it may be any: venting all the time, of 3/2 no duty"}},
          {"valve.span_command",
           {"10 V",
            "filling all the time; with these numbers `import --rig` finds the "
            "command's unit, zero and factor"}},
          {"valve.supply_pressure", left_open("gauge pressure of the supply")}};
}

void command_of_share(ColumnGuess& command, const Heading& heading,
                      const std::vector<const UnknownTable*>& tables, const KnownRig& rig) {
  if (command.column.open() || !command.unit.open() || command.factor) return;
  const bool no_unit = heading.unit.empty() && heading.unknown.empty() && heading.other_unit.empty();
  if (heading.unit != "%" && !(heading.is_duty && heading.unit.empty())) {
    if (rig.valve && !rig.valve->seals() && no_unit)
      command.unit = left_open(
          fmt::format("the table says no unit: write {}, as the rig's valve takes it, with zero and factor{}",
                      name_of(rig.valve->command_unit),
                      rig.valve->is_on_off() ? "; of a duty, " + Share(*rig.valve).either() : ""));
    return;
  }
  if (!rig.valve || rig.valve->seals() || (heading.is_duty && !rig.valve->is_on_off())) {
    command.unit =
        left_open(heading.is_duty ? "a duty; with --rig, of a rig whose valve is on_off, it is found"
                                  : "a share of the valve's range: with --rig it is found");
    return;
  }
  const auto readings = readings_of(tables, command.column.value);
  if (!readings) return;
  const double low = std::min(readings->range.low, 0.0);
  const double most = std::max(readings->range.high, -low);
  const Share share(*rig.valve);
  if (heading.unit != "%" && ((most > 1.0 && most <= percent) || most > eight_bits)) {
    command.unit = left_open(fmt::format("its numbers go to {:g}: {}", most, share.either()));
    return;
  }
  const double whole = heading.unit == "%" ? percent : most <= 1.0 ? 1.0 : eight_bits;
  if (share.two && low >= 0.0 && vents_above_0(command.column.value, tables)) {
    command.unit = left_open(fmt::format(
        "its numbers stay above 0, and yet the muscle goes both ways: if {:g} shuts both valves and "
        "less vents, {}; if 0 does, {}, and {}",
        0.5 * whole, share.line_from_venting(whole), share.line(whole), as_one_column));
    return;
  }
  const bool edges = rig.valve->switching == plant::Switching::edges;
  const std::string reason =
      fmt::format("{} is the rig's whole {}{}{}", whole, heading.is_duty ? "duty" : "range",
                  !share.two  ? ""
                  : low < 0.0 ? edges ? ": it fills above a third of that, and vents below minus a third"
                                      : ": it fills above 0, vents below"
                              : fmt::format(": it fills above {} and nothing vents; {}",
                                            edges ? "a third of that" : "0", as_one_column),
                  edges && rig.valve->is_on_off() && heading.is_duty
                      ? "; for duties write switching: pwm or averaged in the rig, which has edges"
                      : "");
  command.unit = {share.unit, "the rig's valve takes it"};
  command.factor = {share.factor(whole), reason};
  if (share.at_0 != 0.0) command.zero = {share.zero(whole), "what stands for 0 " + share.unit};
}

}  // namespace mckibben::recognise
