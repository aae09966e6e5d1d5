// What a recording has to show, and the plots and loops it is shown in. Forces are those that the plant gave
// while it ran.
#pragma once

#include <vector>

#include <plant/plant.hpp>
#include <sim/report/contents.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::report {

/// Refers to `recording` and copies `plant`.
std::vector<Quantity> quantities_of(const run::Recording& recording, const plant::Plant& plant);

/// What lies beside the page in a folder of runs.
inline constexpr std::string_view beside_runs =
    "Every number of every tick is in the CSV files beside this page; "
    "input, versions and hashes are in run.json.";

/// The plots for a rig, beginning with that of contraction, which has this title. `wanted` is the label of
/// what is given there (key "given_contraction"); `gauge` tells that muscle pressure was measured (key
/// "given_pressure"), and what the simulation makes of it is wrong by "pressure_error".
std::vector<Plot> plots_for(const plant::Rig& rig, const std::string& title, const std::string& wanted,
                            const std::string& error, bool gauge);

std::vector<Loop> loops();

/// The same of what is measured alone: contraction, current, the pressure asked for by the valve's line, and
/// that of the gauge where there is one.
std::vector<Plot> measured_plots();
std::vector<Loop> measured_loops();

}  // namespace mckibben::report
