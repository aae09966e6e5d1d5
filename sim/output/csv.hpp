// Recordings as tables and as text: one row each tick, shortest digits that read back exactly. CSV has its
// header on line 1; the thesis's own files (T 3.3) have none.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/rig.hpp>
#include <sim/formats/table.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::output {

/// What was wanted of a run: the key of a signal, and its value at each row, in the unit of its column; none
/// if empty.
using Targets = std::vector<std::pair<std::string_view, std::vector<double>>>;

/// The columns of a recording's file. Without rows, what they are.
std::vector<formats::Column> columns_of(const run::Recording& recording, const plant::Rig& rig,
                                        const Targets& targets = {});

/// Of these what a laboratory records, as the columns of a data set.
std::vector<formats::Column> measured_columns(const run::Recording& recording, const plant::Rig& rig);

/// Every column of every rig as a Markdown table: `mckibben schema columns`.
std::string table_of_signals();

/// Columns of one length as CSV.
std::string csv_of(const std::vector<formats::Column>& columns);

/// The thesis's file: current [mA], contraction ratio, its speed [1/s] and acceleration [1/s2], pressure
/// [bar], separated by blanks. All but the current are calculated: ratio from counts, speed and acceleration
/// from differences of counts over the last tick and the last two,
/// pressure from the current by the valve's line.
std::string thesis_ascii(const run::Recording& recording, const plant::Rig& rig, double load_kg);

}  // namespace mckibben::output
