// Series of readings: ranges, medians, and straight lines through two beside each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace mckibben::data {

/// Largest less smallest.
inline double range(std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

inline double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// What such a share of them, for noise, is above.
inline double upper_share(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>((1.0 - share) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// The middle value; the larger of the middle two, if they are two.
inline double upper_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The middle value; the mean of the middle two, if they are two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Straight line through `values` over `model`; its slope is 0 where the model stands still, and its
/// correlation where one of them does.
struct Line {
  double slope = 0.0, correlation = 0.0, mean_difference = 0.0;

  Line(std::span<const double> values, std::span<const double> model) {
    const double mean = data::mean(values), model_mean = data::mean(model);
    double along = 0.0, squares = 0.0, model_squares = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      along += (values[k] - mean) * (model[k] - model_mean);
      squares += (values[k] - mean) * (values[k] - mean);
      model_squares += (model[k] - model_mean) * (model[k] - model_mean);
    }
    if (model_squares > 0.0) slope = along / model_squares;
    if (model_squares > 0.0 && squares > 0.0) correlation = along / std::sqrt(squares * model_squares);
    mean_difference = mean - model_mean;
  }
};

}  // namespace mckibben::data
