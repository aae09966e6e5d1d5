// What a valve is commanded with, as its data sheet gives it: a current, a voltage or a pressure.
#pragma once

#include <array>
#include <string_view>

namespace mckibben::plant {

/// An end of the range of commands; absent where none is said.
struct RatedCommand {
  enum class Unit { none, mA, V, bar };

  double value = 0.0;
  Unit unit = Unit::none;

  bool absent() const { return unit == Unit::none; }
};

/// What a command can be measured in, and from where to where.
struct CommandUnit {
  RatedCommand::Unit unit;
  std::string_view name;
  double lowest, highest;
};
inline constexpr std::array<CommandUnit, 3> command_units{{{RatedCommand::Unit::mA, "mA", 0.0, 100.0},
                                                           {RatedCommand::Unit::V, "V", -100.0, 100.0},
                                                           {RatedCommand::Unit::bar, "bar", -1.0, 20.0}}};

/// Empty for a command that is absent.
constexpr std::string_view name_of(RatedCommand::Unit unit) {
  for (const CommandUnit& each : command_units)
    if (each.unit == unit) return each.name;
  return {};
}

}  // namespace mckibben::plant
