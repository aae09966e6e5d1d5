// Interpolation in the tables, and the slowed target.
#include <algorithm>
#include <cmath>

#include <controllers/reach.hpp>

namespace mckibben::controllers {
namespace {

// Between which two of the ascending values it lies, and how far on the way from the first to the second.
struct Place {
  std::size_t before, after;
  double share;
};

template <class List, class Value>
Place place(const List& list, double wanted, const Value& value) {
  const auto above =
      std::partition_point(list.begin(), list.end(), [&](const auto& one) { return value(one) < wanted; });
  if (above == list.begin()) return {0, 0, 0.0};
  const auto index = static_cast<std::size_t>(above - list.begin());
  if (above == list.end()) return {index - 1, index - 1, 0.0};
  const double low = value(list[index - 1]), high = value(list[index]);
  return {index - 1, index, (wanted - low) / (high - low)};
}

std::vector<double> between(const std::vector<double>& a, const std::vector<double>& b, double share) {
  std::vector<double> values(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) values[i] = std::lerp(a[i], b[i], share);
  return values;
}

}  // namespace

ReachOfLoad Reach::at_load(double load_kg) const {
  const Place at = place(loads, load_kg, [](const ReachOfLoad& one) { return one.load_kg; });
  const ReachOfLoad &a = loads[at.before], &b = loads[at.after];
  return {load_kg,
          std::lerp(a.lowest_rising, b.lowest_rising, at.share),
          std::lerp(a.lowest_falling, b.lowest_falling, at.share),
          std::lerp(a.highest, b.highest, at.share),
          between(a.rising_per_s, b.rising_per_s, at.share),
          between(a.falling_per_s, b.falling_per_s, at.share),
          between(a.rising_lag_s, b.rising_lag_s, at.share),
          between(a.falling_lag_s, b.falling_lag_s, at.share)};
}

double Reach::at_ratio(const std::vector<double>& column, double contraction_ratio) const {
  const Place at = place(ratio, contraction_ratio, [](double one) { return one; });
  return std::lerp(column[at.before], column[at.after], at.share);
}

std::vector<double> slowed(const std::vector<double>& target, double tick_s, const Reach& reach,
                           const ReachOfLoad& load) {
  std::vector<double> followed(target.size());
  if (target.empty()) return followed;
  double e = followed[0] = std::clamp(target[0], std::min(load.lowest_rising, load.highest), load.highest);
  for (std::size_t k = 1; k < target.size(); ++k) {
    if (target[k] > e) {
      const double step = reach.at_ratio(load.rising_per_s, e) * tick_s;
      e = std::max(e, std::min({target[k], e + step, load.highest}));
    } else {
      const double step = reach.at_ratio(load.falling_per_s, e) * tick_s;
      e = std::min(e, std::max({target[k], e - step, load.lowest_falling}));
    }
    followed[k] = e;
  }
  return followed;
}

}  // namespace mckibben::controllers
