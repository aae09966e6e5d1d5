// What people write: in the heading of a column its words and its unit, in English, German and a little
// French; loads in the names of files and folders, or above the headings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/domain/columns.hpp>
#include <sim/recognise/recognise.hpp>

namespace mckibben::recognise {

struct Heading {
  const domain::Quantity* quantity = nullptr;  ///< none: nothing that is known
  std::string unit;                            ///< that it says, or the line below it does; empty: none
  bool unit_fits = false;                      ///< what is said can be a unit of the quantity
  std::string reason;                          ///< which words tell
  bool is_length = false;                      ///< the muscle's, which falls as it contracts
  bool is_contraction = false;                 ///< which rises as the muscle contracts
  bool is_voltage = false;                     ///< a command that a word calls a voltage
  bool is_duty = false;                        ///< of valves that are open or shut
  std::string other_unit{};  ///< the heading says another one than the line below it; empty: it does not
  std::string unknown{};     ///< in its brackets, and no unit that is known; empty: nothing
  std::string times{};  ///< of ten by which its numbers are scaled, as `x10` in `p x10 [bar]`; empty: none
};

/// A voltage or a current, which a sensor gives of anything.
bool is_of_a_sensor(const std::string& unit);
Heading heading_of(const UnknownColumn& column);
/// Two units that it and the line below it say: which one is asked.
Told two_units(const Heading& heading);
/// The factor where the unit of the map contradicts what the file says.
Told unit_of_the_map();
/// A number that may be read with decimals or with thousands: asked.
Told decimals_or_thousands(const std::string& number);
/// The reason of one that nothing tells.
inline constexpr std::string_view no_word = "neither its words nor its unit are known";

/// Words of absolute pressures; of columns whose value is another for each run, that mark its first row, that
/// change within a run; of loads; of columns that say which quantity, or which of several sensors, a row
/// holds; of row numbers; of an ADC.
bool is_absolute(const std::string& name);
bool names_an_instrument(const std::string& name);
bool names_a_run(const std::string& name);
bool names_a_start(const std::string& name);
bool names_a_phase(const std::string& name);
bool names_a_load(const std::string& name);
bool names_a_key(const std::string& name);
bool names_a_sensor(const std::string& name);
bool names_rows(const std::string& name);
bool names_raw(const std::string& name);

/// None if nothing tells the load of this run; FILL_IN with what may be it where several masses are named, or
/// one that no word calls a load.
std::optional<LoadGuess> load_of(const UnknownTable& table);

/// Masses that a text names: those that are a load by a word beside them, else in names of files any (of
/// grams one by itself), in lines one that stands alone or is called mass; and all others.
struct Masses {
  std::vector<std::string> loads, others;
};
Masses masses_in(const std::string& text, bool is_name);

/// "5 kg" in "load_5kg_run2", "5,5 kg" in "m5,5kg", with a decimal p as well: "5p5kg". None where there are
/// none or two.
std::optional<std::string> load_in(const std::string& text);

}  // namespace mckibben::recognise
