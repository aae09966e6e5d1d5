// Crossings are looked for on a grid and then halved; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <sim/linear/loop.hpp>

namespace mckibben::linear {
namespace {

constexpr double pi = std::numbers::pi;

/// Where a function of frequency changes its sign between two frequencies.
template <class Function>
double crossing(const Function& f, double low, double high) {
  const bool above = f(low) > 0.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = std::sqrt(low * high);
    ((f(middle) > 0.0) == above ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// Ti = 4 Td
controllers::PidForm four_to_one(double K, double Td_s) {
  return pid_of({K, 4.0 * Td_s, Td_s});
}

}  // namespace

controllers::PidForm pid_of(const run::Gains& gains) {
  controllers::PidForm pid;
  pid.proportional_mA = gains.proportional_mA;
  pid.integral_time_s = gains.integral_time_s;
  pid.derivative_time_s = gains.derivative_time_s;
  return pid;
}

// The recursion of controllers/pid.cpp with e = -y; states: I, D and e of the sample before.
System system_of(const controllers::PidForm& pid, double tick_s) {
  const double K = pid.proportional_mA.value(), Ti_s = pid.integral_time_s.value(),
               Td_s = pid.derivative_time_s.value(), h_s = pid.sample_ticks * tick_s;
  const double filter_s = Td_s + pid.derivative_filter * h_s, stays = Td_s / filter_s,
               jumps = K * Td_s * pid.derivative_filter / filter_s;
  System result{Matrix::Zero(3, 3), Matrix(3, 1), Matrix(1, 3), Matrix::Constant(1, 1, K + jumps), h_s};
  result.A(0, 0) = Ti_s > 0.0 ? 1.0 : 0.0;
  result.A.row(1) << 0.0, stays, -jumps;
  result.B << (Ti_s > 0.0 ? K * h_s / Ti_s : 0.0), jumps, 1.0;
  result.C << 1.0, stays, -jumps;
  return result;
}

System loop_of(const Point& point, const controllers::PidForm& pid, double tick_s) {
  System plant = point.system();
  plant.C *= point.shown;
  const double delay_s = point.delay_s() + pid.feedback_delay_ticks * tick_s;
  return in_series(system_of(pid, tick_s), sampled(plant, pid.sample_ticks * tick_s, delay_s));
}

std::vector<double> frequencies(double step_s, int count) {
  constexpr double lowest = 1e-2;
  const double highest = pi / step_s;
  std::vector<double> all;
  for (int i = 0; i < count; ++i)
    all.push_back(lowest * std::pow(highest / lowest, static_cast<double>(i) / (count - 1)));
  return all;
}

Margins margins_of(const System& loop) {
  Margins margins;
  margins.stable = is_stable(closed(loop));
  if (!margins.stable) return margins;
  const auto imaginary = [&](double w) { return response(loop, w).imag(); };
  const auto excess = [&](double w) { return std::log(std::abs(response(loop, w))); };
  const auto at_half_turn = [&](double w) {
    const double real = response(loop, w).real();
    if (real >= 0.0) return;
    const double factor = -1.0 / real;
    if (factor > 1.0 && factor < margins.gain.value_or(1e300))
      margins.gain = factor, margins.gain_rad_per_s = w;
    if (factor < 1.0 && factor > margins.shrunk_gain.value_or(0.0)) margins.shrunk_gain = factor;
  };
  const std::vector<double> grid = frequencies(loop.step_s, 800);
  for (std::size_t i = 1; i < grid.size(); ++i) {
    const double low = grid[i - 1], high = grid[i];
    if ((imaginary(low) > 0.0) != (imaginary(high) > 0.0)) at_half_turn(crossing(imaginary, low, high));
    if ((excess(low) > 0.0) == (excess(high) > 0.0)) continue;
    const double w = crossing(excess, low, high),
                 left = std::remainder(std::arg(response(loop, w)) + pi, 2.0 * pi);
    if (margins.phase_rad && std::abs(*margins.phase_rad) <= std::abs(left)) continue;
    margins.phase_rad = left;
    margins.phase_rad_per_s = w;
  }
  at_half_turn(grid.back());
  return margins;
}

double calmed_m_per_s(const Point& point, const controllers::PidForm& pid, double tick_s) {
  const auto calm = [&](double speed) {
    return is_stable(closed(loop_of(point.swinging(speed), pid, tick_s)));
  };
  double low = 1e-6, high = 10.0;
  if (!calm(low)) return 0.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (calm(middle) ? low : high) = middle;
  }
  return low;
}

std::optional<run::Gains> pid_by_margins(const Point& point, double tick_s, const Wanted& wanted) {
  System plant = sampled(point.system(), tick_s, point.delay_s());
  plant.C *= point.shown;
  std::optional<run::Gains> best;
  const auto consider = [&](double w, const Complex& of_plant, double phase_rad) {
    const auto with = [&](double Td_s) {
      return response(system_of(four_to_one(1.0, Td_s), tick_s), w) * of_plant;
    };
    const auto lacks = [&](double Td_s) {
      return std::remainder(std::arg(with(Td_s)) + pi - phase_rad, 2.0 * pi);
    };
    const double shortest_s = 0.02 / w, longest_s = 3.0 / w;
    if (lacks(shortest_s) > 0.0 || lacks(longest_s) < 0.0) return;
    const double Td_s = crossing(lacks, shortest_s, longest_s), K = 1.0 / std::abs(with(Td_s));
    if (best && K / (4.0 * Td_s) <= best->proportional_mA / best->integral_time_s) return;
    const Margins has = margins_of(in_series(system_of(four_to_one(K, Td_s), tick_s), plant));
    constexpr double rounding = 1e-6;
    if (has.stable && has.phase_rad && *has.phase_rad >= wanted.phase_rad - rounding &&
        has.gain.value_or(1e300) >= wanted.gain)
      best = run::Gains{K, 4.0 * Td_s, Td_s};
  };
  constexpr double step_rad = 0.1;
  for (const double w : frequencies(tick_s, 150)) {
    if (w > 0.5 * pi / tick_s) break;
    const Complex of_plant = response(plant, w);
    for (double phase_rad = wanted.phase_rad; phase_rad < 1.7; phase_rad += step_rad)
      consider(w, of_plant, phase_rad);
  }
  return best;
}

Regulator lqr(const Point& point, double tick_s, double position, double command) {
  System plant = sampled(point.system(), tick_s);
  plant.B *= command;  // both weighed: what is as bad as a unit of the other is one
  plant.C /= position;
  const Matrix gain = command * least_squares_feedback(plant);
  plant.B /= command;
  plant.C = gain;
  return {(gain * point.sizes().cwiseInverse().asDiagonal()).row(0), plant};
}

}  // namespace mckibben::linear
