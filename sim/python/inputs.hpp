// What Python's objects of inputs hold.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/domain/scenario.hpp>
#include <sim/python/module.hpp>

namespace mckibben::python {

struct Scenario {
  domain::Scenario what;
  std::filesystem::path folder;       ///< where its relative paths start
  std::vector<std::string> warnings;  ///< of its reader
};

/// What was given as `current_mA` before valves could take anything else; still right where they take mA.
template <class T>
std::optional<T> either(std::optional<T> command, std::optional<T> current_mA, plant::CommandUnit unit) {
  if (!current_mA) return command;
  if (command) throw py::type_error("command and current_mA are the same; give one of them");
  if (unit != plant::CommandUnit::mA)
    throw py::value_error("the rig's valve is commanded in " + std::string(name_of(unit)) +
                          ": say command, not current_mA");
  return current_mA;
}

/// `value`, if it is within; `unit` comes after a number. Throws py::value_error.
double within(double value, double lowest, double highest, const std::string& name, const std::string& unit);
/// Whether the rig's DAC can give that command.
inline bool is_command(double value, const plant::Rig& rig) {
  return value >= rig.dac.lowest_command && value <= rig.dac.largest_command;
}
/// One that it can give. Throws py::value_error.
double command_within(double value, const plant::Rig& rig, const std::string& name);

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// A number, or several, as Python gave them; none for None. Throws py::type_error for what is none, with its
/// name and the unit that is wanted.
std::optional<double> number_of(const py::object& given, const char* name, std::string_view unit);
std::optional<Numbers> numbers_of(const py::object& given, const char* name, std::string_view unit);
/// A load that can hang on the rig. Throws py::value_error.
double load_within(double load_kg, const plant::Rig& rig, const std::string& name);

/// Every field of a rig, as JSON; what has the same is the same rig.
std::string fields_of(const plant::Rig& rig);

/// From a Rig, a name, a path or a dict, whose relative paths start at `folder`.
Rig rig_of(const py::object& from, const std::filesystem::path& folder = ".");

}  // namespace mckibben::python
