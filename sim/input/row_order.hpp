// Rows of a table in the order of the clock that stamped them, and its stamps as far as it can tell them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace mckibben::input {

/// A counter that runs over goes on: of 16 or 32 bits (millis, micros), the milliseconds of a second, the
/// seconds of a minute, hour or day. A
/// recorder that begins anew does so where it began before. In the units of the file; false: none did.
bool run_on(std::vector<double>& stamps);

/// Also where both cells hold none.
bool same_number(double a, double b);

struct RowOrder {
  std::vector<std::size_t> rows;  ///< that are read, in this order
  std::string note;               ///< what was done; empty: nothing
  std::size_t first = 0;          ///< the first row that is left out
};

/// From the last to the first where stamps fall from row to row; by time where they are in no order. Without
/// rows that stand twice, rows without a stamp, and single rows whose stamp does not fit between its
/// neighbours'. Where more than one row in 20 had to go, it is another kind of clock, and nothing is done.
/// `stamps`: in any unit, NaN where a row has none. `same`: whether row k repeats all readings of the one
/// before.
RowOrder order_of_rows(const std::vector<double>& stamps, const std::function<bool(std::size_t)>& same);

/// Stamps of a coarse clock: what repeats, or is rounded, lies evenly then.
struct Spread {
  std::size_t repeats = 0;  ///< stamps that repeat the one before
  bool rounded = false;
};
Spread spread(std::vector<double>& stamps);

}  // namespace mckibben::input
