// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/series.hpp>
#include <sim/input/row_order.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t most_left_out = 20;  // one row in so many

/// Rows that repeat the stamp before. They stand twice if each repeats its readings, too: those of a coarse
/// clock differ where anything moves.
std::vector<std::size_t> doubled(const std::vector<double>& stamps,
                                 const std::function<bool(std::size_t)>& same) {
  std::vector<std::size_t> rows;
  bool moves = false;
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    moves = moves || !same(k);
    if (stamps[k] != stamps[k - 1]) continue;
    if (!same(k)) return {};
    rows.push_back(k);
  }
  return moves ? rows : std::vector<std::size_t>{};
}

/// Rows that do not fit between their neighbours. A clock that goes on from where it falls back to is right.
std::vector<std::size_t> misplaced(const std::vector<double>& stamps) {
  std::vector<std::size_t> kept, out;
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    if (std::isnan(stamps[k])) {
      out.push_back(k);
      continue;
    }
    const bool falls = !kept.empty() && stamps[k] < stamps[kept.back()];
    const bool last = k + 1 == stamps.size();
    if (falls && (last || stamps[k + 1] > stamps[kept.back()])) {
      out.push_back(k);
      continue;
    }
    if (falls && kept.size() > 1 &&
        stamps[k] > stamps[kept[kept.size() - 2]]) {  // the one before is too late
      out.push_back(kept.back());
      kept.pop_back();
    }
    kept.push_back(k);
  }
  std::ranges::sort(out);
  return out;
}

/// Rows by their stamps, if these come thrice and more out of order and yet lie without a gap: an export that
/// knows no order. Else none.
std::vector<std::size_t> sorted(const std::vector<double>& stamps) {
  constexpr int least_falls = 3;
  constexpr double gap = 3.0;  // usual steps
  int falls = 0;
  for (std::size_t k = 1; k < stamps.size(); ++k) falls += stamps[k] < stamps[k - 1] ? 1 : 0;
  if (falls < least_falls || std::ranges::any_of(stamps, [](double one) { return std::isnan(one); }))
    return {};
  std::vector<std::size_t> rows(stamps.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::ranges::stable_sort(rows, {}, [&](std::size_t row) { return stamps[row]; });
  std::vector<double> steps;
  for (std::size_t k = 1; k < rows.size(); ++k) steps.push_back(stamps[rows[k]] - stamps[rows[k - 1]]);
  const double usual = data::upper_median(steps);
  const bool one_record =
      std::ranges::all_of(steps, [&](double step) { return step > 0.0 && step <= gap * usual; });
  return one_record ? rows : std::vector<std::size_t>{};
}

/// Stamps that lie evenly but for their rounding, as 0.01, 0.02, 0.04 of 12 ms: they lie evenly then.
bool even_out(std::vector<double>& stamps) {
  constexpr double of_a_step = 0.01;      // less does not matter
  constexpr std::size_t least_rows = 20;  // fewer may lie evenly by chance
  if (stamps.size() < least_rows) return false;
  const std::size_t steps = stamps.size() - 1;
  const double step = (stamps.back() - stamps.front()) / static_cast<double>(steps);
  const auto even = [&](std::size_t row) { return stamps.front() + step * static_cast<double>(row); };
  double off = 0.0;
  for (std::size_t row = 0; row <= steps; ++row) off = std::max(off, std::abs(stamps[row] - even(row)));
  if (!(off > of_a_step * step) || off > step) return false;
  double grid = std::pow(10.0, std::ceil(std::log10(step)));
  const auto on_grid = [&](double stamp) {
    constexpr double digits = 1e-6;
    return std::abs(std::remainder(stamp, grid)) <= digits * grid;
  };
  for (; grid > off && !std::ranges::all_of(stamps, on_grid); grid /= 10.0) continue;
  if (grid < off) return false;
  std::vector<double> spread;
  for (std::size_t row = 0; row <= steps; ++row) spread.push_back(even(row));
  stamps = std::move(spread);
  return true;
}

std::string times(std::size_t number, const char* one, const char* many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

}  // namespace

bool run_on(std::vector<double>& stamps) {
  constexpr std::array wholes{60.0, 1000.0, 3600.0, 65536.0, 86400.0, 4294967296.0};
  constexpr double late = 1.5;  // usual steps: more is no counter that goes on
  constexpr double early = 0.5;
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k)
    if (stamps[k] > stamps[k - 1]) steps.push_back(stamps[k] - stamps[k - 1]);
  if (steps.empty()) return false;
  const double step = data::upper_median(std::move(steps)), start = stamps.front();
  double passed = 0.0, last = std::nan("");
  int over = 0, back = 0;  // how often it runs over; falls otherwise
  std::vector<double> gone_on = stamps;
  for (double& stamp : gone_on) {
    const double now = stamp;
    if (std::isnan(now)) continue;
    const auto goes_on = [&](double whole) {
      const double by = now + whole - last;
      return by >= early * step && by <= late * step;
    };
    if (now < last) {
      const auto* whole = std::ranges::find_if(wholes, goes_on);
      const bool runs_over = whole != wholes.end() && (passed > 0.0 || now != start);
      passed += runs_over ? *whole : 0.0;
      (runs_over ? over : back) += 1;
    }
    last = now;
    stamp += passed;
  }
  if (over <= back) return false;  // of rows in no order some look so
  stamps = std::move(gone_on);
  return true;
}

