// Units of the map `columns` of a data set: whether they can be what they stand for, and tables brought to
// ours.
#pragma once

#include <functional>
#include <string_view>

#include <plant/rig.hpp>
#include <sim/domain/columns.hpp>
#include <sim/input/table.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

using domain::ColumnMap, domain::ColumnPlace, domain::line_of;

/// The quantity that a column of a table was read as, of those that the map names; null: of none. Commands
/// have two keys.
const domain::Quantity* named_quantity(std::string_view column, const ColumnMap& map,
                                       plant::CommandUnit commands);

/// The unit that a heading says, as in U_mA, `I [A]` or t(ms); ours if there is none that fits.
std::string fitting_unit(std::string_view heading, const domain::Quantity& quantity);

/// Checks the units of a map, and that no input is called a reading; `map` is the value of `columns`.
void check_units(const Source& source, const Node& map, Problems& problems);

/// Checks that a file whose lines below the heading name units is read in these, where it is not a sensor's
/// factor that makes another quantity of them. `says_factor`: whether one is written of a quantity, 1 too.
/// Before the table is converted.
void check_said_units(const Table& table, const ColumnMap& map, const plant::Rig& rig,
                      const std::function<bool(std::string_view quantity)>& says_factor,
                      TableProblems& problems);

/// Whether a command in this unit is a current.
bool is_current(std::string_view unit);

/// What one of a column's unit is as a contraction ratio; 1 where none is said.
double ratio_per_unit(const ColumnPlace& contraction, const plant::Rig& rig);

/// Brings a table that was read with a map to our units: time_s, current_mA (of a rig in volts command_V),
/// contraction_ratio, muscle_pressure_bar. Lengths and angles become ratios by the rig's wheel and the
/// muscle's rest length.
void convert_columns(Table& table, const ColumnMap& map, const plant::Rig& rig);

/// What is wrong with the numbers of a table that was brought to our units, at its place. A few readings that
/// cannot be are taken as not read, where readings may miss.
void check_numbers(Table& table, const ColumnMap& map, const plant::Rig& rig, TableProblems& problems);
/// The same of a clock that is to tick as the rig does.
void check_clock(const Table& table, const ColumnMap& map, const plant::Rig& rig, TableProblems& problems);

}  // namespace mckibben::input
