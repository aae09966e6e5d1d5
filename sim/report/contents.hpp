// What a report shows, whatever verb it is of: a sentence, a table, and runs in groups (one load each) whose
// quantities are drawn over time in a few plots and against each other in loops.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <plant/rig.hpp>

namespace mckibben::report {

/// Value of a quantity at a tick, in the unit of its plot; NaN where there is none.
using AtTick = std::function<double(std::size_t)>;

struct Quantity {
  std::string key;
  AtTick at;
};

/// One controller, or the simulation of one measured run.
/// What it does not have of its own is what was given to its group.
struct Run {
  std::string name;
  std::size_t style = 0;  ///< which colour and dash; the same in every group
  std::size_t ticks = 0;  ///< rows there are: fewer than the group's if the run ended early
  std::vector<Quantity> quantities{};
};

/// What is compared with each other: the runs with one load, and what was given to all of them.
struct Group {
  std::string name;
  double load_kg = 0.0;
  std::size_t ticks = 0;
  std::vector<double> time_s{};   ///< of each row, if it is not a tick
  std::vector<Quantity> given{};  ///< target, or what was measured
  std::vector<Run> runs{};
  std::optional<double> rmse{};  ///< what runs are chosen by, contraction ratio
};

/// One line of a plot, by the key of its quantity. Where many runs are compared, only main lines are drawn
/// until others are asked for.
struct Line {
  std::string key, label;
  bool given = false, main = false;
};

struct Plot {
  std::string id, title, unit;
  std::vector<Line> lines;
  bool still = false;  ///< a picture of it is there without scripts too
  /// Above 0: what cannot be seen, marked by two lines. The axis is linear within it, logarithmic beyond.
  double floor = 0.0;
};

/// Two quantities of the same run against each other.
struct Loop {
  std::string id, title, x, y, x_label, y_label;  ///< an axis labelled `ratio_unit` shows lengths as wanted
  bool dots = false;                              ///< a dot for each tick in place of a line
  std::string given_x{}, given_y{};               ///< what was measured of the same, if it was
};

/// A picture that is drawn already.
struct Picture {
  std::string caption;  ///< may be empty
  std::string svg;
};

/// A headed part of the page, as HTML; left out if it is empty.
struct Chapter {
  std::string title, html;
  bool on_paper = true;  ///< if not, it is printed only where the reader asks for all
};

struct Contents {
  std::string title, about;
  std::vector<std::string> warnings{};
  std::string sentence{};                 ///< the result in one sentence, as HTML
  std::string opening{};                  ///< a picture of it, as HTML; may be empty
  std::string table{};                    ///< the result as HTML
  std::string details{};                  ///< all of it, as text
  std::string beside{};                   ///< what is where in the folder
  std::vector<Chapter> chapters{};        ///< before the runs
  std::vector<Chapter> later_chapters{};  ///< after them
  bool short_on_paper = false;            ///< runs are printed only where the reader asks for all
  bool handed_out = false;                ///< others get it: called as its folder, nothing about effects
  bool lengths = true;                    ///< it has some, and the reader may choose their unit
  plant::Rig rig{};                       ///< as it is drawn
  bool gauge = false;                     ///< muscle pressure was measured
  std::vector<Plot> plots{};
  std::vector<Loop> loops{};
  std::vector<Group> groups{};
  std::size_t drawn = 0;  ///< which run of a group is drawn as the rig at first
};

}  // namespace mckibben::report
