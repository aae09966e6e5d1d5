// Pictures that need no script: the tracking of each group and its loops, as SVG. Colours and dashes come
// from the page's style, by class. Axes of lengths have numbers in mm and as ratios, of which the style shows
// one set. The script finds its way on them by data-* attributes.
#pragma once

#include <string>

#include <sim/report/contents.hpp>

namespace mckibben::report {

/// How many ticks of a run are looked at in a report of so many runs.
std::size_t ticks_looked_at(std::size_t runs);

/// The main lines of a plot over time. `most` limits the ticks that are looked at, of which those within a
/// pixel are drawn as one.
std::string still_svg(const Group& group, const Plot& plot, const plant::Rig& rig, std::size_t most);

/// Two quantities of each run against each other; empty if no run has them.
std::string loop_svg(const Group& group, const Loop& loop, const plant::Rig& rig, std::size_t most);

}  // namespace mckibben::report
