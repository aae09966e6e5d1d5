// A table as it stands in its file, made that of one run: which of its rows are the run's, and clocks that
// are no ascending stamps: intervals, stamps that a coarse clock repeats, a clock for each quantity.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/input/table.hpp>

namespace mckibben::input {

/// Whether quantities have a clock, or rows, of their own.
bool has_own_clocks(const domain::ColumnMap& map);

/// What has to be read besides the quantities: columns that `where` and `cut` name, clocks of single
/// quantities.
std::vector<WantedColumn> wanted_besides(const domain::ColumnMap& map, const domain::Run& run);

/// Where the parts of a table begin: where its recorder began anew, its clock falls back, or `cut` changes.
/// The first is 0.
std::vector<std::size_t> parts_of(const Table& table);

/// The rows of `where`, and then of the segment; intervals added up. In the units of the file.
void keep_where(Table& table, const domain::Run& run, TableProblems& problems);
void keep_segment(Table& table, const domain::ColumnMap& map, const domain::Run& run,
                  TableProblems& problems);

/// Numbers that stand for none (`missing`) are none.
void drop_missing(Table& table, const domain::ColumnMap& map, plant::CommandUnit commands,
                  TableProblems& problems);

/// Rows as the clock of all of them says (row_order.hpp); what was done is noted.
void order_rows(Table& table, const domain::ColumnMap& map, TableProblems& problems);

/// Stamps that repeat because the clock is coarse lie evenly up to the next; those that are rounded lie
/// evenly where that is within the rounding. Returns what was done; empty: nothing.
std::string spread_stamps(Table& table, const domain::ColumnMap& map);

/// Quantities with a clock, or rows, of their own at the stamps of all of them; what is not read at one is
/// NaN. In seconds. A file without time has the rig's ticks.
void merge_clocks(Table& table, const domain::ColumnMap& map, const plant::Rig& rig);

/// Rows from `from` to `to` since the first. In seconds.
void keep_window(Table& table, const domain::Run& run, TableProblems& problems);

}  // namespace mckibben::input
