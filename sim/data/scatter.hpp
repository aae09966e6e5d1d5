// What single readings scatter by, and what neighbours say together: parabolas through them (least squares;
// Savitzky & Golay, Analytical Chemistry 36 (1964) 1627-1639), differences of higher order, steps they are
// rounded to. Readings that are missing are NaN.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <sim/domain/measurement.hpp>

namespace mckibben::data {

/// What the readings near an instant say together.
struct Together {
  double value = std::nan("");
  double gain = 0.0;     ///< of their noise's variance
  double squares = 0.0;  ///< left of the parabola, for each reading beyond three
  double worst = 0.0;    ///< that is left of one
  std::size_t readings = 0;
};

/// Readings at their stamps. Neither is copied.
class Column {
 public:
  Column(const std::vector<double>& time_s, const std::vector<double>& values)
      : time_s_(time_s), values_(values) {}

  /// A parabola through those within `half_s`; of fewer than four no value.
  Together near(double at_s, double half_s) const;

  /// What readings with white noise of a deviation say at an instant: of parabolas through ever more of them,
  /// from those within `half_s` on, the widest that agrees with the reading and with all narrower ones
  /// (Goldenshluger & Nemirovski, Mathematical Methods of Statistics 6 (1997) 135-170).
  double smooth(double at_s, double half_s, double noise) const;

  /// The last value at an instant, and what it is on average until another: held or straight from stamp to
  /// stamp.
  double mean(double from_s, double to_s, bool linear) const;

  /// Straight between stamps.
  double between(std::size_t k, double at_s) const {
    if (k + 1 >= values_.size()) return values_[k];
    const double share = (at_s - time_s_[k]) / (time_s_[k + 1] - time_s_[k]);
    return std::lerp(values_[k], values_[k + 1], std::clamp(share, 0.0, 1.0));
  }

  /// Stamps strictly between two instants.
  std::span<const double> stamps(double from_s, double to_s) const {
    const auto first = std::upper_bound(time_s_.begin(), time_s_.end(), from_s);
    const auto last = std::lower_bound(first, time_s_.end(), to_s);
    return {first, last};
  }
  double operator[](std::size_t k) const { return values_[k]; }
  std::size_t size() const { return values_.size(); }
  std::size_t last_before(double at_s) const {
    const auto after = std::upper_bound(time_s_.begin(), time_s_.end(), at_s);
    return after == time_s_.begin() ? 0 : static_cast<std::size_t>(after - time_s_.begin()) - 1;
  }

 private:
  const std::vector<double>&time_s_, &values_;
};

double range_of(const std::vector<double>& values);

/// Noise of single readings from what is left of parabolas; the median is blind to jumps.
double noise_of(const std::vector<double>& squares);

/// White noise of readings that come slowly, from their fourth differences, divided by their stamps'; of
/// those that are there, where never five are together.
double slow_noise(std::vector<double> time_s, std::vector<double> values);
/// As if rows were even: what stamps are off by counts as noise.
double slow_noise(std::vector<double> values);

/// Noise of settled points: what the last of four that go one way is off the parabola through the others,
/// over the input that moves most. The median is blind to where they turn.
double points_noise(const std::vector<double>& read, const std::vector<std::vector<double>>& inputs);

/// The step that readings are rounded to; 0 if they are to none.
double step_of(const std::vector<double>& values);

/// From the readings of the first moments, by a parabola. A run that begins on its way has enough of them.
domain::FirstState first_state(const domain::Measurement& measured);
/// Of the muscle's pressure alone; none if it was not read.
std::optional<double> first_pressure_Pa(const domain::Measurement& measured);

}  // namespace mckibben::data
