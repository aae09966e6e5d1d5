// What was measured of a rig with a clock of its own: at each stamp what drove it and what was read, in
// columns of one length. A reading that is missing is NaN; a column that is not there is empty.
#pragma once

#include <array>
#include <vector>

namespace mckibben::domain {

struct Measurement {
  /// Of one muscle: a command to its valve, or its pressure, which then is given and the valve does not
  /// exist.
  struct Side {
    std::vector<double> current_mA;          ///< held from its stamp to the next
    std::vector<double> muscle_pressure_Pa;  ///< read; or given, and straight from stamp to stamp
    bool pressure_is_given = false;
  };
  std::vector<double> time_s;  ///< ascending
  std::array<Side, 2> sides;   ///< the second of a pair only
  std::vector<double> contraction_ratio;
  bool length_is_given = false;  ///< the contraction is, straight from stamp to stamp
  std::vector<double> force_N;   ///< of the muscle's cord
  std::vector<double> angle_rad;
  bool angle_in_degrees = false;  ///< as the file has it, and as its gap is told
  bool counted = false;           ///< contraction or angle are counts of the encoder
};

}  // namespace mckibben::domain
