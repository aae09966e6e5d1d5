// What is drawn of a rig: the signals of a recording, and the plots and loops that show them, of one muscle
// and of two. What was measured or wanted of a signal X has the key given_X; the error of what a page is
// about is `error`, of anything else X_error. Units are those of pages (plant/signals.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <plant/signals.hpp>
#include <sim/report/contents.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::report {

inline constexpr double in_degrees = 1.0 / plant::degree_rad;

/// What lies beside the page in a folder of runs.
inline constexpr std::string_view beside_runs =
    "Every number of every tick is in the CSV files of this folder; "
    "input, versions and hashes are in run.json.";

/// Whether the valve's command is a pressure: that of valves that are open or shut asks for none.
inline bool asks_for_pressure(const plant::Rig& rig) {
  return !rig.valve.is_on_off();
}

/// What loops are drawn over, as it was given: the pressure asked for; where none is, what the gauge read if
/// there is one, or else the command.
struct LoopOver {
  std::string key, words, label;
};
LoopOver loop_over(const plant::Rig& rig, bool gauged, const std::string& of_muscle = "");

/// Every signal of a recording, without pressures that are not asked for. Refers to it.
std::vector<Quantity> quantities_of(const run::Recording& recording, const plant::Rig& rig);

/// What a page draws over time.
struct PlotsOf {
  run::Driven driven{};
  /// What it is about: contraction_ratio, force, or of a pair angle; its title; what was measured or wanted
  /// of it, and the title of the error: none if empty.
  std::string key = "contraction_ratio", title{}, given{}, error{};
  bool commands = true;                                          ///< drove it, or a pressure did
  bool pressure = false, valve_pressure = false, force = false;  ///< were measured besides
  std::string off = "simulated less measured";                   ///< what their errors are
};

/// What a page is about comes first, with its error; then what made it.
std::vector<Plot> plots_of(const plant::Rig& rig, const PlotsOf& of);
/// Loops of the cord's force where it is measured or a length is given.
std::vector<Loop> loops_of(const plant::Rig& rig, const run::Driven& driven);

/// The same of what is measured alone: position, currents, the pressures asked for by the valves' lines, and
/// those of gauges where there are any.
std::vector<Plot> measured_plots(const plant::Rig& rig, bool pair);
std::vector<Loop> measured_loops(const plant::Rig& rig, bool gauged);

}  // namespace mckibben::report
