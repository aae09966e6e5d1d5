// Lines of text tables in cells, and the numbers in them, with a decimal point or a decimal comma.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mckibben::input {

struct Cell {
  std::string_view text;  ///< trimmed, without quotes
  std::size_t offset = 0;
};

/// Splits a line at its separators, a comma or a tab (RFC 4180, without line breaks inside cells); a blank
/// stands for blanks, tabs and semicolons, in numbers without quotes. Empty if a quote is not closed.
std::vector<Cell> split_cells(std::string_view line, char separator);

/// Whether a cell says that there is no number: it is empty, NaN, a dash, n/a, #DIV/0!, OVLD, ...
bool is_missing(const Cell& cell);

/// Takes the unit off a number, "0.4 bar". False where `unit`, if it is not empty, is another.
bool take_unit(Cell& cell, std::string& unit);

/// Whether a cell holds a number, perhaps with a unit behind it, or a stamp of date or time.
bool is_number_like(std::string_view text);

/// A unit as a heading shows it, "[mA]" or "mA"; empty if it is none that anything here is measured in.
std::string unit_word(std::string_view text);

/// Reads numbers with one decimal sign; the other stands between thousands.
class NumberReader {
 public:
  /// `sign`: a point, a comma, or 0 for the last sign of the first number that has one.
  explicit NumberReader(char sign = '.') : sign_(sign) {}
  /// The number in a cell; otherwise none, and `problem` says why.
  std::optional<double> read(std::string_view name, const Cell& cell, std::string& problem);

 private:
  char sign_;
};

/// How the numbers of a column are spelled.
class Spelling {
 public:
  void look_at(std::string_view text);
  /// The sign before its decimals; 0: none of its numbers tells it.
  char decimal() const;
  /// That of a column that goes on from 996 to 1,008, where the sign stands between thousands; else 0.
  char goes_on() const;
  /// Its first number that may be either, such as 50.335, and the sign in it; empty: there is none.
  const std::string& group() const { return group_; }
  char mark() const { return mark_; }

 private:
  std::size_t points_ = 0, commas_ = 0, longest_ = 0;  ///< decimals; digits of the longest without a sign
  char mark_ = '.';
  std::string group_;
};

/// Reads the stamps of one table. If the first is so large that it counts since 1970, or since the recorder
/// was switched on long ago, all are read as those since the first, without losing a digit.
class EpochReader {
 public:
  std::optional<double> read(std::string_view name, const Cell& cell, NumberReader& numbers,
                             std::string& problem);
  /// What was taken off, as it stands in the file; none if nothing.
  const std::optional<std::string>& taken_off() const { return first_text_; }

 private:
  bool began_ = false;
  std::int64_t first_ = 0;
  std::optional<std::string> first_text_;
};

}  // namespace mckibben::input
