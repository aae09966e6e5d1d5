// Lines of text tables in cells, and the numbers in them, with a decimal point or a decimal comma.
#pragma once

#include <cstddef>
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

/// Whether a cell says that there is no number: it is empty, or NaN.
bool is_missing(const Cell& cell);

/// Reads the numbers of one table, all with the same decimal sign.
class NumberReader {
 public:
  /// `sign`: a point, a comma, or 0 for that which comes first.
  explicit NumberReader(char sign = '.') : sign_(sign) {}
  /// The number in a cell; otherwise none, and `problem` says why.
  std::optional<double> read(std::string_view name, const Cell& cell, std::string& problem);

 private:
  char sign_;
};

}  // namespace mckibben::input
