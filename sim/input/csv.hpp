// Strict reader of CSV tables: header on line 1, one row each tick, plain finite numbers. Cells stand between
// commas; where the header has more semicolons or tabs, between those, and numbers may then have a decimal
// comma throughout. Columns may come in any order and extra ones are ignored (and may hold quoted text).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <sim/input/table.hpp>

namespace mckibben::input {

/// What to say of a column that is not among the headings `found`, besides that.
using MissingHint = std::string (*)(const WantedColumn& column, std::span<const std::string_view> found);

/// Reads the wanted columns; those that are not needed only if they are there.
Table read_csv(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems,
               MissingHint hint = nullptr);

/// The same for columns under our own names.
Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems);

}  // namespace mckibben::input
