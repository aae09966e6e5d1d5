// See the header. Every pair of columns is tried: the first runs are simulated with each.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/gains.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/parts.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/run/exchanged.hpp>
#include <sim/run/look.hpp>

namespace mckibben::run {
namespace {

using domain::ColumnPlace, domain::line_of, domain::MeasuredColumn;

constexpr const data::ExchangedThresholds& of_trial = data::thresholds.exchanged;
constexpr double never = std::numeric_limits<double>::infinity();

/// The first moments of the first runs.
domain::Dataset first_of(domain::Dataset data) {
  if (data.runs.size() > of_trial.most_runs)
    data.runs.erase(data.runs.begin() + static_cast<std::ptrdiff_t>(of_trial.most_runs), data.runs.end());
  for (domain::Run& run : data.runs) {
    const std::size_t stamps = std::min(run.measured->time_s.size(), of_trial.most_stamps);
    run.measured->time_s.resize(stamps);
    for (MeasuredColumn& column : run.measured->columns)
      if (!column.values.empty()) column.values.resize(stamps);
  }
  return data;
}

bool reads_something(const domain::Run& run) {
  return run.measured && std::ranges::any_of(run.measured->columns, [](const MeasuredColumn& column) {
           return !column.given && domain::is_read(column.values);
         });
}

/// Of the squares of each reading, what the rig leaves; of that which it leaves most of. A cord's force goes
/// about its load, all else about its mean.
double left_of(domain::Dataset data) {
  if (!data::runs_without_rows(data).empty()) return never;
  data = data::with_rows(std::move(data));
  const std::size_t most_rows = std::clamp<std::size_t>(
      static_cast<std::size_t>(data::thresholds.look.most_s / data.row_s()), 2, of_trial.most_rows);
  for (domain::Run& run : data.runs) run = data::beginning_of(std::move(run), most_rows);
  const std::vector<data::Expected> expected =
      expected_of(data, replay(data, 0, [](const auto&, auto, auto) {}));
  std::map<std::string, data::Compared> readings;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::Run& run = data.runs[i];
    if (run.readings.empty() || expected[i].judged().size() != run.rows()) return never;
    for (std::size_t place = 0; place < run.readings.size(); ++place)
      readings[run.readings[place].channel.key_in_dataset()].add(i, run, expected[i], place);
  }
  double worst = 0.0;
  for (const auto& [key, rows] : readings) {
    if (rows.measured.empty()) continue;
    const bool of_cord = key == "force" && data.rig.lifts_a_load();
    const double about = of_cord ? 0.0 : data::mean(rows.measured);
    double left = 0.0, all = 0.0;
    for (std::size_t k = 0; k < rows.measured.size(); ++k) {
      left += std::pow(rows.measured[k] - rows.model[k], 2);
      all += std::pow(rows.measured[k] - about, 2);
    }
    worst = std::max(worst, all > 0.0 ? left / all : never);
  }
  return worst;
}

/// What one of its column is in ours, by all that `columns` says; 0 where that is not known here.
double size_of(const domain::Run& run, const plant::Channel& channel, const ColumnPlace& place) {
  return place.factor * data::size_in_ours(run, channel, place.unit).value_or(0.0);
}

/// The lines of `columns` in which they are exchanged; empty if the two cannot be, in one of the runs.
std::string exchange(domain::Dataset& data, std::size_t one, std::size_t other) {
  std::string lines;
  for (domain::Run& run : data.runs) {
    auto& columns = run.measured->columns;
    if (std::max(one, other) >= columns.size()) return "";
    MeasuredColumn &a = columns[one], &b = columns[other];
    const domain::ColumnMap map = domain::merged(data.columns, run.columns);
    ColumnPlace as_a = map[a.channel.key_in_dataset()], as_b = map[b.channel.key_in_dataset()];
    const double of_a = size_of(run, a.channel, as_a), of_b = size_of(run, b.channel, as_b);
    // Of two muscles' commands the joint's other sign would say the same, but for their gauges.
    const bool told_apart = a.channel.signal != b.channel.signal ||
                            (a.is_command() && std::ranges::any_of(columns, [](const MeasuredColumn& column) {
                               return !column.given && column.channel.is_pressure();
                             }));
    if (!told_apart || a.values.size() != b.values.size() || as_a.absent() || as_b.absent() ||
        as_a.has_own_clock() || as_b.has_own_clock() || of_a == 0.0 || of_b == 0.0)
      return "";
    for (std::size_t k = 0; k < a.values.size(); ++k) {
      const double read_a = a.values[k] / of_a + as_a.zero, read_b = b.values[k] / of_b + as_b.zero;
      if ((a.given && std::isnan(read_b)) || (b.given && std::isnan(read_a))) return "";
      a.values[k] = (read_b - as_a.zero) * of_a;
      b.values[k] = (read_a - as_b.zero) * of_b;
    }
    std::swap(as_a.column, as_b.column);
    if (lines.empty())
      lines = fmt::format("{}, {}", line_of(a.channel.key_in_dataset(), as_a),
                          line_of(b.channel.key_in_dataset(), as_b));
  }
  return lines;
}

/// Whether a column's values differ, over all runs: what never moves is told by no motion.
bool moves(const domain::Dataset& data, std::size_t column) {
  double low = never, high = -never;
  for (const domain::Run& run : data.runs)
    if (column < run.measured->columns.size())
      for (const double value : run.measured->columns[column].values)
        low = std::fmin(low, value), high = std::fmax(high, value);
  return low < high;
}

/// In all of these runs.
std::optional<data::Finding> exchanged_in(const domain::Dataset& data, double least_left) {
  const domain::Dataset first = first_of(data);
  const double as_said = left_of(first);
  if (as_said < least_left) return std::nullopt;
  const auto& columns = first.runs.front().measured->columns;
  double least = std::min(of_trial.most_left, of_trial.nearer * as_said);
  std::optional<data::Finding> found;
  for (std::size_t one = 0; one < columns.size(); ++one)
    for (std::size_t other = 0; other < one; ++other) {
      if (!moves(first, one) || !moves(first, other)) continue;
      domain::Dataset tried = first;
      const std::string lines = exchange(tried, other, one);
      if (lines.empty()) continue;
      const double left = left_of(std::move(tried));
      if (!(left < least)) continue;
      least = left;
      const std::string a = columns[other].channel.key_in_dataset(),
                        b = columns[one].channel.key_in_dataset();
      found = data::Finding{.quantity = a,
                            .message = fmt::format("{} and {} look exchanged: so the rig does what was read, "
                                                   "but for {:.0f} %, and as they are it does not; write "
                                                   "columns: {{{}}}, with factor: 1 where a heading says "
                                                   "another unit",
                                                   a, b, 100.0 * std::sqrt(left), lines)};
    }
  return found;
}

}  // namespace

