// Averages over neighbours and differences; see the header.
#include <array>
#include <functional>
#include <numeric>
#include <utility>

#include <Eigen/LU>
#include <Eigen/QR>

#include <sim/data/scatter.hpp>
#include <sim/data/series.hpp>

namespace mckibben::data {
namespace {

constexpr double normal_median = 0.6745;  // of the size of a normal variable. Derived
constexpr double first_moments_s = 0.04;  // what a load does in them is a parabola
constexpr std::size_t least_readings = 4;
constexpr double agrees = 2.0;    // deviations. A convention: 95 %
constexpr double wider = 1.5;     // than the parabola before
constexpr double widest_s = 0.1;  // half of a parabola: by then a muscle's pressure has moved on
constexpr double steps_that_are_whole = 0.95, whole = 0.05;

/// Value, slope and curvature at the first stamp, of what is read in the first moments.
std::array<double, 3> parabola(const std::vector<double>& time_s, const std::vector<double>& values) {
  std::vector<double> at, read;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double since_s = time_s[k] - time_s.front();
    if (since_s > first_moments_s && at.size() >= least_readings) break;
    if (std::isnan(values[k])) continue;
    at.push_back(since_s);
    read.push_back(values[k]);
  }
  const auto rows = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd powers(rows, 3);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double since_s = at[static_cast<std::size_t>(row)];
    powers.row(row) << 1.0, since_s, 0.5 * since_s * since_s;
  }
  const Eigen::Vector3d fitted =
      powers.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(read.data(), rows));
  return {fitted[0], fitted[1], fitted[2]};
}

}  // namespace

Together Column::near(double at_s, double half_s) const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Together result;
  const auto first = static_cast<std::size_t>(
      std::lower_bound(time_s_.begin(), time_s_.end(), at_s - half_s) - time_s_.begin());
  const auto each = [&](const auto& visit) {
    for (std::size_t k = first; k < time_s_.size() && time_s_[k] <= at_s + half_s; ++k) {
      const double x = (time_s_[k] - at_s) / half_s;
      if (!std::isnan(values_[k])) visit(Eigen::Vector3d(1.0, x, x * x), values_[k]);
    }
  };
  each([&](const Eigen::Vector3d& powers, double value) {
    normal += powers * powers.transpose();
    right += powers * value;
    ++result.readings;
  });
  if (result.readings < 4) return result;
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Vector3d fitted = inverse * right;
  result.value = fitted[0];
  result.gain = inverse(0, 0);
  each([&](const Eigen::Vector3d& powers, double value) {
    const double left = value - powers.dot(fitted);
    result.squares += left * left / static_cast<double>(result.readings - 3);
    result.worst = std::max(result.worst, std::abs(left));
  });
  return result;
}

double Column::smooth(double at_s, double half_s, double noise) const {
  double value = between(last_before(at_s), at_s);
  double low = value - agrees * noise, high = value + agrees * noise;
  for (; noise > 0.0 && half_s <= widest_s; half_s *= wider) {
    const Together wide = near(at_s, half_s);
    if (std::isnan(wide.value)) continue;
    const double off = agrees * noise * std::sqrt(wide.gain);
    low = std::max(low, wide.value - off);
    high = std::min(high, wide.value + off);
    if (low > high) break;
    value = wide.value;
  }
  return value;
}

double Column::mean(double from_s, double to_s, bool linear) const {
  auto k =
      static_cast<std::size_t>(std::upper_bound(time_s_.begin(), time_s_.end(), from_s) - time_s_.begin());
  k = k > 0 ? k - 1 : 0;
  double sum = 0.0;
  for (double at_s = from_s; at_s < to_s; ++k) {
    const double until_s = k + 1 < time_s_.size() ? std::min(time_s_[k + 1], to_s) : to_s;
    sum += (linear ? between(k, 0.5 * (at_s + until_s)) : values_[k]) * (until_s - at_s);
    at_s = until_s;
  }
  return sum / (to_s - from_s);
}

