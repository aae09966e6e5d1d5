// See the header.
#include <algorithm>
#include <cmath>

#include <sim/data/series.hpp>
#include <sim/input/number.hpp>
#include <sim/recognise/columns.hpp>

namespace mckibben::recognise {
namespace {

constexpr double lowest_share = 0.02, still_share = 0.01;
constexpr std::size_t rows_of_a_beginning = 5;

/// Where a row lacks it, on the straight line between the rows that have it.
Values bridged(Values values) {
  std::size_t known = values.size();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isnan(values[k])) continue;
    for (std::size_t gap = known + 1; known < values.size() && gap < k; ++gap)
      values[gap] = std::lerp(values[known], values[k],
                              static_cast<double>(gap - known) / static_cast<double>(k - known));
    known = k;
  }
  return values;
}

}  // namespace

Clock clock_of(const Values& time_s) {
  Clock clock;
  if (time_s.size() < 2) return clock;
  Values steps;
  for (std::size_t k = 1; k < time_s.size(); ++k) steps.push_back(time_s[k] - time_s[k - 1]);
  clock.begin_s = time_s.front();
  clock.ascends = std::all_of(steps.begin(), steps.end(), [](double step) { return step > 0.0; });
  const auto [shortest, longest] = std::ranges::minmax(steps);
  clock.shortest_s = shortest;
  clock.longest_s = longest;
  // The middle of all steps is not spoilt by a gap; the mean of the even ones has more digits.
  const double middle = data::upper_median(steps);
  double sum = 0.0, number = 0.0;
  for (const double step : steps)
    if (std::abs(step - middle) < 0.01 * std::abs(middle)) {
      sum += step;
      ++number;
    }
  clock.step_s = number > 0.0 ? sum / number : middle;
  for (std::size_t k = 0; k < time_s.size(); ++k)
    clock.jitter_s =
        std::max(clock.jitter_s, std::abs(time_s[k] - clock.begin_s - static_cast<double>(k) * clock.step_s));
  return clock;
}

std::size_t taking_turns(const Values& values) {
  constexpr double much = 5.0;
  constexpr std::size_t most = 4, least_rows = 20;
  if (values.size() < least_rows) return 1;
  const auto step = [&](std::size_t apart) {
    Values steps;
    for (std::size_t k = apart; k < values.size(); ++k)
      if (const double by = std::abs(values[k] - values[k - apart]); !std::isnan(by)) steps.push_back(by);
    return steps.empty() ? 0.0 : data::upper_median(std::move(steps));
  };
  const double next = step(1);
  for (std::size_t apart = 2; apart <= most; ++apart)
    if (much * step(apart) < next) return apart;
  return 1;
}

Range range_of(const Values& values) {
  Range range{1e300, -1e300};
  for (const double value : values)
    if (!std::isnan(value)) range = {std::min(range.low, value), std::max(range.high, value)};
  return range.low > range.high ? Range{} : range;
}

std::vector<double> shown(const UnknownTable& table, const ColumnGuess& guess) {
  const Values* values = column_of(table, guess.column.value);
  if (values == nullptr) return {};
  Values brought = *values;
  if (guess.input && guess.input->value == "interval") brought = seconds_of(table, guess);
  const auto number = [](const std::optional<Told>& told, double otherwise) {
    return told ? input::parse_number(told->value).value_or(otherwise) : otherwise;
  };
  for (double& value : brought) value = (value - number(guess.zero, 0.0)) * number(guess.factor, 1.0);
  return brought;
}

std::optional<Readings> readings_of(const std::vector<const UnknownTable*>& tables,
                                    const std::string& column) {
  Readings all;
  for (const UnknownTable* table : tables) {
    const Values* values = column_of(*table, column);
    if (values == nullptr) return std::nullopt;
    all.values.push_back(values);
    const Range own = range_of(*values);
    all.range = {std::min(all.range.low, own.low), std::max(all.range.high, own.high)};
  }
  return all;
}

Together together(const std::vector<const Values*>& drive, const std::vector<const Values*>& reading) {
  std::vector<Values> drives;
  for (const Values* values : drive) drives.push_back(bridged(*values));
  Range range{1e300, -1e300};
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, syy = 0.0, sxy = 0.0;
  const auto each = [&](const auto& use) {
    for (std::size_t i = 0; i < drive.size(); ++i)
      for (std::size_t k = 0; k < std::min(drives[i].size(), reading[i]->size()); ++k)
        if (const double x = drives[i][k], y = (*reading[i])[k]; !std::isnan(x) && !std::isnan(y)) use(x, y);
  };
  each([&](double x, double y) {
    range = {std::min(range.low, x), std::max(range.high, x)};
    ++n;
    sx += x;
    sy += y;
  });
  if (n < 2.0) return {};
  Values lowest;
  each([&](double x, double y) {  // from the means, so that large zeros do not eat the digits
    sxx += (x - sx / n) * (x - sx / n);
    syy += (y - sy / n) * (y - sy / n);
    sxy += (x - sx / n) * (y - sy / n);
    if (x <= range.low + lowest_share * (range.high - range.low)) lowest.push_back(y);
  });
  const double spread = std::sqrt(sxx * syy);
  std::ranges::sort(lowest);
  const std::size_t end = lowest.size() / 20;  // 5 % on either side
  const double scatter = lowest.empty() ? 0.0 : lowest[lowest.size() - 1 - end] - lowest[end];
  return {spread > 0.0 ? sxy / spread : 0.0, data::upper_median(std::move(lowest)), scatter};
}

bool begins_still(const Values& values, const Range& range) {
  const std::size_t rows = std::min(values.size(), std::max(rows_of_a_beginning, values.size() / 200));
  const Range first = range_of({values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rows)});
  return first.high - first.low <= still_share * (range.high - range.low);
}

}  // namespace mckibben::recognise
