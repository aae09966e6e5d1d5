// Strict reader of CSV tables: header on line 1, commas, one row each tick, plain finite numbers. Columns may
// come in any order and extra ones are ignored (and may hold quoted text).
#pragma once

#include <span>
#include <string_view>

#include <sim/input/table.hpp>

namespace mckibben::input {

/// Reads the wanted columns; those that are not needed only if they are there.
Table read_csv(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems);

/// The same for columns under our own names.
Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems);

}  // namespace mckibben::input
