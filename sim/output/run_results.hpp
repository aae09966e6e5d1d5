// Results of runs and of campaigns: tables for a terminal, JSON, the picture of targets and contractions.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/domain/scenario.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::output {

/// Loads x controllers, each controller's spread over loads, gains that were tuned, and what to be warned of.
std::string table_of(const domain::Scenario& scenario, const run::Comparison& comparison);

/// How a run stands to its controller's calibration: "*" extrapolated,
/// "+" load taken as the range's end, or empty.
std::string extrapolation_mark(const run::TrackedRun& run);

/// "*" if one of a controller's runs is extrapolated, so that its mean over them is, too; " (3 of 4 loads)"
/// if some have no result.
std::string mean_mark(const run::Comparison& comparison, const std::string& controller);

/// That a run came to where braids end; empty if it did not. `who`: as the note calls it.
std::string contraction_note(const plant::Rig& rig, double reached, const std::string& who);

/// What a campaign gave, load by load; of a pair, current by current.
std::string table_of(const domain::Campaign& campaign, const std::vector<run::EndedRun>& ended);

/// Resolved input, versions, seed, tolerance, hashes of the input files, results and solver counts. Holds
/// nothing that differs between two runs of the same input.
std::string json_of(const domain::Scenario& scenario, const run::Comparison& comparison);

/// One picture: for each load a panel with the target and every controller's contraction.
std::string tracking_svg(const domain::Scenario& scenario, const run::Comparison& comparison);

/// Another: muscle pressure over contraction ratio, a panel for each load or pair of commands, of each
/// muscle.
std::string loops_svg(const domain::Scenario& scenario, const run::Comparison& comparison);

}  // namespace mckibben::output
