// Measured data sets: which runs there are, their loads and tables, and the rig they were measured on.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sim/domain/columns.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/domain/measurement.hpp>
#include <sim/domain/rig_file.hpp>

namespace mckibben::domain {

/// One measured run: a row each tick, the first at time 0; or `measured` with a clock of its own.
struct Run {
  std::string id;
  std::string file;
  std::optional<double> given_load_kg;
  double load_kg = 0.0;  ///< 0 where none hangs
  ColumnMap columns;
  int segment = 0;

  std::vector<double> current_mA;  ///< held from its row to the next
  std::vector<double> contraction_ratio;
  std::vector<double> force_N;  ///< of the cord, where the length is given and it is judged in place of that
  std::optional<std::vector<double>> muscle_pressure_Pa;
  double ratio_per_unit = 1.0;  ///< of contraction: what one of its file's unit is
  double rest_length_m = 0.0;   ///< that its rise was divided by; 0: that of the rig it is compared with

  std::optional<Measurement> measured;  ///< in place of these three; or what stands behind their rows (Rows)
  std::optional<Measurement> shaken;    ///< the same, with as much noise again on a pressure that is given
  std::vector<double> time_s;           ///< of rows made of stamps, since the first stamp; else empty
  std::vector<bool> missing;            ///< rows of theirs without a reading; empty: none is

  /// The reading that a model is judged by: contraction ratio, or force [N] at a length that is given.
  const std::vector<double>& judged() const { return force_N.empty() ? contraction_ratio : force_N; }
  bool length_is_given() const { return measured && measured->length_is_given; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("id", self.id, "name of the run; results are written under it");
    visit.required(
        "file", self.file,
        "its table, relative to this file; the ending tells the format: .csv, .lvm, .mat, or .txt, .dat, "
        ".asc for numbers without headings");
    visit("load", self.given_load_kg, "kg", 0.01, 500.0, "mass of the load; required where one hangs");
    visit("columns", self.columns, "where this run's file differs from the data set's columns");
    visit("segment", self.segment, 0, 100000,
          "which segment of an .lvm; 0: all of them, one after the other");
  }
};

/// How rows were made of stamps, over all runs.
struct Rows {
  double row_s = 0.0;                            ///< from row to row
  std::size_t stamps = 0, rows = 0, inputs = 0;  ///< in the files; judged; that drive the simulation
  double readings = 1.0;                         ///< in a row, on average
  double noise = 0.0, pressure_noise_Pa = 0.0;   ///< of a row's values, by what the readings scatter
  double step = 0.0;                             ///< that the readings are rounded to
  double given_noise_Pa = 0.0;                   ///< of a reading of a pressure that is given
  bool smoothed = false;                         ///< that pressure was
  std::size_t slack = 0;                         ///< readings of force that are none: the cord hung through

  friend bool operator==(const Rows&, const Rows&) = default;
};

struct Dataset {
  RigFile rig;
  ColumnMap columns;
  Recorded recorded{};
  std::vector<Run> runs;
  bool own_clock = false;  ///< runs are `measured`, stamp by stamp
  std::optional<Rows> rows_of_stamps;

  double row_s() const { return rows_of_stamps ? rows_of_stamps->row_s : rig.tick_s; }
  double rows_begin_s() const { return rows_of_stamps ? recorded.skip_s : 0.0; }
  /// A bench gives every run its length, and what is judged is the force.
  bool force_is_judged() const { return !runs.empty() && std::ranges::all_of(runs, &Run::length_is_given); }
  /// No run has a valve: the pressure is given.
  bool pressure_is_given() const {
    return std::all_of(runs.begin(), runs.end(), [](const Run& run) {
      return run.measured && run.measured->sides[0].pressure_is_given;
    });
  }

  std::filesystem::path path;     ///< of the file `dataset.yaml`
  std::vector<InputFile> inputs;  ///< the files it was read from

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("rig", self.rig, "the nominal rig: a shipped name, the path of a rig file, or changes in place");
    visit(
        "columns", self.columns,
        "where the runs' files hold what is wanted, and in which units; without it under our names, time_s, "
        "current_mA, contraction_ratio, muscle_pressure_bar");
    visit("start", self.recorded.start,
          "settled: at rest with the first input; moving: recorded from some instant on, the first state is "
          "estimated from the first readings");
    visit("skip", self.recorded.skip_s, "s", 0.0, 1e4, "so much of each run is simulated but not judged");
    visit("hold", self.recorded.hold,
          "what inputs do between stamps: previous (usual for commands) or linear (usual for pressures and "
          "lengths)");
    visit.required("runs", self.runs, "the runs");
  }
};

}  // namespace mckibben::domain
