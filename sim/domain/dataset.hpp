// Measured data sets: which runs there are, their loads and tables, and the rig they were measured on.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/rig.hpp>
#include <sim/domain/columns.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/domain/measurement.hpp>

namespace mckibben::domain {

/// The reading that models are judged by: contraction ratio; force [N] at lengths that a bench gives; joint
/// angle [rad] of a pair or a lever; a pressure [Pa] where nothing but pressures was read.
enum class Judged { contraction, force, angle, pressure };
constexpr auto names(Judged) {
  using enum Judged;
  return std::array{std::pair{contraction, std::string_view{"contraction"}},
                    std::pair{force, std::string_view{"force"}}, std::pair{angle, std::string_view{"angle"}},
                    std::pair{pressure, std::string_view{"pressure"}}};
}

/// What may have been read beside it, in the order in which it is reported; of a pair the opposite ones too.
enum class Beside { muscle_pressure, opposite_pressure, force, valve_pressure, opposite_valve_pressure };
inline constexpr std::array gauges{Beside::muscle_pressure, Beside::opposite_pressure};
inline constexpr std::array valve_gauges{Beside::valve_pressure, Beside::opposite_valve_pressure};
inline constexpr std::array besides{Beside::muscle_pressure, Beside::opposite_pressure, Beside::force,
                                    Beside::valve_pressure, Beside::opposite_valve_pressure};
inline plant::Channel channel_of(Beside which, bool pair) {
  if (which == Beside::force) return {&plant::signal_of("force")};
  const bool muscle = which == Beside::muscle_pressure || which == Beside::opposite_pressure;
  const bool first = which == Beside::muscle_pressure || which == Beside::valve_pressure;
  return {&plant::signal_of(muscle ? "muscle_pressure" : "valve_pressure"), !pair ? 0U : first ? 1U : 2U};
}

/// One measured run: a row each tick, the first at time 0; or `measured` with a clock of its own.
struct Run {
  std::string id;
  std::string file;
  std::optional<double> given_load_kg;
  double load_kg = 0.0;  ///< 0 where none hangs
  ColumnMap columns;
  int segment = 0;
  std::string sheet;  ///< of a spreadsheet
  std::string cut;    ///< a column; where it changes, the next segment begins
  RowFilter where;
  double from_s = 0.0, to_s = 0.0;  ///< since the first of its rows; 0: to the end

  std::vector<double> current_mA;  ///< held from its row to the next
  std::vector<double> contraction_ratio;
  std::vector<double> force_N;    ///< of the cord: judged where the length is given, else beside
  std::vector<double> angle_rad;  ///< of a pair or a lever
  std::optional<std::vector<double>> muscle_pressure_Pa;
  std::optional<std::vector<double>> opposite_pressure_Pa;  ///< of muscle 2
  std::optional<std::vector<double>> valve_pressure_Pa, opposite_valve_pressure_Pa;
  double ratio_per_unit = 1.0;  ///< of contraction: what one of its file's unit is
  double rest_length_m = 0.0;   ///< that its rise was divided by; 0: that of the rig it is compared with

  std::optional<Measurement> measured;  ///< in place of these three; or what stands behind their rows (Rows)
  std::optional<Measurement> shaken;    ///< the same, with as much noise again on a pressure that is given
  std::vector<double> time_s;           ///< of rows made of stamps, since the first stamp; else empty
  std::vector<bool> missing;  ///< rows of theirs without a reading of what is judged; empty: none is
  std::array<std::vector<bool>, besides.size()> missing_beside;  ///< the same of what was read beside it

  /// The reading that a model is judged by.
  Judged kind_of_judged() const {
    if (!angle_rad.empty()) return Judged::angle;
    if (reads_only_pressures()) return Judged::pressure;
    return length_is_given() ? Judged::force : Judged::contraction;
  }
  const std::vector<double>& judged() const { return const_cast<Run*>(this)->judged(); }
  std::vector<double>& judged() {
    const Judged kind = kind_of_judged();
    if (const auto which = kind == Judged::pressure ? first_gauge() : std::nullopt) return *gauge(*which);
    return kind == Judged::angle ? angle_rad : kind == Judged::force ? force_N : contraction_ratio;
  }
  /// Of rows: the gauge that is judged, the first there is, where nothing but pressures was read.
  std::optional<Beside> judged_gauge() const { return reads_only_pressures() ? first_gauge() : std::nullopt; }
  /// What was read beside it; null if it was not.
  const std::vector<double>* beside(Beside which) const {
    if (which == Beside::force) return force_N.empty() || length_is_given() ? nullptr : &force_N;
    const auto& read = const_cast<Run*>(this)->gauge(which);
    return read && which != judged_gauge() ? &*read : nullptr;
  }
  std::optional<std::vector<double>>& gauge(Beside which) {
    if (which == Beside::muscle_pressure) return muscle_pressure_Pa;
    if (which == Beside::opposite_pressure) return opposite_pressure_Pa;
    return which == Beside::valve_pressure ? valve_pressure_Pa : opposite_valve_pressure_Pa;
  }
  bool is_missing(Beside which, std::size_t row) const {
    const auto& rows = missing_beside[static_cast<std::size_t>(which)];
    return !rows.empty() && rows[row];
  }
  bool length_is_given() const { return measured && measured->gives_length(); }
  bool reads_only_pressures() const {
    if (!contraction_ratio.empty() || !force_N.empty() || !angle_rad.empty()) return false;
    return first_gauge() || (measured && measured->reads_only_pressures());
  }
  std::optional<Beside> first_gauge() const {
    for (const Beside which : besides)
      if (which != Beside::force && const_cast<Run*>(this)->gauge(which)) return which;
    return std::nullopt;
  }

