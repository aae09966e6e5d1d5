// Tables and paragraphs of a page. Of many runs a few lines: by load, with the worst named; and how a page
// leads to the plots of a run.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include <plant/rig.hpp>

namespace mckibben::report {

// Their text is escaped.

/// A row of a table. `head` may break after its underscores.
std::string row(const std::string& head, std::initializer_list<std::string> cells);
/// Shown on a click.
std::string folded(const std::string& summary, const std::string& html);
std::string table(const std::string& caption, std::initializer_list<const char*> head,
                  const std::string& rows);
std::string paragraph(const std::string& text);

/// Above so many, a page begins with a summary and its runs are in order of their error, the worst first.
inline constexpr std::size_t many_runs = 12;

/// One run, how wrong its simulation is, and the group of the page that draws it.
struct RunError {
  std::string id;
  double load_kg = 0.0;
  double rmse = 0.0;  ///< contraction ratio
  std::size_t group = 0;
};

/// A row for each load, the lightest first: how many runs, median and largest error, which run has that.
std::string by_load_html(const std::vector<RunError>& runs, const plant::Rig& rig);

/// `text`, which leads to the plots of a group.
std::string link_html(std::size_t group, const std::string& text);

}  // namespace mckibben::report
