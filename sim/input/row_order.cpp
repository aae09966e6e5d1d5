// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/row_order.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t most_left_out = 20;  // one row in so many

/// Rows that repeat the stamp before. They stand same if each repeats its readings, too: those of a coarse
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

std::string times(std::size_t number, const char* one, const char* many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

}  // namespace

bool run_on(std::vector<double>& stamps) {
  constexpr std::array wholes{1000.0, 65536.0, 4294967296.0};
  constexpr double late = 1.5;  // steps: more is no counter that goes on
  double passed = 0.0, step = 0.0, last = std::nan("");
  const double start = stamps.empty() ? 0.0 : stamps.front();
  for (double& stamp : stamps) {
    const double now = stamp;
    if (std::isnan(now)) continue;
    if (now > last) step = now - last;
    if (now < last && (passed > 0.0 || now != start))
      for (const double whole : wholes)
        if (now + whole > last && now + whole - last <= late * step) {
          passed += whole;
          break;
        }
    last = now;
    stamp += passed;
  }
  return passed > 0.0;
}

RowOrder order_of_rows(const std::vector<double>& stamps, const std::function<bool(std::size_t)>& same) {
  RowOrder order;
  order.rows.resize(stamps.size());
  std::iota(order.rows.begin(), order.rows.end(), 0);
  const auto falls = [](double before, double now) { return !(now < before); };
  if (stamps.size() > 2 && std::ranges::adjacent_find(stamps, falls) == stamps.end()) {
    std::ranges::reverse(order.rows);
    order.note = "the newest rows stand first: they are read from the last to the first";
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

}  // namespace mckibben::input
