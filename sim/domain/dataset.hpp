// Measured data sets: which runs there are, their loads and tables, and the rig they were measured on.
#pragma once

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
  std::optional<std::vector<double>> muscle_pressure_Pa;
  double ratio_per_unit = 1.0;  ///< of contraction: what one of its file's unit is
  double rest_length_m = 0.0;   ///< that its rise was divided by; 0: that of the rig it is compared with

  std::optional<Measurement> measured;  ///< in place of these three

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

struct Dataset {
  RigFile rig;
  ColumnMap columns;
  Recorded recorded{};
  std::vector<Run> runs;
  bool own_clock = false;  ///< runs are `measured`, stamp by stamp

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
