// Estimates of noise; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <sim/diagnose/noise.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

using Runs = std::vector<std::size_t>;

/// What no sensor of a lab does better, and no simulation needs to [contraction ratio].
constexpr double least_floor = 5e-5;

/// The last decimal that any reading has, for files rounded to a few: 0 if there are more than seven.
double last_decimal(const domain::Dataset& data, const Runs& runs) {
  double unit = 1e-3;
  for (const std::size_t run : runs) {
    for (const double ratio : data.runs[run].contraction_ratio) {
      while (std::abs(ratio / unit - std::round(ratio / unit)) > 1e-6) {
        unit /= 10.0;
        if (unit < 1e-7) return 0.0;
      }
    }
  }
  return unit;
}

/// Whether the readings are whole counts to the last decimal, but for a few that something else has spoilt.
bool counted(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs,
             double count, double decimal) {
  const double tolerance = 0.01 + 0.5 * decimal / count;
  if (tolerance > 0.2) return false;  // everything would be whole
  std::size_t whole = 0, all = 0;
  for (const std::size_t i : runs) {
    for (std::size_t k = 0; k < data.runs[i].contraction_ratio.size(); ++k) {
      if (masked[i][k]) continue;
      const double counts = data.runs[i].contraction_ratio[k] / count;
      ++all;
      whole += std::abs(counts - std::round(counts)) <= tolerance ? 1 : 0;
    }
  }
  return 100 * whole >= 99 * all;
}

/// Noise of the gauges from the second differences of what they show: what changes so fast is not the gas.
double gauge_noise_Pa(const domain::Dataset& data, const Runs& runs) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::size_t index : runs) {
    const domain::Run& run = data.runs[index];
    if (!run.muscle_pressure_Pa) continue;
    const auto& p = *run.muscle_pressure_Pa;
    std::vector<double> second;
    for (std::size_t k = 2; k < p.size(); ++k) second.push_back(std::abs(p[k] - 2.0 * p[k - 1] + p[k - 2]));
    if (second.empty()) continue;
    // The median is blind to the few ticks at which the gas itself turns.
    std::nth_element(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(second.size() / 2),
                     second.end());
    const double deviation = second[second.size() / 2] / 0.6745 / std::sqrt(6.0);
    squares += deviation * deviation;
    ++count;
  }
  return count == 0 ? 0.0 : std::max(std::sqrt(squares / static_cast<double>(count)), 50.0);
}

/// White noise of the contraction ratio, from its fourth differences: no load moves so fast, and the median
/// is blind to single jumps.
double scatter(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs) {
  std::vector<double> fourth;
  for (const std::size_t i : runs) {
    const auto& e = data.runs[i].contraction_ratio;
    for (std::size_t k = 4; k < e.size(); ++k)
      if (std::none_of(masked[i].begin() + static_cast<std::ptrdiff_t>(k - 4),
                       masked[i].begin() + static_cast<std::ptrdiff_t>(k + 1), std::identity{}))
        fourth.push_back(std::abs(e[k] - 4.0 * e[k - 1] + 6.0 * e[k - 2] - 4.0 * e[k - 3] + e[k - 4]));
  }
  if (fourth.empty()) return 0.0;
  const auto middle = fourth.begin() + static_cast<std::ptrdiff_t>(fourth.size() / 2);
  std::nth_element(fourth.begin(), middle, fourth.end());
  return *middle / 0.6745 / std::sqrt(70.0);
}

