// A whole diagnosis: the search, and all that is handed over of what it found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/identify.hpp>

namespace mckibben::identify {

/// Runs whose load is doubted, by their ids, and what is to be said of it.
struct LoadDoubt {
  std::vector<std::string> runs;
  std::string words;
};

/// What is handed over besides the search.
struct Reporting {
  std::uint64_t seed = 1;               ///< of resampling
  std::vector<std::string> warnings{};  ///< of the recordings, known before; reported first
  /// Doubts of the labels of loads, known before: reported where the diagnosis has not estimated these.
  std::vector<LoadDoubt> of_loads{};
};

/// The best that was found, also where the search was ended or decided nothing. Throws
/// engine::NumericalFailure, run::Interrupted.
diagnose::Diagnosis diagnosis_of(const Identified& found, const Settings& settings,
                                 const Reporting& reporting = {});

}  // namespace mckibben::identify
