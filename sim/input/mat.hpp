// Tables in MATLAB's MAT-files: a vector for each column.
#pragma once

#include <span>

#include <sim/input/table.hpp>

namespace mckibben::input {

/// Reads the wanted columns: variables (`current`), fields (`run.current`) or columns of a matrix
/// (`data(:,2)`), all of one length, of finite numbers.
Table read_mat_table(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems);

}  // namespace mckibben::input
