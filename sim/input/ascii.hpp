// Tables of numbers alone, without a heading, as the thesis's program wrote them (T 3.3) and as `save -ascii`
// does: blanks, tabs or semicolons between the numbers; a decimal point, or a decimal comma throughout. Lines
// that begin with # or % are remarks.
#pragma once

#include <span>

#include <sim/input/table.hpp>

namespace mckibben::input {

/// Reads the wanted columns, which are named by their numbers from 1.
Table read_ascii(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems);

}  // namespace mckibben::input
