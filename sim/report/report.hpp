// report.html of each verb: one self-contained page with the result and, of runs, plots over
// time, loops and a drawing of the rig.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/domain/scenario.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/error_map.hpp>
#include <sim/run/replay.hpp>
#include <sim/thesis/calibrate.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::report {

/// Every target with every load under every controller, and given currents.
std::string report_html(const domain::Scenario& scenario, const run::Comparison& comparison);

/// Measured runs and their simulation.
std::string report_html(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                        const std::vector<std::string>& warnings = {});

/// As a file of its own, a panel for each run: what the page's plots begin with, measured and simulated;
/// empty if nothing was simulated.
std::string tracking_svg(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs);

/// A campaign's measurements; runs with their rows.
std::string report_html(const domain::Campaign& campaign, const std::vector<run::EndedRun>& ended,
                        const domain::Dataset& dataset);

/// The models of a data set, and their figures.
std::string report_html(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                        const thesis::Options& options, bool kgf, const std::vector<thesis::Figure>& figures);

/// What a diagnosis found. `nominal` and `corrected`: the same runs replayed on the rig as described and as
/// corrected; may be empty.
std::string report_html(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis,
                        const std::vector<run::ReplayedRun>& nominal,
                        const std::vector<run::ReplayedRun>& corrected);

/// What that page opens with as a file of its own; empty if nothing was compared.
std::string before_after_svg(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis,
                             const std::vector<run::ReplayedRun>& nominal,
                             const std::vector<run::ReplayedRun>& corrected);

/// Error maps.
std::string report_html(const run::MapPlan& plan, const run::ErrorMaps& maps);

}  // namespace mckibben::report
