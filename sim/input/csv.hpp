// Strict reader of measured tables: header on line 1, commas, one row each tick, plain finite numbers.
// Columns may come in any order and extra ones are ignored (and may hold quoted text). A wrong number never
// becomes a plausible one: everything odd is a problem with its line and column.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

inline constexpr std::size_t largest_csv_bytes = 1U << 30U;

/// Problems of one table: after twenty they are only counted.
class TableProblems {
 public:
  TableProblems(const Source& source, Problems& problems) : source_(source), problems_(problems) {}
  TableProblems(const TableProblems&) = delete;
  TableProblems& operator=(const TableProblems&) = delete;
  /// Says how many were not shown.
  ~TableProblems();

  void add(Place place, std::string message);
  std::size_t count() const { return count_; }

 private:
  const Source& source_;
  Problems& problems_;
  std::size_t count_ = 0;
  Place last_;
};

/// The wanted columns of a table.
struct Table {
  struct Column {
    std::string name;
    std::size_t index = 0;  ///< in the file
    std::vector<double> values;
  };
  std::vector<Column> columns;

  /// Null if the column was optional and is not there.
  const Column* find(std::string_view name) const;
  /// Where row `row` (from 0) of a column stands in the file.
  static Place place(const Source& source, const Column& column, std::size_t row);
};

/// Reads the columns `required`, and those of `optional` that are there.
Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems);

/// Checks that the column `time_s` is k * tick_s for k = 0, 1, ... within a microsecond, if all rows were
/// sound. Only the first departure is reported: all later rows would repeat it.
void check_ticks(const Source& source, const Table& table, double tick_s, TableProblems& problems);

/// Checks that every current is one that the rig's DAC can give.
void check_dac_range(const Source& source, const Table::Column& current, double largest_current_mA,
                     TableProblems& problems);

/// Checks that lowest <= value <= highest in every row of a column.
void check_range(const Source& source, const Table::Column& column, double lowest, double highest,
                 std::string_view meaning, TableProblems& problems);

}  // namespace mckibben::input
