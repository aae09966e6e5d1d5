// What is wrong with a column as a whole, said once and with the line of `columns` that mends it: a heading
// that is not there, numbers in another unit or with the other sign, columns that are exchanged.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <plant/valve.hpp>
#include <sim/input/column_units.hpp>

namespace mckibben::input {

/// To hang on the message that a column is not among the headings `found`: which line says where it stands.
std::string hint_of_missing(const WantedColumn& column, std::span<const std::string_view> found);

/// The checks of a run's columns against what a rig and its instruments can do: a few numbers out of range
/// one by one, many of them as one problem.
class ColumnChecks {
 public:
  /// `map` says where the columns of `table`, which is converted, came from.
  ColumnChecks(const Table& table, const ColumnMap& map, TableProblems& problems);

  /// As `check_ticks`; a clock in another unit or with another tick is said to be so.
  void time(double tick_s);
  void current(double largest_mA);
  /// Of a valve with commands of its own; `column` holds the currents that they stand for.
  void command(const Table::Column& column, const std::string& key, const ColumnPlace& place,
               const plant::Valve& valve);
  void contraction(double lowest, double highest, double largest_mA);
  void pressure(double lowest_bar, double highest_bar);

 private:
  void range(const Table::Column& column, double lowest, double highest, std::string_view meaning,
             const std::string& hint);

  const Table& table_;
  bool has_own_command_;  ///< in another unit than a current's, or under another name
  ColumnMap map_;         ///< with our own names where it says none
  TableProblems& problems_;
};

}  // namespace mckibben::input
