// What the page of a diagnosis opens with: of a run that no fit has seen what was measured, the rig as
// described and the rig as it was found, over time and as a loop; what they leave against the noise floor;
// where on the rig it sits that was added, how large it is, and what it does to a loop.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/report/contents.hpp>

namespace mckibben::report {

/// Of the runs held out (if there are none, of all that were not left out) the one whose error shrank most;
/// null if none was compared.
const diagnose::RunGap* telling_run(const diagnose::Diagnosis& diagnosis);

/// As HTML. `run`: what the page shows of this run. `plots`: over time, the first and the one named `error`.
std::string opening_html(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis, const Group& run,
                         const std::vector<Plot>& plots, const Loop& loop);

/// The same as a file of its own.
std::string opening_svg(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis, const Group& run,
                        const std::vector<Plot>& plots, const Loop& loop);

}  // namespace mckibben::report
