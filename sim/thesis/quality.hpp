// How good a calibration is, in words: the spread of the samples round each model, beside what the thesis
// reports of its own (T 5: friction below 10 %, pressure below 15 %).
#pragma once

#include <array>
#include <string>

#include <sim/thesis/calibrate.hpp>

namespace mckibben::thesis {

inline constexpr double printed_friction_spread = 0.10, printed_pressure_spread = 0.15;  ///< T 5: "below"
inline constexpr double largest_usable_spread = 1.0;  ///< above it samples scatter by more than the mean

struct Quality {
  enum class Model { friction, pressure };
  enum class Grade { good, rough, not_usable };

  Model model = Model::friction;
  Direction direction = Direction::contraction;
  double spread = 0.0;  ///< standard deviation over mean, 1 for 100 %; of the fit that calibration.yaml holds

  double printed_spread() const {
    return model == Model::friction ? printed_friction_spread : printed_pressure_spread;
  }
  Grade grade() const;
  std::string name() const;     ///< for example "friction in contraction"
  std::string meaning() const;  ///< whether that is good, and by what measure; without full stop
};

/// Friction and pressure, each in contraction and in relaxation.
std::array<Quality, 4> quality_of(const CalibrationResult& result, const Options& options);

}  // namespace mckibben::thesis
