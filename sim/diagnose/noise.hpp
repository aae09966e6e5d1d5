// What the instruments cannot see, from the readings themselves: the width of a count, the jitter before it
// is counted, what equal runs differ by, the noise of gauges.
#pragma once

#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Root mean squares.
struct NoiseFloor {
  double count = 0.0;        ///< contraction ratio of one count; 0: the readings are not counted
  double jitter = 0.0;       ///< of the reading that is judged, before it is counted
  double judged = 0.0;       ///< of the reading that is judged: the largest of instruments and repeats
  double repeats = 0.0;      ///< of the same, between equal runs; 0: none are equal
  double pressure_Pa = 0.0;  ///< of the gauges; 0: none fitted
  double force_N = 0.0;      ///< of a force that was read beside; 0: none was
  double valve_Pa = 0.0;     ///< of a valve's pressure that was read beside; 0: none was
  double given = 0.0;        ///< of the reading that is judged, by the noise of a pressure that is given
  double command = 0.0;      ///< of the same, by what a regulator does not repeat
  double accuracy = 0.0;     ///< of the same, by the sensor's data sheet
  double middle = 0.0;       ///< what a counter's readings are too low by, on average
  bool noisy = false;        ///< the jitter is more than a count of the rig's encoder

  double beside(domain::Beside which) const {
    using enum domain::Beside;
    if (which == force) return force_N;
    return which == muscle_pressure || which == opposite_pressure ? pressure_Pa : valve_Pa;
  }
  /// What scatters, together with what data sheets say is off.
  double with_sheets(double scatter) const { return std::hypot(scatter, command, accuracy); }
};

/// `masked[run][row]` rows do not count. `trusted` runs are looked at, and compared where they are equal;
/// none: all are looked at, and none is compared.
///
/// Jitter of counted readings: counts that go back and forth. With d the differences from tick to tick, the
/// mean of -d(k) d(k+1) is 0 for a count that is passed once and grows with the jitter; what it should be at
/// a speed s, for all phases within a count alike, follows from E[n(k) - n(j)]^2 = E[y^2 + {y}(1 - {y})], y
/// normal round s (k - j) with twice the jitter's variance, {y} its fraction (a quantiser's second moment;
/// Widrow & Kollar, Quantization Noise, Cambridge 2008). Of other readings: fourth differences.
NoiseFloor noise_floor(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
                       std::vector<std::size_t> trusted);

}  // namespace mckibben::diagnose
