// Values of the calibrated models that more than one controller needs.
#include <cmath>

#include <controllers/calibration.hpp>

namespace mckibben::controllers {

double FrictionModel::coefficient(double contraction_ratio, double current_speed_mA_per_s) const {
  return f0 + f1_s2_per_mA2 * current_speed_mA_per_s * current_speed_mA_per_s + f2 * contraction_ratio +
         f3 * std::log(contraction_ratio);
}

double TubePull::pull_N(double contraction_ratio, double rest_length_m) const {
  return stiffness_N_per_m * rest_length_m * contraction_ratio -
         force_N * std::expm1(-contraction_ratio / ratio);
}

double at_load(const InLoad& polynomial, double load_kg) {
  double value = 0.0;
  for (const double coefficient : polynomial) value = value * load_kg + coefficient;
  return value;
}

}  // namespace mckibben::controllers
