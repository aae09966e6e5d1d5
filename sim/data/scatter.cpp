// Averages over neighbours and differences; see the header.
#include <array>
#include <functional>
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

double slow_noise(std::vector<double> v) {
  std::vector<double> fourth;
  for (std::size_t k = 4; k < v.size(); ++k)
    if (const double d = v[k] - 4.0 * v[k - 1] + 6.0 * v[k - 2] - 4.0 * v[k - 3] + v[k - 4]; !std::isnan(d))
      fourth.push_back(std::abs(d));
  if (fourth.empty() && std::erase_if(v, [](double value) { return std::isnan(value); }) > 0)
    return slow_noise(std::move(v));
  return fourth.empty() ? 0.0 : upper_median(std::move(fourth)) / normal_median / std::sqrt(70.0);
}

double points_noise(const std::vector<double>& read, const std::vector<std::vector<double>>& inputs) {
  std::vector<double> off;
  for (std::size_t k = 3; k < read.size(); ++k) {
    const auto way = [&](const std::vector<double>& input) {
      const std::span<const double> at(&input[k - 3], 4);
      const bool one_way = std::ranges::is_sorted(at, std::less_equal<>{}) ||
                           std::ranges::is_sorted(at, std::greater_equal<>{});
      return one_way ? std::abs(at[3] - at[0]) / range_of(input) : 0.0;
    };
    const auto moving = std::ranges::max_element(inputs, {}, way);
    if (moving == inputs.end() || !(way(*moving) > 0.0)) continue;
    double difference = 0.0, squares = 0.0;
    for (std::size_t i = k - 3; i <= k; ++i) {
      double weight = 1.0;  // of a divided difference
      for (std::size_t j = k - 3; j <= k; ++j)
        if (j != i) weight *= range_of(*moving) / ((*moving)[i] - (*moving)[j]);
      difference += weight * read[i];
      squares += weight * weight;
    }
    if (!std::isnan(difference)) off.push_back(std::abs(difference) / std::sqrt(squares));
  }
  return off.empty() ? 0.0 : upper_median(std::move(off)) / normal_median;
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
