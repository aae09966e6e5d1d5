// Crossings are looked for on a grid and then halved; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <sim/data/golden_section.hpp>
#include <sim/linear/loop.hpp>

namespace mckibben::linear {
namespace {

constexpr double pi = std::numbers::pi;

/// Where a function of frequency changes its sign between two frequencies.
double crossing(const auto& f, double low, double high) {
  const bool above = f(low) > 0.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = std::sqrt(low * high);
    ((f(middle) > 0.0) == above ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

struct Seen {
  double rad_per_s;
  Complex value;
};

/// A loop along the frequencies, and where its gain has a peak or a dip between them: a resonance may be
/// narrower than their steps.
std::vector<Seen> seen_along(const System& loop) {
  std::vector<Seen> all;
  const auto see = [&](double w) { all.push_back({w, response(loop, w)}); };
  for (const double w : frequencies(loop.step_s, 800)) see(w);
  const auto gain = [&](std::size_t i) { return std::abs(all[i].value); };
  for (std::size_t i = 1, count = all.size(); i + 1 < count; ++i) {
    const double sign = gain(i) > gain(i - 1) ? -1.0 : 1.0;
    if (gain(i) == gain(i - 1) || sign * gain(i) > sign * gain(i + 1)) continue;
    const auto least = [&](double logarithm) { return sign * std::abs(response(loop, std::exp(logarithm))); };
    see(std::exp(
        data::golden_section(least, std::log(all[i - 1].rad_per_s), std::log(all[i + 1].rad_per_s), 1e-8)));
  }
  std::ranges::sort(all, {}, &Seen::rad_per_s);
  return all;
}

/// With so many digits, and no larger.
double rounded_down(double value, int digits) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) + 1.0 - digits);
  return std::floor(value / step) * step;
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

System system_of(const controllers::CommandFilter& filter, double tick_s) {
  const controllers::Biquad of = biquad_of(filter, tick_s);
  System result{Matrix(2, 2), Matrix(2, 1), Matrix(1, 2), Matrix::Constant(1, 1, of.b0), tick_s};
  result.A << -of.a1, 1.0, -of.a2, 0.0;
  result.B << of.b1 - of.a1 * of.b0, of.b2 - of.a2 * of.b0;
  result.C << 1.0, 0.0;
  return result;
}

System loop_of(const Point& point, const controllers::PidForm& pid, double tick_s,
               const controllers::CommandFilter* filter) {
  System plant = point.system();
  plant.C *= point.shown;
  const double delay_s = point.delay_s() + pid.feedback_delay_ticks * tick_s;
  System driven = sampled(plant, tick_s, delay_s);
  if (filter != nullptr) driven = in_series(system_of(*filter, tick_s), driven);
  return in_series(system_of(pid, tick_s), held(driven, pid.sample_ticks));
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
  const std::vector<Seen> all = seen_along(loop);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto& [low, before] = all[i - 1];
    const auto& [high, now] = all[i];
    if ((before.imag() > 0.0) != (now.imag() > 0.0)) at_half_turn(crossing(imaginary, low, high));
    if ((std::abs(before) > 1.0) == (std::abs(now) > 1.0)) continue;
    const double w = crossing(excess, low, high),
                 left = std::remainder(std::arg(response(loop, w)) + pi, 2.0 * pi);
    if (margins.phase_rad && std::abs(*margins.phase_rad) <= std::abs(left)) continue;
    margins.phase_rad = left;
    margins.phase_rad_per_s = w;
  }
  at_half_turn(all.back().rad_per_s);
  return margins;
}

double calmed_m_per_s(const Point& point, const controllers::PidForm& pid, double tick_s,
                      const controllers::CommandFilter* filter) {
  const auto calm = [&](double speed) {
    return is_stable(closed(loop_of(point.swinging(speed), pid, tick_s, filter)));
  };
  double low = 1e-6, high = 10.0;
  if (!calm(low)) return 0.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (calm(middle) ? low : high) = middle;
  }
  return low;
}

std::optional<PidByMargins> pid_by_margins(const Point& point, double tick_s, const Wanted& wanted) {
  constexpr double rounding = 1e-9, close = 1e-6;
  constexpr int digits = 4;  // as it is printed
  System plant = sampled(point.system(), tick_s, point.delay_s());
  plant.C *= point.shown;
  const double slightest = 1e-3 / std::abs(gain_at_rest(plant)), strongest = 1e6 * slightest;
  std::optional<PidByMargins> best;
  // Down to an integral time of little more than a tick: a shorter one makes it an I controller.
  const std::vector<double> all = frequencies(tick_s, 120);
  for (const double w : all) {
    const double Td_s = rounded_down(1.0 / w, digits), Ti_s = rounded_down(4.0 * Td_s, digits);
    const auto with = [&](double K) {
      return margins_of(in_series(system_of(pid_of({K, Ti_s, Td_s}), tick_s), plant));
    };
    const auto keeps_phase = [&](double K) {
      const Margins has = with(K);
      return has.stable && has.phase_rad.value_or(pi) >= wanted.phase_rad;
    };
    const Margins first = with(slightest);
    double high = first.gain ? slightest * *first.gain / wanted.gain * (1.0 - rounding) : strongest,
           low = best ? best->gains.proportional_mA / best->gains.integral_time_s * Ti_s : slightest;
    if (!first.stable || high <= low) continue;  // low: no better than the best
    const bool gain_binds = keeps_phase(high);
    if (gain_binds) low = high;
    if (!gain_binds && !keeps_phase(low)) continue;
    while (high > low * (1.0 + close)) {
      const double middle = std::sqrt(low * high);
      (keeps_phase(middle) ? low : high) = middle;
    }
    const Margins beyond = gain_binds ? Margins{} : with(high);
    best = {{rounded_down(low, digits), Ti_s, Td_s},
            gain_binds,
            beyond.phase_rad_per_s,
            beyond.phase_rad.value_or(0.0),
            w == all.back()};
  }
  return best;
}

Regulator lqr(const Point& point, double tick_s, double position, double command) {
  const System plant = sampled(point.system(), tick_s, point.delay_s());
  System weighed = plant;  // what is as bad as a unit of the other is one; commands before are in their unit
  weighed.B *= command;
  weighed.C /= position;
  const Eigen::RowVectorXd all = command * least_squares_feedback(weighed).row(0);
  const Eigen::Index n = point.slopes.A.rows(), late = plant.states() - n;
  Regulator result{all.head(n) * point.sizes().cwiseInverse().asDiagonal(), all.tail(late), {}};
  // The law with its memory: what it gave itself moves on through it.
  System law{Matrix::Zero(late, late), Matrix::Zero(late, n), -result.before, all.head(n), tick_s};
  if (late > 0) {
    law.A.bottomLeftCorner(late - 1, late - 1).setIdentity();
    law.A.row(0) = -result.before;
    law.B.row(0) = all.head(n);
  }
  System states = plant;
  states.C = Matrix::Identity(n, plant.states());
  states.D = Matrix::Zero(n, 1);
  result.loop = in_series(states, law);
  return result;
}

}  // namespace mckibben::linear
