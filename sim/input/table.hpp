// The table of a measured run, whatever format it was read from: wanted columns, where each number stands,
// and the checks that hold for all formats. A wrong number never becomes a plausible one: everything odd is a
// problem with its place.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

/// What the cells of a column hold.
enum class CellKind {
  number,
  stamp,  ///< a time; one that counts since 1970 is read as that since the first
  date,   ///< wall-clock time, read as seconds since the first row
  label   ///< any text, read as its number in `Column::labels`
};

/// A column that is looked for.
struct WantedColumn {
  std::string name;     ///< as we call it, with its unit: current_mA
  std::string in_file;  ///< as the file calls it: a heading, a channel, a number, a variable
  bool needed = true;
  bool may_miss = false;  ///< a row may lack it: empty, NaN
  CellKind kind = CellKind::number;
  bool own_clock = false;  ///< its stamps are in a column of their own
};

/// The wanted columns of a table.
struct Table {
  struct Column {
    std::string name, in_file;
    std::size_t index = 0;  ///< in the file
    std::vector<double> values;
    bool may_miss = false;
    CellKind kind = CellKind::number;
    std::string unit{};  ///< that the file says in a line below the heading; empty: none
    std::map<std::string, double, std::less<>> labels{};
    bool own_clock = false;

    /// The number of a text.
    double label(std::string_view text);
  };
  std::vector<Column> columns;
  std::vector<std::size_t> lines;     ///< of each row; empty in files that are no text
  std::vector<std::size_t> parts{};   ///< rows before which a recorder began anew, but for the first
  std::vector<std::string> others{};  ///< headings of a text that nobody wanted
  char separator = ',';               ///< of cells; a blank stands for any number of them

  std::size_t rows() const { return columns.empty() ? lines.size() : columns.front().values.size(); }
  /// The next row is the first of another part.
  void begin_part();

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

  void add(Place place, std::string message, bool of_column = false);
  /// A problem with one number: shown at its place, or with the name and number that it has in the file.
  void add(const Table& table, const Table::Column& column, std::size_t row, const std::string& message,
           bool of_column = false);
  /// How something was read that could be read in another way.
  void note(Place place, std::string message) { problems_.warning(source_, place, std::move(message)); }
  void note(const Table& table, const Table::Column& column, std::size_t row, const std::string& message);
  std::size_t count() const { return count_; }
  std::size_t line_in_file(std::size_t line) const { return source_.line_in_file(line); }

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
