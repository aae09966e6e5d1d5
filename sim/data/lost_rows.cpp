// See the header.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/lost_rows.hpp>
#include <sim/data/scatter.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

using Series = std::vector<double>;

constexpr const LostRowThresholds& of_lost_rows = thresholds.lost_rows;

/// What was recorded of a signal, row by row; NaN where it is missing.
struct Signal {
  enum class Kind { position, pressure, command, other } kind;
  Series values;
};

Signal::Kind kind_of(const plant::Channel& channel) {
  if (channel.is_pressure()) return Signal::Kind::pressure;
  return channel.is("contraction") || channel.is("angle") ? Signal::Kind::position : Signal::Kind::other;
}

struct Recording {
  Series time_s;
  std::vector<Signal> columns;

  Recording(const domain::Run& run, double tick_s) {
    if (run.readings.empty() && run.measured) {
      of_stamps(*run.measured);
      return;
    }
    for (const domain::Reading& reading : run.readings) {
      columns.push_back({kind_of(reading.channel), reading.values});
      for (std::size_t k = 0; k < reading.values.size(); ++k)
        if (reading.is_missing(k)) columns.back().values[k] = std::nan("");
    }
    if (!run.current_mA.empty()) columns.push_back({Signal::Kind::command, run.current_mA});
    time_s = run.time_s;
    for (std::size_t k = time_s.size(); k < run.rows(); ++k)
      time_s.push_back(static_cast<double>(k) * tick_s);
  }

 private:
  void of_stamps(const domain::Measurement& measured) {
    if (measured.point_s > 0.0) return;
    time_s = measured.time_s;
    for (const domain::MeasuredColumn& column : measured.columns)
      if (!column.values.empty() && !(column.given && kind_of(column.channel) == Signal::Kind::position))
        columns.push_back(
            {column.is_command() ? Signal::Kind::command : kind_of(column.channel), column.values});
  }
};

/// Whether from row `k` on a signal is elsewhere than before, and beside that next to still on both sides.
bool is_jump(const Series& values, std::size_t k, double least) {
  const std::span<const double> before(&values[k - of_lost_rows.beside], of_lost_rows.beside),
      after(&values[k], of_lost_rows.beside);
  return std::abs(mean(after) - mean(before)) >
         std::max(least, of_lost_rows.stands_out * std::max(range(before), range(after)));
}

/// Rows at which it jumps; those in which its cell is empty are none of its own.
std::vector<std::size_t> rows_that_jump(const Series& values) {
  Series known;
  std::vector<std::size_t> rows, found;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isnan(values[k])) known.push_back(values[k]), rows.push_back(k);
  if (known.size() < 2 * of_lost_rows.beside) return found;
  const double least =
      std::max(of_lost_rows.grains * step_of(known), of_lost_rows.noises * slow_noise(known));
  for (std::size_t k = of_lost_rows.beside; k + of_lost_rows.beside <= known.size(); ++k)
    if (is_jump(known, k, least)) found.push_back(rows[k]);
  return found;
}

}  // namespace

std::vector<std::size_t> after_lost_rows(const domain::Run& run, double tick_s) {
  const Recording rows(run, tick_s);
  std::vector<std::size_t> found;
  if (rows.time_s.size() < 2 * of_lost_rows.beside) return found;
  Series gaps_s;
  for (std::size_t k = 1; k < rows.time_s.size(); ++k) gaps_s.push_back(rows.time_s[k] - rows.time_s[k - 1]);
  const double row_s = upper_median(std::move(gaps_s));
  if (row_s > of_lost_rows.slowest_row_s) return found;
  const auto none = std::ranges::none_of(
      rows.columns, [](const Signal& column) { return column.kind == Signal::Kind::pressure; });
  const Signal::Kind drives = none ? Signal::Kind::command : Signal::Kind::pressure;
  std::map<Signal::Kind, std::vector<std::size_t>> jumping;
  for (const Signal& column : rows.columns)
    std::ranges::copy(rows_that_jump(column.values), std::back_inserter(jumping[column.kind]));
  for (const std::size_t k : jumping[Signal::Kind::position])
    if (rows.time_s[k] - rows.time_s[k - 1] < of_lost_rows.gap_rows * row_s &&
        std::ranges::find(jumping[drives], k) != jumping[drives].end())
      found.push_back(k);
  if (found.size() > of_lost_rows.most) found.clear();
  return found;
}

std::vector<Finding> lost_rows(const domain::Dataset& data) {
  std::vector<Finding> findings;
  std::vector<Series> stamps_s;
  for (const domain::Run& run : data.runs) stamps_s.push_back(Recording(run, data.rig.tick_s).time_s);
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const Series& time_s = stamps_s[i];
    const std::vector<std::size_t> rows = after_lost_rows(data.runs[i], data.rig.tick_s);
    if (rows.empty()) continue;
    const std::size_t k = rows.front(), others = stamps_s[i == 0 ? stamps_s.size() - 1 : 0].size();
    std::string fewer;
    if (others > time_s.size() && std::ranges::all_of(stamps_s, [&](const Series& one) {
          return &one == &time_s || one.size() == others;
        }))
      fewer = fmt::format("; the run has {} rows fewer than each other one, {:.3g} s", others - time_s.size(),
                          static_cast<double>(others - time_s.size()) * (time_s[k] - time_s[k - 1]));
    findings.push_back(
        {.runs = {i},
         .message = fmt::format(
             "from {:.4g} s to {:.4g} s, its rows {} and {}, all that was recorded jumps at once: rows are "
             "missing, and the stamps go on as if none were{}{}; leave out what is after or before it: "
             "to: {:.6g} s or from: {:.6g} s of the run",
             time_s[k - 1], time_s[k], k, k + 1, rows.size() > 1 ? ", and later again" : "", fewer,
             time_s[k - 1] - time_s.front(), time_s[k] - time_s.front()),
         .severity = Severity::doubtful});
  }
  return findings;
}

}  // namespace mckibben::data
