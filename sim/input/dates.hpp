// Columns of wall-clock time: "2024-05-03 14:22:01.120", "03.05.2024 14:22:01,12", "5/3/2024 2:22:01 PM",
// "14:22:01.12". What counts is the time since the first row, so that day and month need only be told apart
// where the date changes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <sim/input/cells.hpp>

namespace mckibben::input {

/// The unit of such a column.
inline constexpr std::string_view date_unit = "date";

/// Reads the stamps of one table.
class ClockReader {
 public:
  /// Seconds since the first cell that was read; otherwise none, and `problem` says why.
  std::optional<double> read(std::string_view name, const Cell& cell, std::string& problem);

 private:
  struct Stamp {
    std::string date{};
    std::optional<long> day{};  ///< since 1970; none where day and month cannot be told apart
    double second = 0.0;        ///< of that day
  };
  static std::optional<Stamp> stamp_of(std::string_view text);

  std::optional<Stamp> first_;
  double last_ = 0.0, passed_s_ = 0.0;  ///< of stamps without a date
};

/// 2024-05-03, 03.05.2024, ... and nothing behind it.
bool is_day(std::string_view text);

}  // namespace mckibben::input