/// Scatter of the contraction ratio between runs of the same current and load; 0 if there are none.
double repeatability(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
                     const Runs& trusted) {
  double squares = 0.0, count = 0.0;
  for (auto a = trusted.begin(); a != trusted.end(); ++a) {
    for (auto b = std::next(a); b != trusted.end(); ++b) {
      const domain::Run &one = data.runs[*a], &other = data.runs[*b];
      if (one.load_kg != other.load_kg || one.current_mA != other.current_mA) continue;
      for (std::size_t k = 0; k < one.contraction_ratio.size(); ++k) {
        if (masked[*a][k] || masked[*b][k]) continue;
        const double difference = one.contraction_ratio[k] - other.contraction_ratio[k];
        squares += 0.5 * difference * difference;
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// Mean of -d(k) d(k+1) for counts passed at `speed` with `jitter`, both in counts.
double back_and_forth(double speed, double jitter) {
  double mean = jitter * jitter - speed * speed + 1.0 / 12.0;
  for (int k = 1; k <= 40; ++k) {
    const double wave = 2.0 * std::numbers::pi * k, fading = std::exp(-wave * wave * jitter * jitter);
    mean -= fading * (std::cos(wave * speed) - 0.5 * std::cos(2.0 * wave * speed)) / (0.25 * wave * wave);
  }
  return mean;
}

/// Whether the load goes straight on within `reach` ticks each way: else its speed is not what the ends say.
bool straight(const std::vector<double>& e, std::size_t k, std::size_t reach, double count) {
  const auto near = [&](std::size_t at) { return (e[at - 1] + e[at] + e[at + 1]) / (3.0 * count); };
  return std::abs(near(k + reach - 1) - 2.0 * near(k) + near(k - reach + 1)) < 2.0;
}

/// Jitter before counting, in counts.
double dither(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs,
              double count) {
  constexpr std::size_t reach = 6;  // ticks each way, over which the load's speed is taken as steady
  constexpr double fastest = 1.0;   // counts a tick: faster, the speed matters more than the jitter
  constexpr double largest = 6.0;   // counts of a difference: more is a jump
  constexpr std::size_t bins = 25;
  double squares = 0.0;
  for (std::size_t j = 1; j <= reach; ++j) squares += 2.0 * static_cast<double>(j * j);
  std::array<double, bins> rows{};
  double sum = 0.0;
  for (const std::size_t i : runs) {
    const auto& e = data.runs[i].contraction_ratio;
    for (std::size_t k = reach; k + reach < e.size(); ++k) {
      const auto first = masked[i].begin() + static_cast<std::ptrdiff_t>(k - reach);
      if (std::any_of(first, first + 2 * reach + 1, std::identity{}) || !straight(e, k, reach, count))
        continue;
      double slope = 0.0;
      for (std::size_t j = 1; j <= reach; ++j)
        slope += static_cast<double>(j) * (e[k + j] - e[k - j]) / count;
      const double speed = std::abs(slope / squares);
      const double before = (e[k] - e[k - 1]) / count, after = (e[k + 1] - e[k]) / count;
      if (speed >= fastest || std::max(std::abs(before), std::abs(after)) > largest) continue;
      rows[static_cast<std::size_t>(speed / fastest * bins)] += 1.0;
      sum -= before * after;
    }
  }
  const auto expected = [&](double jitter) {
    double total = 0.0;
    for (std::size_t bin = 0; bin < bins; ++bin)
      if (rows[bin] > 0.0)
        total += rows[bin] * back_and_forth((static_cast<double>(bin) + 0.5) / bins * fastest, jitter);
    return total;
  };
  double low = 0.0, high = 2.0;
  if (sum <= expected(low)) return 0.0;
  while (high - low > 1e-4) (expected(0.5 * (low + high)) < sum ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

}  // namespace

NoiseFloor noise_floor(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
                       std::vector<std::size_t> trusted) {
  NoiseFloor floor;
  const double count = run::contraction_per_count(data.rig);
  floor.repeats = repeatability(data, masked, trusted);
  if (trusted.empty()) {
    trusted.resize(data.runs.size());
    std::iota(trusted.begin(), trusted.end(), std::size_t{0});
  }
  const double decimal = last_decimal(data, trusted);
  if (counted(data, masked, trusted, count, decimal)) floor.count = count;
  const double rounding = std::hypot(floor.count, decimal) / std::sqrt(12.0);
  const double noise = scatter(data, masked, trusted);
  floor.jitter = std::sqrt(std::max(0.0, noise * noise - rounding * rounding));
  floor.noisy = floor.jitter > count;
  if (floor.count > 0.0 && !floor.noisy) floor.jitter = count * dither(data, masked, trusted, count);
  floor.ratio = std::max({floor.repeats, std::hypot(rounding, floor.jitter, tolerance), least_floor});
  floor.pressure_Pa = gauge_noise_Pa(data, trusted);
  return floor;
}

}  // namespace mckibben::diagnose
