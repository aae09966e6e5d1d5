// What is wrong with measured data. `check`, `replay`, `diagnose` and Python say it in the same words; the
// reader of a data set's file knows where it stands there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// What follows from it.
enum class Severity {
  refused,      ///< the numbers are not what they are called: nothing follows from them
  doubtful,     ///< to be looked at
  left_out,     ///< a diagnosis does without these runs,
  masked,       ///< without these readings,
  ignored,      ///< without this gauge,
  taken_out,    ///< or without this part of the readings
  unusable,     ///< a diagnosis is refused,
  undecidable,  ///< would find nothing,
  limited       ///< or cannot tell some effects from others
};

/// A run and the load that it seems to have.
struct SeemingLoad {
  std::size_t run;
  double load_kg;
};

struct Finding {
  std::string quantity{};  ///< key in the data set's file: contraction, load; empty: a run as a whole
  std::vector<std::size_t> runs{};  ///< ascending; none: the data set as a whole
  std::string message;              ///< what is wrong, and what to write instead
  Severity severity = Severity::refused;
  std::string kind{};                    ///< as in diagnosis.json: frozen, saturated, reading
  bool told = false;                     ///< before anything was simulated: what follows from it is new
  std::vector<SeemingLoad> exchanged{};  ///< loads that have each other's labels, and what they should be
};

/// One finding for all runs of which the same is to be said; `seen` is of the first.
void add(std::vector<Finding>& findings, const std::string& quantity, const std::vector<std::size_t>& runs,
         const std::string& seen, const std::string& so, Severity severity = Severity::refused);

/// As "run r02: MESSAGE", "runs r01, r02: MESSAGE" or "all runs: MESSAGE".
std::string text_of(const domain::Dataset& data, const Finding& finding);
/// What a diagnosis does about it: "; left out". Empty if nothing.
std::string_view consequence_of(const Finding& finding);

/// Whether somebody is refused because of it.
bool is_error(const Finding& finding);

/// Whether it only concerns those who want a diagnosis.
bool only_limits_diagnosis(const Finding& finding);

/// A data set that can be read but not used (exit status 65). `what()` has a line for each finding.
class UnfitData : public std::runtime_error {
 public:
  UnfitData(const domain::Dataset& data, std::vector<Finding> findings);
  /// The finding concerns the data set as a whole.
  UnfitData(const domain::Dataset& data, std::string message)
      : UnfitData(data, std::vector<Finding>{{.message = std::move(message)}}) {}

  const std::filesystem::path& path() const { return path_; }
  /// Their messages name the runs.
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::filesystem::path path_;
  std::vector<Finding> findings_;
};

/// The findings with messages that name the runs.
std::vector<Finding> with_runs_named(const domain::Dataset& data, std::vector<Finding> findings);

/// Throws UnfitData with all findings if one of them is `refused`;
void raise(const domain::Dataset& data, const std::vector<Finding>& findings);
/// or, for a diagnosis, `unusable`.
void raise_for_diagnosis(const domain::Dataset& data, const std::vector<Finding>& findings);

}  // namespace mckibben::data
