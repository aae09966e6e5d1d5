// What a valve is commanded with, as its data sheet gives it: a current, a voltage or a pressure. A rig has
// one such unit, and all that is measured in it is: limits, gains, columns.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <plant/names.hpp>

namespace mckibben::plant {

enum class CommandUnit { mA, V, bar };
constexpr auto names(CommandUnit) {
  using enum CommandUnit;
  return std::array{std::pair{mA, std::string_view{"mA"}}, std::pair{V, std::string_view{"V"}},
                    std::pair{bar, std::string_view{"bar"}}};
}

/// mA where the name is none of these.
constexpr CommandUnit command_unit_of(std::string_view name) {
  return named<CommandUnit>(name).value_or(CommandUnit::mA);
}

/// What is said of currents in mA, as it is of commands in that unit: "s2/mA2" as "s2/V2",
/// "current_travel_mA" as "command_travel_V".
std::string in_unit(CommandUnit unit, std::string_view of_current);

/// A field's limits, which lists give in mA, in that unit. What goes up to 100 mA is a command; anything
/// else a size or a speed, of which 1 V or 1 bar may be a hundredth or a hundred.
struct Limits {
  double lowest, highest;
};
constexpr Limits in_unit(CommandUnit unit, std::string_view field_unit, const Limits& listed) {
  if (unit == CommandUnit::mA || field_unit.find("mA") == std::string_view::npos) return listed;
  if (field_unit == "mA" && listed.highest == 100.0)
    return unit == CommandUnit::V ? Limits{-100.0, 100.0} : Limits{-1.0, 20.0};
  return {listed.lowest * (listed.lowest < 0.0 ? 100.0 : 0.01), listed.highest * 100.0};
}

}  // namespace mckibben::plant
