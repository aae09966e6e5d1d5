// What people write: in the heading of a column its words and its unit, in English, German and a little
// French; loads in the names of files and folders, or above the headings.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <sim/domain/columns.hpp>
#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {

struct Heading {
  const domain::Quantity* quantity = nullptr;  ///< none: nothing that is known
  std::string unit;                            ///< that it says, or the line below it does; empty: none
  bool unit_fits = false;                      ///< what is said can be a unit of the quantity
  std::string reason;                          ///< which words tell
  bool is_length = false;                      ///< the muscle's, which falls as it contracts
};

Heading heading_of(const UnknownColumn& column);
/// The reason of one that nothing tells.
inline constexpr std::string_view no_word = "neither its words nor its unit are known";

/// Words of absolute pressures; of columns whose value is another for each run, that mark its first row, that
/// change within a run; of loads; of columns that say which quantity, or which of several sensors, a row
/// holds; of row numbers; of an ADC.
bool is_absolute(const std::string& name);
bool names_a_run(const std::string& name);
bool names_a_start(const std::string& name);
bool names_a_phase(const std::string& name);
bool names_a_load(const std::string& name);
bool names_a_key(const std::string& name);
bool names_a_sensor(const std::string& name);
bool names_rows(const std::string& name);
bool names_raw(const std::string& name);

/// None if nothing tells the load of this run.
std::optional<LoadGuess> load_of(const UnknownTable& table);

/// "5 kg" in "load_5kg_run2", "5,5 kg" in "m5,5kg", with a decimal p as well: "5p5kg".
std::optional<std::string> load_in(const std::string& text);

}  // namespace mckibben::recognise
