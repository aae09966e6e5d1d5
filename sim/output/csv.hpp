// Recordings as tables and as text: one row each tick, shortest digits that read back exactly. CSV has its
// header on line 1; the thesis's own files (T 3.3) have none.
#pragma once

#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/formats/table.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::output {

/// What is recorded of a muscle beside its position.
struct Besides {
  bool gauge = false, load_cell = false;
};
Besides besides_of(const plant::Rig& rig);

/// Columns of a recording: true values, and what the encoder counted. A target, a gauge and a load cell are
/// columns where there are any.
std::vector<formats::Column> recorded_columns(bool target, Besides besides);
/// The same with their values. `target` [contraction ratio] may be empty. `per_count` is the contraction
/// ratio of one encoder count.
std::vector<formats::Column> columns_of(const run::Recording& recording, double per_count,
                                        const std::vector<double>& target, Besides besides);

/// Columns of a data set's table: what was measured.
std::vector<formats::Column> measured_columns(Besides besides);
std::vector<formats::Column> columns_of(const domain::Run& measured, double tick_s);

/// A tick's time without the rounding of k * 0.012, which would fill the column with digits.
double tidy_s(double time_s);

/// Columns of one length as CSV.
std::string csv_of(const std::vector<formats::Column>& columns);

/// The thesis's file: current [mA], contraction ratio, its speed [1/s] and acceleration [1/s2], pressure
/// [bar], separated by blanks. All but the current are calculated: ratio from counts, speed and acceleration
/// from differences of counts over the last tick and the last two,
/// pressure from the current by the valve's line.
std::string thesis_ascii(const run::Recording& recording, const plant::Rig& rig, double load_kg);

}  // namespace mckibben::output
