// Two folders that `run` or `replay` wrote, compared: what went in, what came out, tick by tick.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sim/input/fields_json.hpp>

namespace mckibben::cli {

/// A value that is not the same in both; null where it is absent.
struct Difference {
  std::string key;  ///< its way through the document: scenario.controllers[pid].sample_ticks
  input::Json left, right;
};

/// One column of a run's CSV, over the rows that both have.
struct ColumnDifference {
  std::string name;  ///< with its unit, as in the file
  double largest = 0.0, at_s = 0.0, rms = 0.0;
};

struct RunDifference {
  std::string name;  ///< the id of a replayed run, or load and controller
  std::vector<Difference> metrics;
  std::vector<ColumnDifference> columns;
  std::string note;  ///< why something could not be compared; empty if all was

  const ColumnDifference* find(std::string_view column) const;
  bool same() const;
};

struct FolderDifference {
  std::vector<Difference> inputs, tuned;
  std::vector<RunDifference> runs;  ///< those that both have, in the first one's order
  std::vector<std::string> only_left, only_right;

  bool same_runs() const;
  /// Whether each run is in both and its contraction ratio differs by no more than that at any tick.
  bool within(double tolerance) const;
};

/// Reads both and compares. Throws MissingInput if one is no such folder, BadInput if it holds something else
/// or one is of `run` and the other of `replay`.
FolderDifference compare_run_folders(const std::filesystem::path& left, const std::filesystem::path& right);

}  // namespace mckibben::cli
