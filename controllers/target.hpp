// Wanted movements: steps, ramps, minimum-jerk moves (Flash & Hogan 1985), sine, triangle, and straight lines
// through points, of a load's height, of a joint's angle, of a joint's stiffness. Heights may be contraction
// ratios or lengths; sampled, they are ratios. Every value is right-continuous: at the instant of a step the
// new one holds.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <controllers/controller.hpp>

namespace mckibben::controllers {

/// How far the muscle is contracted: as contraction ratio e, or as rise of the load in metres.
struct Height {
  double value = 0.0;
  bool in_metres = false;

  static constexpr const char* meaning = "height, as contraction ratio or length";
  double ratio(double rest_length_m) const { return in_metres ? value / rest_length_m : value; }
};

/// Where a joint is: the rise of a cord on its wheel, measured in radii.
struct Angle {
  double value = 0.0;

  static constexpr const char* meaning = "joint angle, positive as muscle 1 contracts";
  static constexpr const char* unit = "rad";
  static constexpr double lowest = -2.0 * std::numbers::pi, highest = 2.0 * std::numbers::pi;
  /// Contraction ratio of a muscle whose rest length is so many radii; with 1 the angle itself [rad].
  double ratio(double rest_length_in_radii) const { return value / rest_length_in_radii; }
};

/// Torque [N m] by which a joint resists to be turned by 1 rad while the pressures are kept.
struct Stiffness {
  double value = 0.0;

  static constexpr const char* meaning = "stiffness of the joint";
  static constexpr const char* unit = "N.m/rad";
  static constexpr double lowest = 0.0, highest = 1e5;
  double ratio(double one) const { return value / one; }
};

/// Catches "30" written for "30 mm".
void check_height(auto& report, std::string_view key, const Height& height) {
  if (!height.in_metres && std::abs(height.value) >= 1.0)
    report(key, "a contraction ratio lies between -1 and 1; a length needs its unit");
}
/// Their units and ranges are checked as they are read.
template <class Report>
void check_height(Report&, std::string_view, const Angle&) {}
template <class Report>
void check_height(Report&, std::string_view, const Stiffness&) {}

/// Go to a height: in one step, or on a straight line from the point before.
template <class Value>
struct MoveOf {
  double at_s = 0.0;
  Value to;

  static void fields(auto& self, auto& visit) {
    visit.required("at", self.at_s, "s", 0.0, 1e6, "time of arrival");
    visit.required("to", self.to, Value::meaning);
  }
  void rules(auto& report) const { check_height(report, "to", to); }
};

/// Leave for a height and be there after `lasting`.
template <class Value>
struct GlideOf {
  double at_s = 0.0;
  double lasting_s = 1.0;
  Value to;

  double end_s() const { return at_s + lasting_s; }

