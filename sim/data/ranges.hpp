// A run's columns against what rig, tick and instruments can do, before anything is simulated: a few numbers
// out of range one by one, many of them as one problem, with the line of `columns` that mends it. Readings
// that drop out now and then are none.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <sim/domain/columns.hpp>

namespace mckibben::data {

/// With our names and units where it says none.
domain::ColumnMap with_our_names(domain::ColumnMap map, plant::CommandUnit commands);

/// The line of a column in another unit than was said, with its factor, also if it is 1: then a heading that
/// says the old unit counts no more.
std::string line_in_unit(std::string_view quantity, const domain::ColumnPlace& meant);

/// Whether a contraction is a length or an angle in its column: then the rig's rest length makes a ratio of
/// it.
bool divided_by_length(const domain::ColumnPlace& contraction);

/// A column of a run, in our unit.
struct ReadColumn {
  std::string_view name;  ///< current_mA
  const std::vector<double>* values;
  bool may_miss = false;  ///< what was not read may be left out
};

struct WrongNumber {
  std::size_t column, row;
  std::string message;
  bool of_column = false;               ///< many numbers, of which this is the first
  std::vector<std::size_t> not_read{};  ///< these rows, which are so few: no error
};

/// `map` says where the columns came from.
std::vector<WrongNumber> check_ranges(std::span<const ReadColumn> columns, const domain::ColumnMap& map,
                                      const plant::Rig& rig);

/// A clock in another unit, with another tick or another beginning than a row each tick has.
std::optional<WrongNumber> check_clock(const std::vector<double>& time_s, const domain::ColumnMap& map,
                                       const plant::Rig& rig);

/// Of a recorder that had one of its own: what to say of rows that are no ticks.
inline constexpr const char* own_clock =
    "if the recorder had a clock of its own, the data set says start: settled, or start: moving";

}  // namespace mckibben::data
