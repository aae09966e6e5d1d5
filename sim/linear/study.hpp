// What is made of a rig at a place: its loops with the controllers that are linear, and those found by
// margins and by least squares.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <controllers/settings.hpp>
#include <sim/linear/loop.hpp>

namespace mckibben::linear {

struct Loop {
  std::string name;
  System open;
  Margins margins{};
  double calmed_m_per_s = 0.0;   ///< where it is unstable without friction, see there
  std::string_view binds{};      ///< of `pid_by_margins`, the margin that more gain would cost: gain or phase
  double binds_rad_per_s = 0.0;  ///< where it would cost the phase margin
  double left_rad = 0.0;         ///< of the phase margin, there
  bool shortest = false;         ///< its integral time is the shortest that was looked at
};

/// Position and command errors that count alike in a least squares feedback, in units of both.
struct Weights {
  double position = 0.0, command = 0.0;
};

/// What is asked of a rig with each load at each place.
struct Question {
  std::vector<Place> places{Place{}};
  Threads threads = Threads::sliding;
  Opening opening = Opening::both;
  std::optional<double> swing_m_per_s{};
  std::optional<Wanted> margins{};
  std::optional<Weights> lqr{};
};

struct Study {
  Point point;
  std::vector<Loop> loops;
  std::optional<run::Gains> by_margins{};  ///< of the loop `pid_by_margins`
  Eigen::RowVectorXd lqr{}, lqr_before{};  ///< of the loop `lqr`, see Regulator; empty if none is asked for
};

/// `controllers`: those with a PidForm are loops; the others are no part of it.
Study study(const plant::Rig& rig, double load_kg, const Place& place, const Question& question,
            std::span<const controllers::Settings> controllers);

/// Whether a controller is linear but for its limits: a PID round a fixed command.
bool is_linear(const controllers::Settings& settings);

}  // namespace mckibben::linear
