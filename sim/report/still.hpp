// Pictures that need no script: the tracking of each group and its loops, as SVG. Colours and dashes come
// from the page's style, by class. Axes of lengths have numbers in mm and as ratios, of which the style shows
// one set. The script finds its way on them by data-* attributes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sim/output/axes.hpp>
#include <sim/report/contents.hpp>

namespace mckibben::report {

/// Size of a picture [px].
inline constexpr double still_width = 460.0, still_height = 300.0;

/// How many ticks of a run are looked at in a report of so many runs.
std::size_t ticks_looked_at(std::size_t runs);

/// The main lines of a plot over time. `most` limits the ticks that are looked at, of which those within a
/// pixel are drawn as one.
std::string still_svg(const Group& group, const Plot& plot, const plant::Rig& rig, std::size_t most);

/// Two quantities of each run against each other; empty if no run has them.
/// `only`: one of its runs, with the axes of all; none: all of them.
std::string loop_svg(const Group& group, const Loop& loop, const plant::Rig& rig, std::size_t most,
                     const Run* only = nullptr);

// Parts of such pictures, for those that lay out their own.

/// A line as it is drawn, and where it goes; NaN lifts the pen.
struct Curve {
  std::string kind;  ///< class and data-run
  bool dots = false;
  bool shown = true;  ///< if not, it only holds its place on the axes
  std::vector<std::pair<double, double>> points{};
};
std::vector<Curve> curves_over_time(const Group& group, const Plot& plot, const plant::Rig& rig,
                                    std::size_t most);
std::vector<Curve> curves_of(const Group& group, const Loop& loop, std::size_t most,
                             const Run* only = nullptr);

/// Makes room for them.
void hold(const std::vector<Curve>& curves, output::Panel& panel);

/// Axes in the units that the reader wants. Without words an axis has no numbers either.
std::string axes_svg(const output::Panel& panel, const std::string& x_label, const std::string& y_label,
                     const plant::Rig& rig);
std::string curve_svg(const Curve& curve, const output::Panel& panel);

}  // namespace mckibben::report
