// The thesis's inverse (T 4.32 to 4.45): which current speed and which pressure bring a known load to a
// contraction ratio at a contraction speed.
#pragma once

#include <controllers/calibration.hpp>
#include <controllers/controller.hpp>

namespace mckibben::controllers {

enum class Branch { contraction, relaxation };

/// What the inverse asks for, and how far it had to leave the question asked.
struct Answer {
  double pressure_Pa = 0.0;
  double current_speed_mA_per_s = 0.0;  ///< magnitude, nu
  bool ratio_outside = false;           ///< contraction ratio beyond the calibrated range
  bool speed_outside = false;           ///< current speed beyond it
  bool unreachable = false;             ///< no current speed at all gives that contraction speed
};

/// Inverse for one load. Inside the calibrated range only, unless it is to extrapolate: what lies outside is
/// brought to the range's end, and marked either way.
class Inverse {
 public:
  Inverse(const Calibration& calibration, double load_kg, const ValveLine& valve, bool extrapolate);

  /// Pressure at a contraction ratio [1] and a contraction speed [1/s], whose sign is that of the branch.
  Answer operator()(Branch branch, double contraction_ratio, double contraction_speed_per_s) const;

  /// The pressure model itself [Pa], T 4.36 or T 4.43. Contraction ratio above 0.
  double pressure_Pa(Branch branch, double contraction_ratio, double current_speed_mA_per_s) const;

 private:
  struct Speed {
    double mA_per_s;
    bool unreachable;
  };
  Speed contraction_speed(double e, double w_per_s) const;
  Speed relaxation_speed(double e, double w_per_s) const;

  CalibratedRange range_;
  bool extrapolate_;
  double slope_Pa_per_mA_;
  double a0_, a1_0_, a1_1_, a2_0_, a2_1_, a3_, a4_;         // T 4.14 to 4.20 at this load
  double b0_0_, b0_1_, b1_, b2_, b3_, b4_0_, b4_1_, b4_2_;  // T 4.21 to 4.28
};

}  // namespace mckibben::controllers
