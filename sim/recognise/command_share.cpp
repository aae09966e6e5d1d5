// Commands that were recorded as a share of the valve's range, or as a duty; see columns.hpp.
#include <algorithm>

#include <fmt/format.h>

#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {

std::string_view of_two(const domain::Quantity& quantity, bool duties) {
  if (quantity.key == "muscle_pressure")
    return "; of two muscles write muscle_pressure_1 and muscle_pressure_2, and angle";
  if (quantity.is_command() && duties)
    return "; where one fills and the other vents, write one column of both: filling less venting";
  return "";
}

void command_of_share(ColumnGuess& command, const Heading& heading,
                      const std::vector<const UnknownTable*>& tables, const KnownRig& rig) {
  if (command.column.open() || !command.unit.open() || command.factor ||
      !(heading.unit == "%" || (heading.is_duty && heading.unit.empty())))
    return;
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
  const plant::Valve& valve = *rig.valve;
  const bool two = valve.is_on_off() && valve.ports == plant::Ports::two;
  const double of_whole = (valve.span_command - valve.zero_command) / (two ? 2.0 : 1.0);
  const double at_0 = valve.zero_command + (two ? of_whole : 0.0);
  const std::string unit(name_of(valve.command_unit));
  const auto factor = [&](double whole) { return fmt::format("{:.12g}", of_whole / whole); };
  const auto zero = [&](double whole) { return fmt::format("{:.12g}", 0.0 - at_0 * whole / of_whole); };
  constexpr double percent = 100.0, eight_bits = 255.0;
  if (heading.unit != "%" && ((most > 1.0 && most <= percent) || most > eight_bits)) {
    command.unit = left_open(fmt::format(
        "its numbers go to {:g}: unit: {}, and if {} is the whole factor: {}, zero: {}; if {}, factor: {}, "
        "zero: {}",
        most, unit, percent, factor(percent), zero(percent), eight_bits, factor(eight_bits),
        zero(eight_bits)));
    return;
  }
  const double whole = heading.unit == "%" ? percent : most <= 1.0 ? 1.0 : eight_bits;
  const std::string reason = fmt::format(
      "{} is the rig's whole {}{}", whole, heading.is_duty ? "duty" : "range",
      !two        ? ""
      : low < 0.0 ? ": it fills above 0, vents below"
                  : ": it fills above 0 and nothing vents; where another column vents, write one of both, "
                    "filling less venting");
  command.unit = {unit, "the rig's valve takes it"};
  command.factor = {factor(whole), reason};
  if (at_0 != 0.0) command.zero = {zero(whole), fmt::format("what stands for 0 {}", unit)};
}

}  // namespace mckibben::recognise