bool same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

RowOrder order_of_rows(const std::vector<double>& stamps, const std::function<bool(std::size_t)>& same) {
  RowOrder order;
  order.rows.resize(stamps.size());
  std::iota(order.rows.begin(), order.rows.end(), 0);
  const auto rises = [](double before, double now) { return !(now <= before); };
  if (stamps.size() > 2 && stamps.back() < stamps.front() &&
      std::ranges::adjacent_find(stamps, rises) == stamps.end()) {
    std::ranges::reverse(order.rows);
    order.note = "the newest rows stand first: they are read from the last to the first";
    return order;
  }
  if (std::vector<std::size_t> by_time = sorted(stamps); !by_time.empty()) {
    order.rows = std::move(by_time);
    order.note = "the rows are not in the order of their time: they are read in it";
    return order;
  }
  const std::vector<std::size_t> again = doubled(stamps, same), wrong = misplaced(stamps);
  std::vector<std::string> notes;
  const auto leave_out = [&](const std::vector<std::size_t>& rows, std::string what) {
    if (rows.empty()) return;
    if (notes.empty()) order.first = rows.front();
    std::erase_if(order.rows, [&](std::size_t row) { return std::ranges::binary_search(rows, row); });
    notes.push_back(std::move(what));
  };
  leave_out(again,
            times(again.size(), "row stands twice and is read once", "rows stand twice and are read once"));
  if (most_left_out * wrong.size() <= stamps.size())
    leave_out(wrong,
              times(wrong.size(), "row is left out: its time is missing, or not between its neighbours'",
                    "rows are left out: their time is missing, or not between their neighbours'"));
  order.note = fmt::format("{}", fmt::join(notes, "; "));
  return order;
}

Spread spread(std::vector<double>& stamps) {
  std::size_t repeats = 0;
  for (std::size_t row = 1; row < stamps.size(); ++row) {
    if (!(stamps[row] >= stamps[row - 1])) return {};
    repeats += stamps[row] == stamps[row - 1] ? 1 : 0;
  }
  if (stamps.empty() || stamps.front() == stamps.back()) return {};
  if (repeats == 0) return {0, even_out(stamps)};
  // Groups of one stamp; those between the first and the last say how far apart rows are.
  std::vector<std::size_t> begins;
  for (std::size_t row = 0; row < stamps.size(); ++row)
    if (row == 0 || stamps[row] != stamps[row - 1]) begins.push_back(row);
  const std::size_t last = begins.back(), groups = begins.size();
  const bool coarse = repeats > stamps.size() / 10;  // else single stamps repeat
  const double inner =
      coarse && groups > 2 ? (stamps[last] - stamps[begins[1]]) / static_cast<double>(last - begins[1]) : 0.0;
  const std::vector<double> read = stamps;
  for (std::size_t group = 0; group < groups; ++group) {
    const std::size_t row = begins[group], end = group + 1 < groups ? begins[group + 1] : stamps.size();
    const auto rows = static_cast<double>(end - row);
    const bool is_last = group + 1 == groups;
    const double whole =
        is_last ? (groups > 1 ? read[row] - read[begins[group - 1]] : 0.0) : read[end] - read[row];
    double step =
        is_last && inner == 0.0 ? whole / static_cast<double>(row - begins[group - 1]) : whole / rows;
    if (inner > 0.0 && (group == 0 || is_last)) step = std::min(step, inner);  // it may be a part of one
    const double first = group == 0 ? read[row] + whole - step * rows : read[row];
    for (std::size_t k = row; k < end; ++k) stamps[k] = first + step * static_cast<double>(k - row);
  }
  return {repeats, false};
}

}  // namespace mckibben::input
