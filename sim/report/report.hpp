// report.html of the verbs that simulate: one self-contained page with the result, plots over time, loops and
// a drawing of the rig.
#pragma once

#include <string>
#include <vector>

#include <sim/input/dataset.hpp>
#include <sim/input/scenario.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::report {

/// Every load under every controller.
std::string report_html(const input::Scenario& scenario, const run::Comparison& comparison);

/// Measured runs and their simulation.
std::string report_html(const input::Dataset& dataset, const std::vector<run::ReplayedRun>& runs);

}  // namespace mckibben::report
