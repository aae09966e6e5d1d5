// Two folders that `diagnose` wrote, compared: a rig before and after, or one with two nominal rigs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sim/input/json.hpp>

namespace mckibben::cli {

/// A number of one diagnosis with its 95 % interval.
struct Told {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// A number of the corrected rigs: "muscle_leak.conductance", "muscle.rest_radius".
struct NumberDifference {
  std::string name, unit;
  std::optional<Told> left, right;  ///< none: an effect that is not there, or a number that was not fitted
  bool of_effect = false;

  /// Right less left, in standard errors of the difference as the intervals tell them; 0 if one is missing.
  double deviations() const;
  /// Beyond chance, among as many numbers as a rig has; an effect that only one has is a change, too.
  bool changed() const;
};

struct DiagnosisDifference {
  std::string left_verdict, right_verdict;
  std::vector<NumberDifference> numbers;  ///< effects first, then the rig's
  /// Errors on the runs held out, by their keys in `gap`.
  struct Error {
    std::string key;
    double left = 0.0, right = 0.0;
  };
  std::vector<Error> errors;
  std::string unit;  ///< of the errors

  bool changed() const;
};

/// Whether `diagnose` wrote this folder.
bool is_diagnosis_folder(const std::filesystem::path& path);

/// Throws MissingInput or BadInput if one holds something else than a diagnosis.
DiagnosisDifference compare_diagnoses(const std::filesystem::path& left, const std::filesystem::path& right);

input::Json json_of(const DiagnosisDifference& found);
std::string text_of(const DiagnosisDifference& found);

}  // namespace mckibben::cli