std::optional<data::Finding> exchanged_columns(const domain::Dataset& data) {
  if (!data.own_clock || data.rows_of_stamps || data.runs.empty() ||
      !std::ranges::all_of(data.runs, reads_something))
    return std::nullopt;
  if (auto found = exchanged_in(data, of_trial.least_left)) {
    found->runs.resize(data.runs.size());
    std::iota(found->runs.begin(), found->runs.end(), std::size_t{0});
    return found;
  }
  std::optional<data::Finding> found;  // of single runs, those of the first
  domain::Dataset alone = data;
  for (std::size_t i = 0; i < std::min(data.runs.size(), of_trial.most_single); ++i) {
    alone.runs = {data.runs[i]};
    auto own = exchanged_in(alone, of_trial.none_left);
    if (!own) continue;
    const auto pair = [](const data::Finding& one) { return one.message.substr(0, one.message.find(':')); };
    if (!found) found = own;
    if (pair(*own) == pair(*found)) found->runs.push_back(i);
  }
  return found;
}

std::vector<data::Finding> asked_of(const domain::Dataset& data) {
  std::vector<data::Finding> findings = data::implausible(data);
  const auto of_time = [](const data::Finding& one) { return one.quantity == "time"; };
  if (std::ranges::none_of(findings, of_time))
    if (auto found = exchanged_columns(data)) return {std::move(*found)};
  return findings;
}

}  // namespace mckibben::run
