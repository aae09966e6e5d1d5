// Rows that are missing though the stamps go on: cut out of a table and numbered anew, or never written.
#pragma once

#include <cstddef>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// Rows of a run with which its position, and with it the pressure or the command, are at once elsewhere: no
/// load and no gas gets there in a row. `tick_s`: between rows that have no stamps. None of rows too slow to
/// tell, and none where it happens again and again: a recorder that repeats its readings.
std::vector<std::size_t> after_lost_rows(const domain::Run& run, double tick_s);

/// The same of all runs, with what to leave out.
std::vector<Finding> lost_rows(const domain::Dataset& data);

}  // namespace mckibben::data
