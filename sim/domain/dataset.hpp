// Measured data sets: which runs there are, their loads and tables, and the rig they were measured on.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
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

/// What was read of a signal in a run: a value each row, straight over rows in which there was none.
struct Reading {
  plant::Channel channel;
  std::vector<double> values{};
  std::vector<bool> missing{};  ///< of these rows; empty: none is

  bool is_missing(std::size_t row) const { return !missing.empty() && missing[row]; }
};

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
  std::vector<Reading> readings;   ///< models are judged by the first; none: `measured` has no rows yet
  double ratio_per_unit = 1.0;     ///< of contraction: what one of its file's unit is
  double rest_length_m = 0.0;      ///< that its rise was divided by; 0: that of the rig it is compared with

  std::optional<Measurement> measured;  ///< in place of these; or what stands behind their rows (Rows)
  std::optional<Measurement> shaken;    ///< the same, with as much noise again on a pressure that is given
  std::vector<double> time_s;           ///< of rows made of stamps, since the first stamp; else empty

  /// The reading that a model is judged by. Throws std::out_of_range before there are rows.
  const Reading& judged() const { return readings.at(0); }
  Reading& judged() { return readings.at(0); }
  std::size_t rows() const { return readings.empty() ? 0 : judged().values.size(); }
  /// What was read beside it.
  std::span<const Reading> beside() const { return {readings.begin() + !readings.empty(), readings.end()}; }
  /// By its key in a data set's `columns`, without the muscle's number; null if it was not read.
  const Reading* find(std::string_view key, std::size_t muscle = 1) const {
    const auto at = std::ranges::find_if(
        readings, [&](const Reading& reading) { return reading.channel.is(key, muscle); });
    return at == readings.end() ? nullptr : &*at;
  }
  Reading* find(std::string_view key, std::size_t muscle = 1) {
    return const_cast<Reading*>(std::as_const(*this).find(key, muscle));
  }
  /// Of these the values; empty if it was not read.
  const std::vector<double>& values(std::string_view key, std::size_t muscle = 1) const {
    static const std::vector<double> none;
    const Reading* reading = find(key, muscle);
    return reading != nullptr ? reading->values : none;
  }
  /// A further one. `muscle`: 1 or 2 of a pair's.
  Reading& read(std::string_view key, std::vector<double> values = {}, std::size_t muscle = 0) {
    return readings.emplace_back(plant::Channel{quantity_of(key).channel.signal, muscle}, std::move(values));
  }
  bool length_is_given() const { return measured && measured->gives_length(); }
  bool reads_only_pressures() const {
    return readings.empty() ? measured && measured->reads_only_pressures() : judged().channel.is_pressure();
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
  double row_s = 0.0;                            ///< from row to row
  std::size_t stamps = 0, rows = 0, inputs = 0;  ///< in the files; judged; that drive the simulation
  double readings = 1.0;                         ///< in a row, on average
  double noise = 0.0;  ///< of a row's values of what is judged, by what the readings scatter
  std::map<std::string_view, double> noise_beside{};  ///< the same of other signals, by their keys
  double step = 0.0;                                  ///< that the readings are rounded to
  double given_noise_Pa = 0.0;                        ///< of a reading of a pressure that is given
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
