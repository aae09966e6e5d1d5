// Values, knots and samples of the wanted movements. The quintic is that of Flash & Hogan (J. Neuroscience 5,
// 1985), the smoothest way from rest to rest.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <controllers/target.hpp>

namespace mckibben::controllers {
namespace {

bool reached(double time_s, double at_s) {
  return time_s >= at_s - instant_s;
}

double straight(double share) {
  return share;
}

double smooth(double share) {
  return share * share * share * (10.0 + share * (6.0 * share - 15.0));
}

// The height along a list of moves, each of which follows `path` from share 0 to 1 of its time.
template <class Value>
double glide(const Value& start, const std::vector<GlideOf<Value>>& moves, double (*path)(double),
             double time_s, double rest_length_m) {
  double from = start.ratio(rest_length_m);
  for (const auto& move : moves) {
    if (!reached(time_s, move.at_s)) break;
    const double to = move.to.ratio(rest_length_m);
    if (!reached(time_s, move.end_s())) {
      const double share = std::max(0.0, (time_s - move.at_s) / move.lasting_s);
      return from + (to - from) * path(share);
    }
    from = to;
  }
  return from;
}

template <class Value>
std::vector<double> ends(const std::vector<GlideOf<Value>>& moves) {
  std::vector<double> knots;
  for (const auto& move : moves) {
    knots.push_back(move.at_s);
    knots.push_back(move.end_s());
  }
  return knots;
}

template <class Value>
std::vector<double> times(const std::vector<MoveOf<Value>>& moves) {
  std::vector<double> knots;
  knots.reserve(moves.size());
  for (const auto& move : moves) knots.push_back(move.at_s);
  return knots;
}

}  // namespace

template <class Value>
double StepsOf<Value>::at(double time_s, double rest_length_m) const {
  double height = start.ratio(rest_length_m);
  for (const auto& move : moves) {
    if (!reached(time_s, move.at_s)) break;
    height = move.to.ratio(rest_length_m);
  }
  return height;
}

template <class Value>
double RampsOf<Value>::at(double time_s, double rest_length_m) const {
  return glide(start, moves, straight, time_s, rest_length_m);
}

template <class Value>
double MinimumJerkOf<Value>::at(double time_s, double rest_length_m) const {
  return glide(start, moves, smooth, time_s, rest_length_m);
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

template <class Value>
std::vector<double> StepsOf<Value>::knots_s() const {
  return times(moves);
}
template <class Value>
std::vector<double> RampsOf<Value>::knots_s() const {
  return ends(moves);
}
template <class Value>
std::vector<double> MinimumJerkOf<Value>::knots_s() const {
  return ends(moves);
}
template <class Value>
std::vector<double> PointsOf<Value>::knots_s() const {
  return times(points);
}
template <class Value>
std::vector<double> SineOf<Value>::knots_s() const {
  return {delay_s + 0.25 * period_s, delay_s + 0.75 * period_s};
}
template <class Value>
std::vector<double> TriangleOf<Value>::knots_s() const {
  return {delay_s, delay_s + 0.5 * period_s};
}

template struct StepsOf<Height>;
template struct RampsOf<Height>;
template struct MinimumJerkOf<Height>;
template struct SineOf<Height>;
template struct TriangleOf<Height>;
template struct PointsOf<Height>;
template struct StepsOf<Angle>;
template struct RampsOf<Angle>;
template struct MinimumJerkOf<Angle>;
template struct SineOf<Angle>;
template struct TriangleOf<Angle>;
template struct PointsOf<Angle>;
template struct StepsOf<Stiffness>;
template struct RampsOf<Stiffness>;
template struct MinimumJerkOf<Stiffness>;
template struct SineOf<Stiffness>;
template struct TriangleOf<Stiffness>;
template struct PointsOf<Stiffness>;

namespace {

template <class Any>
std::vector<double> sampled(const Any& target, std::size_t ticks, double tick_s, double rest_length_m) {
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
std::optional<double> changes_last_s(const TargetOf<Value>& target) {
  if (std::holds_alternative<SineOf<Value>>(target) || std::holds_alternative<TriangleOf<Value>>(target))
    return std::nullopt;
  const auto knots = std::visit([](const auto& shape) { return shape.knots_s(); }, target);
  return knots.empty() ? 0.0 : knots.back();
}

template <class Any>
std::pair<double, double> range_of(const Any& target, double duration_s, double rest_length_m) {
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

}  // namespace

std::vector<double> sample(const Target& target, std::size_t ticks, double tick_s, double rest_length_m) {
  return sampled(target, ticks, tick_s, rest_length_m);
}
std::vector<double> sample(const AngleTarget& target, std::size_t ticks, double tick_s,
                           double rest_length_in_radii) {
  return sampled(target, ticks, tick_s, rest_length_in_radii);
}
std::vector<double> sample(const StiffnessTarget& target, std::size_t ticks, double tick_s, double one) {
  return sampled(target, ticks, tick_s, one);
}

std::optional<double> last_change_s(const Target& target) {
  return changes_last_s<Height>(target);
}
std::optional<double> last_change_s(const AngleTarget& target) {
  return changes_last_s<Angle>(target);
}

std::pair<double, double> range(const Target& target, double duration_s, double rest_length_m) {
  return range_of(target, duration_s, rest_length_m);
}
std::pair<double, double> range(const AngleTarget& target, double duration_s, double rest_length_in_radii) {
  return range_of(target, duration_s, rest_length_in_radii);
}
std::pair<double, double> range(const StiffnessTarget& target, double duration_s, double one) {
  return range_of(target, duration_s, one);
}

}  // namespace mckibben::controllers
