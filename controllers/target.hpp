// Wanted movements of the load: steps, ramps, minimum-jerk moves (Flash & Hogan 1985), sine, triangle, and
// straight lines through points. Heights may be contraction ratios or lengths; sampled, they are ratios.
// Every value is right-continuous: at the instant of a step the new height holds.
#pragma once

#include <cstddef>
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

  double ratio(double rest_length_m) const { return in_metres ? value / rest_length_m : value; }
};

/// Catches "30" written for "30 mm".
template <class Report>
void check_height(Report& report, std::string_view key, const Height& height) {
  if (!height.in_metres && (height.value < 0.0 || height.value >= 1.0))
    report(key, "a contraction ratio lies between 0 and 1; a length needs its unit");
}

/// Go to a height: in one step, or on a straight line from the point before.
struct Move {
  double at_s = 0.0;
  Height to;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("at", self.at_s, "s", 0.0, 1e6, "time of arrival at the height");
    visit.required("to", self.to, "height, as contraction ratio or length");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "to", to);
  }
};

/// Leave for a height and be there after `lasting`.
struct Glide {
  double at_s = 0.0;
  double lasting_s = 1.0;
  Height to;

  double end_s() const { return at_s + lasting_s; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("at", self.at_s, "s", 0.0, 1e6, "time of departure");
    visit.required("lasting", self.lasting_s, "s", 1e-3, 1e6, "time from departure to arrival");
    visit.required("to", self.to, "height at arrival, as contraction ratio or length");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "to", to);
  }
};

template <class Report>
void check_order(Report& report, std::string_view key, const std::vector<Move>& moves) {
  for (std::size_t i = 1; i < moves.size(); ++i)
    if (moves[i].at_s <= moves[i - 1].at_s) return report(key, "times must ascend");
}

template <class Report>
void check_order(Report& report, std::string_view key, const std::vector<Glide>& moves) {
  for (std::size_t i = 1; i < moves.size(); ++i)
    if (moves[i].at_s < moves[i - 1].end_s() - instant_s)
      return report(key, "times must ascend, and a move must end before the next begins");
}

// Each target below has
//   at(time_s, rest_length_m)  contraction ratio wanted at that time,
//   knots_s()                  times at which a largest or smallest value can stand, besides start and end.

/// Heights held one after the other.
struct Steps {
  static constexpr std::string_view kind = "steps";
  Height start;
  std::vector<Move> moves;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("start", self.start, "height before the first move");
    visit.required("moves", self.moves, "steps in order of time; an empty list holds the start");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "start", start);
    check_order(report, "moves", moves);
  }
};

/// Straight moves between heights.
struct Ramps {
  static constexpr std::string_view kind = "ramps";
  Height start;
  std::vector<Glide> moves;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("start", self.start, "height before the first move");
    visit.required("moves", self.moves, "straight moves in order of time; an empty list holds the start");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "start", start);
    check_order(report, "moves", moves);
  }
};

/// Smoothest moves between heights: 10 s^3 - 15 s^4 + 6 s^5, speed and acceleration zero at both ends.
struct MinimumJerk {
  static constexpr std::string_view kind = "minimum_jerk";
  Height start;
  std::vector<Glide> moves;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("start", self.start, "height before the first move");
    visit.required("moves", self.moves, "smooth moves in order of time; an empty list holds the start");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "start", start);
    check_order(report, "moves", moves);
  }
};

/// mean + amplitude sin(2 pi (t - delay)/period); the mean before the delay is over.
struct Sine {
  static constexpr std::string_view kind = "sine";
  Height mean;
  Height amplitude;
  double period_s = 1.0;
  double delay_s = 0.0;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("mean", self.mean, "height in the middle of the sine");
    visit.required("amplitude", self.amplitude, "half the height between lowest and highest");
    visit.required("period", self.period_s, "s", 1e-3, 1e6, "time of one cycle");
    visit("delay", self.delay_s, "s", 0.0, 1e6, "time at the mean before the sine begins");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "mean", mean);
    check_height(report, "amplitude", amplitude);
    if (amplitude.value <= 0.0) report("amplitude", "must be above zero");
  }
};

/// From low to high and back on straight lines, for ever; low before the delay is over.
struct Triangle {
  static constexpr std::string_view kind = "triangle";
  Height low;
  Height high;
  double period_s = 1.0;
  double delay_s = 0.0;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("low", self.low, "lowest height, where the triangle begins");
    visit.required("high", self.high, "highest height");
    visit.required("period", self.period_s, "s", 1e-3, 1e6, "time from low to high and back");
    visit("delay", self.delay_s, "s", 0.0, 1e6, "time at low before the triangle begins");
  }
  template <class Report>
  void rules(Report& report) const {
    check_height(report, "low", low);
    check_height(report, "high", high);
    if (low.in_metres != high.in_metres)
      report("high", "must be written as low is: both as ratios or both as lengths");
    else if (high.value <= low.value)
      report("high", "must be above low");
  }
};

/// Straight lines through points; the first height before them, the last one after them.
struct Points {
  static constexpr std::string_view kind = "points";
  std::vector<Move> points;

  double at(double time_s, double rest_length_m) const;
  std::vector<double> knots_s() const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("points", self.points, "times and heights in order of time");
  }
  template <class Report>
  void rules(Report& report) const {
    if (points.empty()) report("points", "at least one point is needed");
    check_order(report, "points", points);
  }
};

using Target = std::variant<Steps, Ramps, MinimumJerk, Sine, Triangle, Points>;

/// Contraction ratio wanted at each of the ticks 0 ... ticks - 1.
std::vector<double> sample(const Target& target, std::size_t ticks, double tick_s, double rest_length_m);

/// Time of the last commanded change, from which settling is counted; none for a periodic target.
std::optional<double> last_change_s(const Target& target);

/// Lowest and highest contraction ratio wanted from 0 to duration_s.
std::pair<double, double> range(const Target& target, double duration_s, double rest_length_m);

}  // namespace mckibben::controllers
