// See the header.
#include <algorithm>
#include <cmath>

#include <sim/data/odd_readings.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

constexpr const ReadingThresholds& beyond = thresholds.reading;

/// How many rows show one reading until the sensor has the next: the median, where it moves.
std::size_t rows_per_reading(const Series& values, double count, double tick_s) {
  const auto longest = static_cast<std::size_t>(std::lround(beyond.still_s / tick_s));
  std::vector<double> rows;
  for (std::size_t k = 1, last = 0; k < values.size(); ++k) {
    const double step = std::abs(values[k] - values[k - 1]);
    if (step == 0.0) continue;
    const bool moves = step > beyond.end_counts * count;
    if (moves && last > 0 && k - last < longest) rows.push_back(static_cast<double>(k - last));
    last = moves ? k : 0;
  }
  return rows.empty() ? 1 : static_cast<std::size_t>(upper_median(std::move(rows)));
}

}  // namespace

Series sharpest_nearby(const Series& model, double tick_s) {
  const auto reach = static_cast<std::size_t>(std::lround(beyond.sharp_reach_s / tick_s));
  Series sharpest(model.size(), 0.0);
  for (std::size_t k = 1; k + 1 < model.size(); ++k) {
    const double bend = std::abs(model[k + 1] - 2.0 * model[k] + model[k - 1]);
    const std::size_t last = std::min(model.size() - 1, k + reach);
    for (std::size_t near = k > reach ? k - reach : 0; near <= last; ++near)
      sharpest[near] = std::max(sharpest[near], bend);
  }
  return sharpest;
}

std::vector<Stretch> spikes(Series values, const Series& sharpest, double count, bool at_ends) {
  std::vector<Stretch> found;
  const std::size_t rows = values.size();
  for (std::size_t begin = 0; begin < rows && rows > 3; ++begin) {
    for (std::size_t end = begin + 1; end <= std::min(rows, begin + beyond.spike_ticks); ++end) {
      const bool first = begin == 0, last = end == rows;
      if ((first || last) && end - begin > 1) break;
      // Beyond the ends of the run the movement is taken to go on.
      const double before = first ? 3.0 * values[1] - 2.0 * values[2] : values[begin - 1];
      const double after = last ? 3.0 * values[rows - 2] - 2.0 * values[rows - 3] : values[end];
      const auto width = static_cast<double>(end - begin);
      const double limit = beyond.spike_counts * count + sharpest[begin] * (width + 1.0);
      const double slope = (after - before) / (width + 1.0);
      const double there = values[begin] - before - slope, back = after - values[end - 1] - slope;
      const double least = std::min(std::abs(there), std::abs(back));
      if ((first || last) && std::abs(slope) > beyond.end_counts * count) continue;
      if (least < limit || there * back >= 0.0 || std::abs(there + back) > beyond.spike_balance * least)
        continue;
      const bool inside = begin > 1 && end + 1 < rows;
      if (!inside && !at_ends) break;
      const double alike = beyond.beside_counts * count + beyond.beside_bends * sharpest[begin];
      if (inside && (std::abs(values[begin - 1] - values[begin - 2] - slope) > alike ||
                     std::abs(values[end + 1] - values[end] - slope) > alike))
        continue;
      found.push_back({begin, end});
      for (std::size_t k = begin; k < end; ++k)  // must not make its neighbours look wrong
        values[k] = before + slope * static_cast<double>(k - begin + 1);
      break;
    }
  }
  return found;
}

std::optional<std::size_t> lost_counts(const Series& values, const Series& sharpest,
                                       const std::vector<bool>& masked, double count, double tick_s) {
  const std::size_t hold = rows_per_reading(values, count, tick_s), reach = 2 * hold - 1;
  const auto bends = static_cast<double>(hold * hold);  // of the model, in the time of one reading
  const auto step = [&](std::size_t k) { return values[k] - values[k - 1]; };
  std::vector<double> steps;
  for (std::size_t k = hold; k < values.size(); ++k) steps.push_back(std::abs(values[k] - values[k - hold]));
  if (steps.empty()) return std::nullopt;
  const double noise = beyond.lost_steps * upper_median(std::move(steps));
  for (std::size_t k = reach + 1; k + reach < values.size(); ++k) {
    if (step(k) == 0.0) continue;
    std::size_t last = k - 1, next = k + 1;  // the readings' changes before and after this one
    while (last > k - reach && step(last) == 0.0) --last;
    while (next < k + reach && step(next) == 0.0) ++next;
    const auto first_masked = masked.begin() + static_cast<std::ptrdiff_t>(last - 1);
    const auto end = masked.begin() + static_cast<std::ptrdiff_t>(next + 1);
    if (std::find(first_masked, end, true) != end) continue;
    const double before = step(last), after = step(next);
    const double jump = std::abs(step(k) - 0.5 * (before + after));
    if (jump > noise + beyond.lost_counts * count + beyond.lost_bends * bends * sharpest[k] &&
        std::abs(after - before) < beyond.lost_change * jump)
      return k;
  }
  return std::nullopt;
}

std::vector<Still> stills(const Series& values, const Series& model, double count, double tick_s) {
  const auto shortest = static_cast<std::size_t>(std::lround(beyond.still_s / tick_s));
  const std::size_t nearby = beyond.cut_off_ticks;
  const double highest = *std::max_element(values.begin(), values.end()), whole = range(model);
  std::vector<Still> found;
  for (std::size_t begin = 0, end; begin < values.size(); begin = end) {
    end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    if (end - begin < shortest) continue;
    // Resting on the stop is no fault, and what leaves it is quick, but not as quick as that.
    const bool catches_up =
        end < values.size() && std::abs(values[end] - values[begin]) > beyond.off_zero_counts * count;
    if (values[begin] < beyond.at_zero_counts * count && !catches_up) continue;
    const double missed = range({model.data() + begin, end - begin});
    const bool inside = begin >= nearby && end + nearby <= values.size();
    const auto moves = [&](std::size_t from, std::size_t to) {
      return std::abs(values[from] - values[to]) > beyond.cut_off_speed * static_cast<double>(nearby) * count;
    };
    const bool cut_off = values[begin] == highest && inside && moves(begin - nearby, begin) &&
                         moves(end - 1, end + nearby - 1);
    const bool stops_dead =
        begin > 0 && std::abs(values[begin] - values[begin - 1]) > beyond.stops_dead_counts * count;
    const bool jumps =
        end < values.size() && std::abs(values[end] - values[begin]) > beyond.catches_up_counts * count;
    if (cut_off && !jumps && missed > beyond.saturated_counts * count)
      found.push_back({{begin + 1, end}, Still::Why::saturated});
    else if (missed > beyond.frozen_counts * count && (stops_dead || jumps))
      found.push_back({{begin + 1, end}, Still::Why::frozen});
    else if (missed > std::min(beyond.stuck_counts * count,
                               std::max(beyond.should_move_counts * count, beyond.stuck_share * whole)))
      found.push_back({{begin + 1, end}, Still::Why::stuck});
  }
  return found;
}

}  // namespace mckibben::data
