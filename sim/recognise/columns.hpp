// Which column of tables that look alike is what; and what numbers tell by themselves: a clock's step, which
// way contraction counts and where it is zero, whether a run began at rest.
#pragma once

#include <optional>
#include <vector>

#include <sim/recognise/recognise.hpp>

namespace mckibben::recognise {

using Values = std::vector<double>;
struct Heading;

constexpr double shortest_tick_s = 1e-4, longest_tick_s = 1.0;  ///< that a rig may have

/// The map of tables whose columns have the same names.
MapGuess map_of(const std::vector<const UnknownTable*>& tables, bool rig_is_known, const KnownRig& rig);

/// The numbers of a column as they stand in the file; null if there is none of that name.
const Values* column_of(const UnknownTable& table, const std::string& name);

/// What commands the muscle in such tables, or its pressure as an input; null if nothing.
const ColumnGuess* drive_of(const MapGuess& map);

/// Sign and zero of a contraction, by how it goes along with what drives the muscle. `gauge`: the muscle's
/// pressure; null: nobody read it.
void sign_and_zero(ColumnGuess& contraction, const ColumnGuess& drive, const ColumnGuess* gauge,
                   const std::vector<const UnknownTable*>& tables, const Heading& heading,
                   const KnownRig& rig);

/// Says of zeros that were read without pressure where they differ between the tables, of all maps together.
void compare_zeros(Recognised& all);

/// What is to be done with two columns of a quantity; empty where one of them is the right one.
std::string of_two(const domain::Quantity& quantity, bool duties);

/// Of a command that may be any of several columns, duties among them: its unit by the rig.
void unit_of_either_duty(ColumnGuess& command, const KnownRig& rig);

/// What a rig that nobody has described has as its valve, if duties command it; nothing if none do.
std::vector<Setting> valve_of_duties(const MapGuess& map, const UnknownTable& table);

/// A command that was recorded as a share, of the valve's range or as a duty: the rig's unit, zero and
/// factor. Of two valves a duty below 0 vents (sim/ride/switch.cpp).
void command_of_share(ColumnGuess& command, const Heading& heading,
                      const std::vector<const UnknownTable*>& tables, const KnownRig& rig);

/// Time as a table seems to hold it.
struct TimeGuess {
  std::optional<ColumnGuess> guess;            ///< none: no column holds it
  std::vector<const UnknownColumn*> clocks;    ///< of several quantities, in the order of columns; else empty
  const UnknownColumn* row_numbers = nullptr;  ///< a column that holds nothing else
};
/// Whole numbers, each one more than the one before.
bool counts_rows(const Values& values);
TimeGuess time_of(const UnknownTable& table);

/// Rows as the clock of all of them says (input/row_order.hpp).
void put_in_order(UnknownTable& table);

/// Its stamps in seconds; empty where they are not known. `done`: what was done to them (spread_stamps).
Values seconds_of(const UnknownTable& table, const ColumnGuess& time, std::string* done = nullptr);

/// The parts of a table that are runs of their own: by a column that says which, by a clock that begins
/// again.
std::vector<UnknownTable> runs_in(const UnknownTable& table);

struct Clock {
  double begin_s = 0.0, step_s = 0.0;  ///< the step in the middle of all
  double shortest_s = 0.0, longest_s = 0.0;
  double jitter_s = 0.0;  ///< the furthest from even stamps
  bool ascends = true;
};
Clock clock_of(const Values& time_s);

/// How many records take turns in a column: each row is far nearer to the one so many rows before it than to
/// its neighbour. 1: it is one record.
std::size_t taking_turns(const Values& values);

/// Lowest and highest number; equal where there is none.
struct Range {
  double low = 0.0, high = 0.0;
};
Range range_of(const Values& values);

/// A column as all tables of a map hold it.
struct Readings {
  std::vector<const Values*> values{};
  Range range{1e300, -1e300};
};
/// None if a table has no such column.
std::optional<Readings> readings_of(const std::vector<const UnknownTable*>& tables,
                                    const std::string& column);

/// How a reading goes along with what drives it, over all tables: correlation from -1 to 1.
struct Together {
  double correlation = 0.0;
  double at_least_drive = 0.0;  ///< the reading's median where the drive is lowest, within 2 % of its range,
  double scatter = 0.0;         ///< and from its 5th to its 95th percentile there
};
Together together(const std::vector<const Values*>& drive, const std::vector<const Values*>& reading);

/// The step that readings come in, in their unit, if that is one of `unit`; 0 if in none, or if they are
/// given.
double step_of(const ColumnGuess& guess, std::string_view unit, const std::vector<UnknownTable>& tables);

/// Whether the first 5 rows of a run, or of a long one the first 200th, move by less than 1 % of `range`.
bool begins_still(const Values& values, const Range& range);

}  // namespace mckibben::recognise
