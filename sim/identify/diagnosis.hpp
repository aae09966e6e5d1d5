// A whole diagnosis: the search, and all that is handed over of what it found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/identify.hpp>

namespace mckibben::identify {

/// What is handed over besides the search.
struct Reporting {
  std::uint64_t seed = 1;               ///< of resampling
  std::vector<std::string> warnings{};  ///< of the recordings, known before; reported first
};

/// The best that was found, also where the search was ended or decided nothing. Throws
/// engine::NumericalFailure, run::Interrupted.
diagnose::Diagnosis diagnosis_of(const Identified& found, const Settings& settings,
                                 const Reporting& reporting = {});

}  // namespace mckibben::identify