double range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0.0 : *high - *low;
}

double noise_of(const std::vector<double>& squares) {
  return squares.empty() ? 0.0 : std::sqrt(upper_median(squares));
}

namespace {

/// What a value is off the polynomial through the others, for a deviation of 1 of each: a divided difference.
double off(std::span<const double> at, std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(at);
  double difference = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (j != i) weight *= (high - low) / (at[i] - at[j]);
    difference += weight * values[i];
    squares += weight * weight;
  }
  return std::abs(difference) / std::sqrt(squares);
}

/// The median is blind to jumps.
double deviation(std::vector<double> off) {
  std::erase_if(off, [](double one) { return std::isnan(one); });
  return off.empty() ? 0.0 : upper_median(std::move(off)) / normal_median;
}

}  // namespace

double slow_noise(std::vector<double> time_s, std::vector<double> values) {
  constexpr std::size_t five = 5;
  const auto noise = [&] {
    std::vector<double> of;
    for (std::size_t k = five; k <= values.size(); ++k)
      of.push_back(off({&time_s[k - five], five}, {&values[k - five], five}));
    return deviation(std::move(of));
  };
  if (const double together = noise(); together > 0.0) return together;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::isnan(values[k])) time_s[k] = std::nan("");
  std::erase_if(time_s, [](double one) { return std::isnan(one); });
  std::erase_if(values, [](double one) { return std::isnan(one); });
  return noise();
}

double slow_noise(std::vector<double> values) {
  std::vector<double> rows(values.size());
  std::iota(rows.begin(), rows.end(), 0.0);
  return slow_noise(std::move(rows), std::move(values));
}

double points_noise(const std::vector<double>& read, const std::vector<std::vector<double>>& inputs) {
  constexpr std::size_t four = 4;
  std::vector<double> of;
  for (std::size_t k = four; k <= read.size(); ++k) {
    const auto way = [&](const std::vector<double>& input) {
      const std::span<const double> at(&input[k - four], four);
      const bool one_way = std::ranges::is_sorted(at, std::less_equal<>{}) ||
                           std::ranges::is_sorted(at, std::greater_equal<>{});
      return one_way ? std::abs(at.back() - at.front()) / range_of(input) : 0.0;
    };
    const auto moving = std::ranges::max_element(inputs, {}, way);
    if (moving != inputs.end() && way(*moving) > 0.0)
      of.push_back(off({&(*moving)[k - four], four}, {&read[k - four], four}));
  }
  return deviation(std::move(of));
}

double step_of(const std::vector<double>& values) {
  std::vector<double> moves;
  double least = 0.0, before = std::nan("");
  for (const double value : values) {
    if (std::isnan(value)) continue;
    const double move = std::abs(value - std::exchange(before, value));
    if (std::isnan(move) || move < 1e-12) continue;
    moves.push_back(move);
    least = least == 0.0 ? move : std::min(least, move);
  }
  const auto is_whole = [least](double move) {
    return std::abs(move / least - std::round(move / least)) < whole * std::max(1.0, move / least * 1e-3);
  };
  const auto many = static_cast<double>(std::count_if(moves.begin(), moves.end(), is_whole));
  return least > 0.0 && many >= steps_that_are_whole * static_cast<double>(moves.size()) ? least : 0.0;
}

domain::FirstState first_state(const domain::Measurement& measured) {
  const auto [ratio, speed, acceleration] = parabola(measured.time_s, measured.read("contraction"));
  domain::FirstState first{ratio, speed, acceleration};
  first.muscle_pressure_Pa = first_pressure_Pa(measured);
  return first;
}

std::optional<double> first_pressure_Pa(const domain::Measurement& measured) {
  const auto& gauge = measured.read("muscle_pressure");
  const auto known = std::ranges::count_if(gauge, [](double value) { return !std::isnan(value); });
  if (static_cast<std::size_t>(known) < least_readings) return std::nullopt;
  return parabola(measured.time_s, gauge)[0];
}

}  // namespace mckibben::data
