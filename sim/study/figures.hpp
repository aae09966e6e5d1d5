// The figures that the thesis prints for its accuracy (T 4.3, 5) beside the same ones of the simulated rig.
#pragma once

#include <sim/study/study.hpp>

namespace mckibben::study {

/// A load weighed by the thesis's controller in five contractions.
struct Weighing {
  double load_kg = 0.0, weighed_kg = 0.0, spread_kg = 0.0;
  std::string failure;  ///< why it could not be weighed; empty if it was

  double error() const { return weighed_kg / load_kg - 1.0; }
};

/// What the thesis prints.
inline constexpr double printed_load_kg = 8.87, printed_weighed_kg = 9.45;
inline constexpr double printed_error = 0.065;         ///< T 4.3; of 8.87 kg
inline constexpr double printed_largest_error = 0.15;  ///< T 5: "below"

Weighing weigh(const Evidence& evidence, const thesis::CalibrationResult& calibration, double load_kg);
Study study_figures(const Evidence& evidence);

}  // namespace mckibben::study
