// Loops round a linear rig: what a PID of controllers/pid.hpp is as a system, gain and phase margins, and the
// PID that has wanted ones.
#pragma once

#include <optional>
#include <vector>

#include <controllers/pid.hpp>
#include <sim/linear/point.hpp>
#include <sim/run/tune_pid.hpp>

namespace mckibben::linear {

controllers::PidForm pid_of(const run::Gains& gains);

/// From error to command, sample by sample, limits and dead zone left out. Its gain must be there.
System system_of(const controllers::PidForm& pid, double tick_s);

/// The filter at each tick.
System system_of(const controllers::CommandFilter& filter, double tick_s);

/// The open loop of a PID round the rig, as it runs: sampled, its command held and filtered (null: not), with
/// all delays.
System loop_of(const Point& point, const controllers::PidForm& pid, double tick_s,
               const controllers::CommandFilter* filter = nullptr);

struct Margins {
  bool stable = false;  ///< the closed loop; without that there are no margins
  /// By how much the gain may grow, and may shrink, before the loop swings; none: no bound.
  std::optional<double> gain, shrunk_gain;
  std::optional<double> phase_rad;  ///< the least, where the loop's gain is 1
  double gain_rad_per_s = 0.0, phase_rad_per_s = 0.0;
};
Margins margins_of(const System& loop);

/// Of a loop that is unstable: up to which amplitude [m/s] swings of the load die out by dry friction; 0:
/// none.
double calmed_m_per_s(const Point& point, const controllers::PidForm& pid, double tick_s,
                      const controllers::CommandFilter* filter = nullptr);

/// Frequencies [rad/s], evenly in their logarithm, up to half the sampling rate.
std::vector<double> frequencies(double step_s, int count);

/// What a PID by margins keeps.
struct Wanted {
  double phase_rad = 0.0;
  double gain = 2.0;
};
struct PidByMargins {
  run::Gains gains;
  bool gain_binds = false;       ///< more gain would cost the gain margin, not the phase margin
  double binds_rad_per_s = 0.0;  ///< where it would cost the phase margin; 0: that does not bind
  double left_rad = 0.0;         ///< of the phase margin, there
  bool shortest = false;         ///< no shorter integral time was looked at
};
/// Of the PIDs with Ti = 4 Td that keep the margins, the one with the largest K/Ti: it makes up for a
/// constant disturbance soonest (Astrom & Hagglund 1995, section 4.6). None where no such PID does.
std::optional<PidByMargins> pid_by_margins(const Point& point, double tick_s, const Wanted& wanted);

/// State feedback each tick, which takes an error of `position` for as bad as a command of `command` beside
/// the base: u = base - K (x - x0) - F (commands before - base). Those on their way are states, too, as a
/// delay keeps them back; x is as late as it is read.
struct Regulator {
  Eigen::RowVectorXd gain;    ///< K, in the units of the states, for a loop's output
  Eigen::RowVectorXd before;  ///< F, of the latest command first; empty without delays
  System loop;                ///< cut open behind the law, which knows what it gave and not what came of it
};
Regulator lqr(const Point& point, double tick_s, double position, double command);

}  // namespace mckibben::linear
