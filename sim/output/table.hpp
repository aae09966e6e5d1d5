// Results as text for a terminal: the table a user came for.
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

/// That a run came to where braids end; empty if it did not. `who`: as the note calls it.
std::string contraction_note(const plant::Rig& rig, double reached, const std::string& who);

/// What a campaign gave, load by load; of a pair, current by current.
std::string table_of(const domain::Campaign& campaign, const std::vector<run::EndedRun>& ended);

}  // namespace mckibben::output
