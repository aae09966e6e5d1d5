// The table of a measured run, whatever format it was read from: wanted columns, where each number stands,
// and the checks that hold for all formats. A wrong number never becomes a plausible one: everything odd is a
// problem with its place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

/// A column that is looked for.
struct WantedColumn {
  std::string name;     ///< as we call it, with its unit: current_mA
  std::string in_file;  ///< as the file calls it: a heading, a channel, a number, a variable
  bool needed = true;
  bool may_miss = false;  ///< a row may lack it: empty, NaN
  bool is_date = false;   ///< wall-clock time, read as seconds since the first row
};

/// The wanted columns of a table.
struct Table {
  struct Column {
    std::string name, in_file;
    std::size_t index = 0;  ///< in the file
    std::vector<double> values;
    bool may_miss = false;
    bool is_date = false;
    std::string unit{};  ///< that the file says in a line below the heading; empty: none
  };
  std::vector<Column> columns;
  std::vector<std::size_t> lines;  ///< of each row; empty in files that are no text
  char separator = ',';            ///< of cells; a blank stands for any number of them

  /// Null if the column was optional and is not there.
  const Column* find(std::string_view name) const;
  Column* find(std::string_view name);
  /// Where row `row` (from 0) of a column stands in the file.
  Place place(const Source& source, const Column& column, std::size_t row) const;
};

/// Problems of one table: after twenty they are only counted.
class TableProblems {
 public:
  TableProblems(const Source& source, Problems& problems) : source_(source), problems_(problems) {}
  TableProblems(const TableProblems&) = delete;
  TableProblems& operator=(const TableProblems&) = delete;
  /// Says how many were not shown.
  ~TableProblems();

  void add(Place place, std::string message);
  /// A problem with one number: shown at its place, or with the name and number that it has in the file.
  void add(const Table& table, const Table::Column& column, std::size_t row, const std::string& message);
  std::size_t count() const { return count_; }

 private:
  const Source& source_;
  Problems& problems_;
  std::size_t count_ = 0;
  Place last_;
};

/// Problems of the file as a whole: too large, empty, not UTF-8 text. False if there is one.
bool check_text(const Source& source, TableProblems& problems);

/// Checks that each column `time_s` is k * tick_s for k = 0, 1, ... within a microsecond, if all rows were
/// sound. Only the first departure is reported: all later rows would repeat it; `way_out`: what to say of
/// stamps that are uneven.
void check_ticks(const Table& table, double tick_s, TableProblems& problems, std::string_view way_out = {});

/// Checks that lowest <= value <= highest in every row of a column.
void check_range(const Table& table, const Table::Column& column, double lowest, double highest,
                 std::string_view meaning, TableProblems& problems);

}  // namespace mckibben::input
