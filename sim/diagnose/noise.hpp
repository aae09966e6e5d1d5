// What the instruments cannot see, from the readings themselves: the width of a count, the jitter before it
// is counted, what equal runs differ by, the noise of gauges.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Root mean squares.
struct NoiseFloor {
  double count = 0.0;     ///< contraction ratio of one count; 0: the readings are not counted
  double jitter = 0.0;    ///< of the reading that is judged, before it is counted
  double judged = 0.0;    ///< of the reading that is judged: the largest of instruments and repeats
  double repeats = 0.0;   ///< of the same, between equal runs; 0: none are equal
  double given = 0.0;     ///< of the reading that is judged, by the noise of a pressure that is given
  double command = 0.0;   ///< of the same, by what a regulator does not repeat
  double accuracy = 0.0;  ///< of the same, by the sensor's data sheet
  double middle = 0.0;    ///< what a counter's readings are too low by, on average
  bool noisy = false;     ///< the jitter is more than a count of the rig's encoder

  std::map<std::string_view, double> of_signal{};  ///< that was read beside it, by its key

  /// Of a reading beside the one that is judged; 0 if none of its signal was.
  double beside(const plant::Channel& channel) const {
    const auto at = of_signal.find(channel.signal->key);
    return at != of_signal.end() ? at->second : 0.0;
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
