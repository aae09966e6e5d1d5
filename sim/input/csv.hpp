// Strict reader of CSV tables: a heading (csv_layout.hpp), one row each tick, plain finite numbers, in quotes
// or not. Cells stand between commas, semicolons or tabs; numbers may have a decimal comma throughout.
// Columns may come in any order and extra ones are ignored (and may hold text). Empty columns and rows at the
// end are none.
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
