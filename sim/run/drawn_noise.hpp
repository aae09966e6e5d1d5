// The noise of instruments and valve, drawn as a run goes on.
#pragma once

#include <cstdint>
#include <random>

#include <plant/instruments.hpp>
#include <plant/rig.hpp>

namespace mckibben::run {

/// What the data sheet of the position's sensor says of its noise, as a contraction ratio, rms.
double position_noise(const plant::Rig& rig);

/// Draws the noise of one run: the same for the same seed and stream, whatever runs beside it.
class DrawnNoise {
 public:
  DrawnNoise(const plant::Noise& noise, const plant::Rig& rig, std::uint64_t seed, std::uint64_t stream);

  double of(plant::Sensed signal) { return of_sensors_[signal] * draw(); }
  double current_mA() { return noise_.current_mA * draw(); }
  /// Of the reference pressure; to be asked once a tick.
  double reference_Pa(double time_s);

 private:
  /// Also where a kind of noise is absent, so that the others do not change with it; but for nothing at all.
  double draw() { return is_none_ ? 0.0 : normal_(random_); }

  plant::Noise noise_;
  plant::BySensed of_sensors_;
  bool is_none_;
  double kept_, phase_ = 0.0, wander_ = 0.0;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace mckibben::run