  static void fields(auto& self, auto& visit) {
    visit.required("at", self.at_s, "s", 0.0, 1e6, "time of departure");
    visit.required("lasting", self.lasting_s, "s", 1e-3, 1e6, "time from departure to arrival");
    visit.required("to", self.to, Value::meaning);
  }
  void rules(auto& report) const { check_height(report, "to", to); }
};

template <class Report, class Value>
void check_order(Report& report, std::string_view key, const std::vector<MoveOf<Value>>& moves) {
  for (std::size_t i = 1; i < moves.size(); ++i)
    if (moves[i].at_s <= moves[i - 1].at_s) return report(key, "times must ascend");
}

template <class Report, class Value>
void check_order(Report& report, std::string_view key, const std::vector<GlideOf<Value>>& moves) {
  for (std::size_t i = 1; i < moves.size(); ++i)
    if (moves[i].at_s < moves[i - 1].end_s() - instant_s)
      return report(key, "times must ascend, and a move must end before the next begins");
}

// Each target below has
//   at(time_s, rest_length_m)  contraction ratio wanted at that time,
//   knots_s()                  times at which a largest or smallest value can stand, besides start and end.

/// Heights one after the other, from each to the next along a path.
template <class Value, class Path>
struct MovesOf {
  static constexpr std::string_view kind = Path::kind;
  Value start;
  std::vector<typename Path::template Move<Value>> moves;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  static void fields(auto& self, auto& visit) {
    visit("start", self.start, "before the first move");
    visit.required("moves", self.moves, Path::moves);
  }
  void rules(auto& report) const {
    check_height(report, "start", start);
    check_order(report, "moves", moves);
  }
};

/// Heights held.
struct StepPath {
  static constexpr std::string_view kind = "steps";
  static constexpr const char* moves = "steps in order of time; an empty list holds the start";
  template <class Value>
  using Move = MoveOf<Value>;
};

/// Straight moves between heights.
struct RampPath {
  static constexpr std::string_view kind = "ramps";
  static constexpr const char* moves = "straight moves in order of time; an empty list holds the start";
  template <class Value>
  using Move = GlideOf<Value>;
  static double at(double share) { return share; }
};

/// Smoothest moves between heights: 10 s^3 - 15 s^4 + 6 s^5, speed and acceleration zero at both ends.
struct MinimumJerkPath {
  static constexpr std::string_view kind = "minimum_jerk";
  static constexpr const char* moves = "smooth moves in order of time; an empty list holds the start";
  template <class Value>
  using Move = GlideOf<Value>;
  static double at(double share) { return share * share * share * (10.0 + share * (6.0 * share - 15.0)); }
};

template <class Value>
using StepsOf = MovesOf<Value, StepPath>;
template <class Value>
using RampsOf = MovesOf<Value, RampPath>;
template <class Value>
using MinimumJerkOf = MovesOf<Value, MinimumJerkPath>;

/// mean + amplitude sin(2 pi (t - delay)/period); the mean before the delay is over.
template <class Value>
struct SineOf {
  static constexpr std::string_view kind = "sine";
  Value mean;
  Value amplitude;
  double period_s = 1.0;
  double delay_s = 0.0;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  static void fields(auto& self, auto& visit) {
    visit.required("mean", self.mean, "middle of the sine: (lowest + highest)/2");
    visit.required("amplitude", self.amplitude, "half of what lies between: (highest - lowest)/2");
    visit.required("period", self.period_s, "s", 1e-3, 1e6, "time of one cycle");
    visit("delay", self.delay_s, "s", 0.0, 1e6, "time at the mean before the sine begins");
  }
  void rules(auto& report) const {
    check_height(report, "mean", mean);
    check_height(report, "amplitude", amplitude);
    if (amplitude.value <= 0.0) report("amplitude", "must be above zero");
  }
};

/// From low to high and back on straight lines, for ever; low before the delay is over.
template <class Value>
struct TriangleOf {
  static constexpr std::string_view kind = "triangle";
  Value low;
  Value high;
  double period_s = 1.0;
  double delay_s = 0.0;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  static void fields(auto& self, auto& visit) {
    visit.required("low", self.low, "lowest, where the triangle begins");
    visit.required("high", self.high, "highest");
    visit.required("period", self.period_s, "s", 1e-3, 1e6, "time from low to high and back");
    visit("delay", self.delay_s, "s", 0.0, 1e6, "time at low before the triangle begins");
  }
  void rules(auto& report) const {
    check_height(report, "low", low);
    check_height(report, "high", high);
    if constexpr (std::same_as<Value, Height>)
      if (low.in_metres != high.in_metres)
        return report("high", "must be written as low is: both as ratios or both as lengths");
    if (high.value <= low.value) report("high", "must be above low");
  }
};

/// Straight lines through points; the first height before them, the last one after them.
template <class Value>
struct PointsOf {
  static constexpr std::string_view kind = "points";
  std::vector<MoveOf<Value>> points;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  static void fields(auto& self, auto& visit) {
    visit.required("points", self.points, "a list of {at: time, to: value}");
  }
  void rules(auto& report) const {
    if (points.empty()) report("points", "at least one point is needed");
    check_order(report, "points", points);
  }
};

template <class Value>
using TargetOf = std::variant<StepsOf<Value>, RampsOf<Value>, MinimumJerkOf<Value>, SineOf<Value>,
                              TriangleOf<Value>, PointsOf<Value>>;

using Move = MoveOf<Height>;
using Steps = StepsOf<Height>;
using Ramps = RampsOf<Height>;
using MinimumJerk = MinimumJerkOf<Height>;
using Sine = SineOf<Height>;
using Triangle = TriangleOf<Height>;
using Points = PointsOf<Height>;
using Target = TargetOf<Height>;
using AngleTarget = TargetOf<Angle>;
using StiffnessTarget = TargetOf<Stiffness>;

/// Contraction ratio wanted at each of the ticks 0 ... ticks - 1. Of angles `rest_length_m` is in radii of
/// the wheel: with 1 they [rad], as stiffnesses [N m/rad], are as they are.
template <class Value>
std::vector<double> sample(const TargetOf<Value>& target, std::size_t ticks, double tick_s,
                           double rest_length_m);

/// Time of the last commanded change, from which settling is counted; none for a periodic target.
template <class Value>
std::optional<double> last_change_s(const TargetOf<Value>& target);

/// Lowest and highest contraction ratio wanted from 0 to duration_s.
template <class Value>
std::pair<double, double> range(const TargetOf<Value>& target, double duration_s, double rest_length_m);

}  // namespace mckibben::controllers
