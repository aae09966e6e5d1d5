// See the header.
#include <algorithm>
#include <cstddef>
#include <vector>

#include <sim/data/given_noise.hpp>
#include <sim/data/scatter.hpp>

namespace mckibben::data {
namespace {

constexpr double held = 1.0 / 3.0;    // of a command's readings repeat the one before: it is as it was sent
constexpr double least_noise = 1e-4;  // of a command's range: less may be how a smooth one bends
constexpr double most_noise = 0.02;   // of a command's range: more is what drives

double noise_of_readings(const std::vector<double>& time_s, const std::vector<double>& values, double row_s) {
  if (row_s == 0.0) return slow_noise(time_s, values);
  const Column column(time_s, values);
  std::vector<double> left;
  for (double at_s = time_s.front() + 0.5 * row_s; at_s < time_s.back(); at_s += row_s)
    left.push_back(column.near(at_s, 0.5 * row_s).squares);
  return noise_of(left);
}

/// Between neighbours among all values: a command lies on the steps of what sent it, or of how it was
/// written.
double least_step(std::vector<double> values) {
  std::ranges::sort(values);
  double least = range_of(values);
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double step = values[k] - values[k - 1]; step > 1e-12) least = std::min(least, step);
  return least;
}

}  // namespace

double noise_of_given(const domain::Measurement& recorded, const domain::MeasuredColumn& given,
                      double row_s) {
  if (!given.given || is_length(given) || recorded.point_s > 0.0) return 0.0;
  const std::vector<double>& values = given.values;
  const double noise = noise_of_readings(recorded.time_s, values, row_s);
  if (!given.is_command()) return noise;
  if (noise < least_step(values)) return 0.0;
  std::size_t repeated = 0;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] == values[k - 1]) ++repeated;
  const bool sent = static_cast<double>(repeated) > held * static_cast<double>(values.size());
  const double share = noise / range_of(values);
  return sent || share < least_noise || share > most_noise ? 0.0 : noise;
}

}  // namespace mckibben::data
