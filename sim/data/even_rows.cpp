// See the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <sim/data/even_rows.hpp>
#include <sim/data/scatter.hpp>
#include <sim/data/series.hpp>

namespace mckibben::data {
namespace {

/// Instants and values of a reading where it is not missing.
struct ReadAt {
  std::vector<double> time_s{}, values{};
};

ReadAt known_of(const domain::Run& run, const domain::Reading& reading) {
  ReadAt known;
  for (std::size_t k = 0; k < reading.values.size(); ++k) {
    if (reading.is_missing(k)) continue;
    known.time_s.push_back(run.time_s[k]);
    known.values.push_back(reading.values[k]);
  }
  return known;
}

std::vector<double> gaps_of(const std::vector<double>& time_s) {
  std::vector<double> gaps_s;
  for (std::size_t k = 1; k < time_s.size(); ++k) gaps_s.push_back(time_s[k] - time_s[k - 1]);
  return gaps_s;
}

void make_even(domain::Run& run, double row_s) {
  const ReadAt read = known_of(run, run.judged());
  if (read.time_s.empty()) return;
  constexpr double rounding = 1e-6;
  const double begin_s = read.time_s.front(), zero_s = run.measured->time_s.front();
  const auto rows = static_cast<std::size_t>((read.time_s.back() - begin_s) / row_s + rounding) + 1;
  std::vector<double> time_s;
  for (std::size_t k = 0; k < rows; ++k) time_s.push_back(begin_s + static_cast<double>(k) * row_s);
  const auto straight = [&](const ReadAt& known) {
    const Column column(known.time_s, known.values);
    std::vector<double> values;
    for (const double at_s : time_s) values.push_back(column.between(column.last_before(at_s), at_s));
    return values;
  };
  std::vector<domain::Reading> even;
  for (const domain::Reading& reading : run.readings)
    if (const ReadAt known = known_of(run, reading); !known.time_s.empty())
      even.push_back({reading.channel, straight(known)});
  const Column command(run.measured->time_s, run.measured->given("command"));
  const bool linear = run.measured->recorded.hold == domain::Hold::linear;
  run.current_mA.clear();
  for (const double at_s : time_s)
    run.current_mA.push_back(command.mean(zero_s + at_s, zero_s + at_s + row_s, linear));
  run.readings = std::move(even);
  run.time_s = std::move(time_s);
}

}  // namespace

Spacing spacing_of(const domain::Dataset& data) {
  constexpr double bridged = 3.0;  // rows, straight over which no load bends by much
  constexpr double is_tick = 0.01;
  Spacing found;
  std::vector<std::vector<double>> all;
  for (const domain::Run& run : data.runs) {
    all.push_back(known_of(run, run.judged()).time_s);
    if (all.back().size() > 1) found.row_s = std::max(found.row_s, upper_median(gaps_of(all.back())));
  }
  if (std::abs(found.row_s - data.rig.tick_s) < is_tick * data.rig.tick_s) found.row_s = data.rig.tick_s;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<double> gaps_s = gaps_of(all[i]);
    if (gaps_s.empty()) continue;
    const auto [narrowest, widest] = std::ranges::minmax_element(gaps_s);
    found.narrowest_s = std::min(found.narrowest_s, *narrowest);
    found.widest_s = std::max(found.widest_s, *widest);
    if (*widest <= bridged * found.row_s) continue;
    if (found.gaps.empty()) {
      found.gap_s = *widest;
      found.gap_at_s = all[i][static_cast<std::size_t>(widest - gaps_s.begin()) + 1];
    }
    found.gaps.push_back(i);
  }
  return found;
}

bool Spacing::is_even() const {
  constexpr double as_even = 0.1;  // of a row
  return widest_s - row_s <= as_even * row_s && row_s - narrowest_s <= as_even * row_s;
}

void make_even(domain::Dataset& data, double row_s) {
  for (domain::Run& run : data.runs) make_even(run, row_s);
  data.rows_of_stamps->row_s = row_s;
}

}  // namespace mckibben::data