  static void fields(auto& self, auto& visit) {
    visit.required("id", self.id, "name of the run; results are written under it");
    visit.required("file", self.file,
                   "its table, relative to this file: text (.csv, .txt or any other ending), .lvm, .mat, "
                   ".xlsx, .xls, .tdms");
    visit("load", self.given_load_kg, "kg", 0.0, 500.0, "mass of the load; required where one hangs");
    visit("columns", self.columns, "where this run's file differs from the data set's columns");
    visit("segment", self.segment, 0, 100000,
          "which part of a file that holds several: where its clock begins again, `cut` changes, or an .lvm "
          "has a "
          "segment; 0: all of them, one after the other");
    visit("sheet", self.sheet, "which sheet of an .xlsx or .xls, if several hold numbers");
    visit("cut", self.cut, "column that marks cycles or phases: where it changes, the next segment begins");
    visit("where", self.where, "rows that are this run, as {cycle: 3}: those with this text in that column");
    visit("from", self.from_s, "s", 0.0, 1e6, "where the run begins, since the first row");
    visit("to", self.to_s, "s", 0.0, 1e6, "where it ends, since the first row; 0: with the last");
  }
};

/// How rows were made of stamps, over all runs.
struct Rows {
  double row_s = 0.0;                                ///< from row to row
  std::size_t stamps = 0, rows = 0, inputs = 0;      ///< in the files; judged; that drive the simulation
  double readings = 1.0;                             ///< in a row, on average
  double noise = 0.0, pressure_noise_Pa = 0.0;       ///< of a row's values, by what the readings scatter
  double force_noise_N = 0.0, valve_noise_Pa = 0.0;  ///< of a force, a valve's pressure, read beside
  double step = 0.0;                                 ///< that the readings are rounded to
  double given_noise_Pa = 0.0;                       ///< of a reading of a pressure that is given
  bool smoothed = false;                             ///< that pressure was
  std::size_t slack = 0;       ///< readings of force that are none: the cord hung through
  std::size_t at_the_end = 0;  ///< and those at the end of the load cell's range

  friend bool operator==(const Rows&, const Rows&) = default;
};

struct Dataset {
  plant::Rig rig;
  ColumnMap columns;
  Recorded recorded{};
  std::vector<Run> runs;
  bool own_clock = false;  ///< runs are `measured`, stamp by stamp
  std::optional<Rows> rows_of_stamps;
  bool parts_of_a_run = false;       ///< the runs are parts of one that was recorded
  std::vector<std::string> remarks;  ///< how tables were read, where it could be done in another way

  double row_s() const { return rows_of_stamps ? rows_of_stamps->row_s : rig.tick_s; }
  double rows_begin_s() const { return rows_of_stamps ? recorded.skip_s : 0.0; }
  Judged judged() const {
    if (!runs.empty() && std::ranges::all_of(runs, &Run::reads_only_pressures)) return Judged::pressure;
    if (rig.has_angle()) return Judged::angle;
    return lengths_are_given() ? Judged::force : Judged::contraction;
  }
  /// A bench gives every run its length, and what is judged is the force,
  bool force_is_judged() const { return judged() == Judged::force; }
  /// or a pressure.
  bool lengths_are_given() const { return !runs.empty() && std::ranges::all_of(runs, &Run::length_is_given); }
  /// No run has a valve: the pressure is given, of a pair both are.
  bool pressure_is_given() const { return gives_pressure(plant::GivenPressure::muscle); }
  bool supply_is_given() const {
    return !runs.empty() && std::ranges::all_of(runs, [](const Run& run) {
      return run.measured && run.measured->gives("supply_pressure");
    });
  }
  /// The pressure in the valve is, so that valve and supply do not matter.
  bool valve_pressure_is_given() const { return gives_pressure(plant::GivenPressure::valve); }
  bool gives_pressure(plant::GivenPressure which) const {
    return std::ranges::all_of(runs, [&](const Run& run) {
      return run.measured && run.measured->given_pressure() == which &&
             (rig.pair() == nullptr || run.measured->given_pressure(2) == which);
    });
  }

  std::filesystem::path path;     ///< of the file `dataset.yaml`
  std::vector<InputFile> inputs;  ///< the files it was read from

  static void fields(auto& self, auto& visit) {
    visit("rig", self.rig, "the nominal rig: a shipped name, the path of a rig file, or changes in place");
    visit(
        "columns", self.columns,
        "where the runs' files hold what is wanted, and in which units; without it under our names, time_s, "
        "current_mA, contraction_ratio, muscle_pressure_bar");
    visit("start", self.recorded.start,
          "settled: at rest with the first input; moving: recorded from some instant on, the first state is "
          "estimated from the first readings");
    visit("skip", self.recorded.skip_s, "s", 0.0, 1e4, "so much of each run is simulated but not compared");
    visit("hold", self.recorded.hold,
          "what inputs do between stamps: previous (usual for commands) or linear (usual for pressures and "
          "lengths)");
    visit("bridge", self.recorded.bridge_s, "s", 0.0, 1e4,
          "rows without a given input are bridged as `hold` says, for so long at most");
    visit.required("runs", self.runs, "the runs");
  }
};

}  // namespace mckibben::domain
