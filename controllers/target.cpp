// Values, knots and samples of the wanted movements. The quintic is that of Flash & Hogan (J. Neuroscience 5,
// 1985), the smoothest way from rest to rest.
#include <algorithm>
#include <cmath>

#include <controllers/target.hpp>

namespace mckibben::controllers {
namespace {

bool reached(double time_s, double at_s) {
  return time_s >= at_s - instant_s;
}

}  // namespace

template <class Value, class Path>
double MovesOf<Value, Path>::at(double time_s, double rest_length_m) const {
  double from = start.ratio(rest_length_m);
  for (const auto& move : moves) {
    if (!reached(time_s, move.at_s)) break;
    const double to = move.to.ratio(rest_length_m);
    if constexpr (requires { Path::at(0.0); })
      if (!reached(time_s, move.end_s())) {
        const double share = std::max(0.0, (time_s - move.at_s) / move.lasting_s);
        return from + (to - from) * Path::at(share);
      }
    from = to;
  }
  return from;
}

template <class Value>
double SineOf<Value>::at(double time_s, double rest_length_m) const {
  const double running_s = std::max(0.0, time_s - delay_s);
  return mean.ratio(rest_length_m) +
         amplitude.ratio(rest_length_m) * std::sin(2.0 * std::numbers::pi * running_s / period_s);
}

template <class Value>
double TriangleOf<Value>::at(double time_s, double rest_length_m) const {
  const double phase = std::fmod(std::max(0.0, time_s - delay_s) / period_s, 1.0);
  const double share = phase < 0.5 ? 2.0 * phase : 2.0 - 2.0 * phase;
  return std::lerp(low.ratio(rest_length_m), high.ratio(rest_length_m), share);
}

template <class Value>
double PointsOf<Value>::at(double time_s, double rest_length_m) const {
  if (points.empty()) return 0.0;
  const auto next = std::find_if(points.begin(), points.end(),
                                 [&](const MoveOf<Value>& point) { return !reached(time_s, point.at_s); });
  if (next == points.begin()) return points.front().to.ratio(rest_length_m);
  const MoveOf<Value>& before = *std::prev(next);
  if (next == points.end()) return before.to.ratio(rest_length_m);
  const double share = std::max(0.0, (time_s - before.at_s) / (next->at_s - before.at_s));
  return std::lerp(before.to.ratio(rest_length_m), next->to.ratio(rest_length_m), share);
}

template <class Value, class Path>
std::vector<double> MovesOf<Value, Path>::knots_s() const {
  std::vector<double> knots;
  for (const auto& move : moves) {
    knots.push_back(move.at_s);
    if constexpr (requires { move.end_s(); }) knots.push_back(move.end_s());
  }
  return knots;
}
template <class Value>
std::vector<double> PointsOf<Value>::knots_s() const {
  std::vector<double> knots;
  for (const auto& point : points) knots.push_back(point.at_s);
  return knots;
}
template <class Value>
std::vector<double> SineOf<Value>::knots_s() const {
  return {delay_s + 0.25 * period_s, delay_s + 0.75 * period_s};
}
template <class Value>
std::vector<double> TriangleOf<Value>::knots_s() const {
  return {delay_s, delay_s + 0.5 * period_s};
}

template struct MovesOf<Height, StepPath>;
template struct MovesOf<Height, RampPath>;
template struct MovesOf<Height, MinimumJerkPath>;
template struct SineOf<Height>;
template struct TriangleOf<Height>;
template struct PointsOf<Height>;
template struct MovesOf<Angle, StepPath>;
template struct MovesOf<Angle, RampPath>;
template struct MovesOf<Angle, MinimumJerkPath>;
template struct SineOf<Angle>;
template struct TriangleOf<Angle>;
template struct PointsOf<Angle>;
template struct MovesOf<Stiffness, StepPath>;
template struct MovesOf<Stiffness, RampPath>;
template struct MovesOf<Stiffness, MinimumJerkPath>;
template struct SineOf<Stiffness>;
template struct TriangleOf<Stiffness>;
template struct PointsOf<Stiffness>;

template <class Value>
std::vector<double> sample(const TargetOf<Value>& target, std::size_t ticks, double tick_s,
                           double rest_length_m) {
  std::vector<double> heights(ticks);
  std::visit(
      [&](const auto& shape) {
        for (std::size_t k = 0; k < ticks; ++k)
          heights[k] = shape.at(static_cast<double>(k) * tick_s, rest_length_m);
      },
      target);
  return heights;
}

template <class Value>
std::optional<double> last_change_s(const TargetOf<Value>& target) {
  if (std::holds_alternative<SineOf<Value>>(target) || std::holds_alternative<TriangleOf<Value>>(target))
    return std::nullopt;
  const auto knots = std::visit([](const auto& shape) { return shape.knots_s(); }, target);
  return knots.empty() ? 0.0 : knots.back();
}

template <class Value>
std::pair<double, double> range(const TargetOf<Value>& target, double duration_s, double rest_length_m) {
  return std::visit(
      [&](const auto& shape) {
        const double first = shape.at(0.0, rest_length_m);
        const double last = shape.at(duration_s, rest_length_m);
        std::pair<double, double> found = std::minmax(first, last);
        for (const double knot_s : shape.knots_s()) {
          if (!reached(duration_s, knot_s)) continue;
          const double height = shape.at(knot_s, rest_length_m);
          found = {std::min(found.first, height), std::max(found.second, height)};
        }
        return found;
      },
      target);
}

template std::vector<double> sample(const Target&, std::size_t, double, double);
template std::vector<double> sample(const AngleTarget&, std::size_t, double, double);
template std::vector<double> sample(const StiffnessTarget&, std::size_t, double, double);
template std::optional<double> last_change_s(const Target&);
template std::optional<double> last_change_s(const AngleTarget&);
template std::pair<double, double> range(const Target&, double, double);
template std::pair<double, double> range(const AngleTarget&, double, double);
template std::pair<double, double> range(const StiffnessTarget&, double, double);

}  // namespace mckibben::controllers
