// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <sim/data/clocks.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnPlace;

constexpr const ClockThresholds& of_clocks = thresholds.clock;

double typical_step_s(const std::vector<double>& time_s) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < time_s.size(); ++k) steps.push_back(time_s[k] - time_s[k - 1]);
  return steps.empty() ? 0.0 : upper_median(std::move(steps));
}

double lasts(const std::vector<double>& time_s) {
  return time_s.empty() ? 0.0 : time_s.back() - time_s.front();
}

std::string shown(double time_s) {
  if (time_s >= of_clocks.longest_run_s) return fmt::format("{:.3g} h", time_s / 3600.0);
  if (time_s >= 1.0) return fmt::format("{:.3g} s", time_s);
  return time_s >= 1e-3 ? fmt::format("{:.3g} ms", 1e3 * time_s) : fmt::format("{:.3g} us", 1e6 * time_s);
}

/// What a clock that goes so many times too fast may be instead, with the line to write: 1e3 of `unit: s`
/// asks for ms. What has a factor already is asked for another one.
std::string asked_of_clock(ColumnPlace time, double too_fast) {
  if (time.absent()) time = {"time_s", "s"};
  if (time.unit == "date") return "is that its clock? Dates may have lost parts of seconds";
  constexpr std::array<std::string_view, 4> units{"s", "ms", "us", "ns"};
  const auto thousands = static_cast<std::ptrdiff_t>(std::round(std::log10(too_fast) / 3.0));
  const auto said = std::ranges::find(units, time.unit);
  const std::ptrdiff_t at = said - units.begin() + thousands;
  const std::string was_unit = time.unit;
  const double was_factor = time.factor;
  std::string question;
  if (was_factor != 1.0) {
    time.factor = domain::significant(was_factor * std::pow(1e-3, static_cast<double>(thousands)), 6);
    question = fmt::format("is the factor of its time {:g}, not {:g}", time.factor, was_factor);
  } else if (said != units.end() && at >= 0 && at < std::ssize(units)) {
    time.unit = std::string(units[static_cast<std::size_t>(at)]);
    question = fmt::format("is its time in {}, not in {}", time.unit, was_unit);
  } else {
    return "is that its clock? unit and factor in columns: time say so";
  }
  return fmt::format("{}? Then write columns: {{{}}}", question, line_in_unit("time", time));
}

std::string lasts_next_to_nothing(const std::vector<double>& time_s, const ColumnPlace& time) {
  return fmt::format("lasts {:.3g} ms, its {} rows are {:.3g} us apart: {}", 1e3 * lasts(time_s),
                     time_s.size(), 1e6 * typical_step_s(time_s), asked_of_clock(time, 1e-3));
}

class Clocks {
 public:
  explicit Clocks(const domain::Dataset& data) : data_(data) {
    for (std::size_t run = 0; run < data.runs.size(); ++run)
      if (const auto& measured = data.runs[run].measured; measured && measured->point_s == 0.0)
        steps_s_[run] = typical_step_s(measured->time_s);
  }

  std::vector<Finding> operator()() {
    differ();
    no_rows();
    for (const auto& [run, step_s] : steps_s_) alone(run, step_s);
    return std::move(found_);
  }

 private:
  const std::vector<double>& time_s(std::size_t run) const { return data_.runs[run].measured->time_s; }
  ColumnPlace place(std::size_t run) const {
    return with_our_names(domain::merged(data_.columns, data_.runs[run].columns),
                          data_.rig.command_unit())["time"];
  }
  /// The same of several runs is one finding; numbers are those of the first.
  void find(const std::string& kind, std::size_t run, std::string message,
            Severity severity = Severity::doubtful) {
    const auto same = std::ranges::find_if(found_, [&](const Finding& one) {
      return kinds_[static_cast<std::size_t>(&one - found_.data())] == kind;
    });
    if (same != found_.end()) return same->runs.push_back(run);
    kinds_.push_back(kind);
    found_.push_back({.quantity = kind == "gap" ? "" : "time",
                      .runs = {run},
                      .message = std::move(message),
                      .severity = severity});
  }

  std::size_t slowest() const {
    return std::ranges::max_element(steps_s_, {}, [](const auto& one) { return one.second; })->first;
  }

  /// Runs whose rows are a thousand times as far apart as those of others: one of the two is in another unit,
  /// the slow ones where no recorder of motion is so slow.
  void differ() {
    if (steps_s_.empty()) return;
    const std::size_t slow = slowest();
    const bool slow_is_wrong = steps_s_[slow] >= of_clocks.longest_step_s;
    for (const auto& [fast, step_s] : steps_s_) {
      const double ratio = step_s > 0.0 ? steps_s_[slow] / step_s : 1.0;
      const double thousands = std::pow(1e3, std::round(std::log10(ratio) / 3.0));
      if (thousands == 1.0 || std::abs(std::log(ratio / thousands)) > std::log(of_clocks.near_unit)) continue;
      for (const auto& [run, own_s] : steps_s_) {
        const bool is_slow = own_s * std::sqrt(thousands) > steps_s_[slow];
        if (is_slow != slow_is_wrong || is_asked(run)) continue;
        find(place(run).unit, run,
             fmt::format("lasts {}, its rows are {} apart, those of run {} {}: {}", shown(lasts(time_s(run))),
                         shown(own_s), data_.runs[slow_is_wrong ? fast : slow].id,
                         shown(slow_is_wrong ? step_s : steps_s_[slow]),
                         asked_of_clock(place(run), slow_is_wrong ? thousands : 1.0 / thousands)));
      }
      return;
    }
  }
  bool is_asked(std::size_t run) const {
    return std::ranges::any_of(found_, [&](const Finding& one) {
      return one.quantity == "time" && std::ranges::find(one.runs, run) != one.runs.end();
    });
  }

  /// Nothing can be judged then; where a unit has been asked for, that is why.
  void no_rows() {
    const std::vector<std::size_t> runs = runs_without_rows(data_);
    if (!runs.empty() && !found_.empty())
      for (Finding& one : found_) one.severity = Severity::refused;
    else
      for (const std::size_t run : runs)
        find(
            "none", run,
            fmt::format("no row is left of it: it lasts {}{}, and rows are {} apart, as those of the slowest "
                        "run; is the unit of time right in both, in columns: time?",
                        shown(lasts(time_s(run))),
                        data_.runs[run].measured->recorded.skip_s > 0.0 ? " with what is skipped" : "",
                        shown(row_s_of(data_))),
            Severity::refused);
  }

  void alone(std::size_t run, double step_s) {
    const std::vector<double>& stamps_s = time_s(run);
    if (stamps_s.size() < 3) return;
    const double lasts_s = lasts(stamps_s);
    const bool asked = is_asked(run);
    if (const std::string why = too_short(stamps_s, place(run)); !why.empty())
      return find("short", run, why, Severity::refused);
    if (!asked && step_s < of_clocks.short_step_s && lasts_s < of_clocks.short_run_s)
      find("brief", run, lasts_next_to_nothing(stamps_s, place(run)));
    if (!asked && step_s >= of_clocks.longest_step_s && lasts_s > of_clocks.longest_run_s)
      find("long", run,
           fmt::format("lasts {:.3g} h, its rows are {:.3g} s apart: {}", lasts_s / 3600.0, step_s,
                       asked_of_clock(place(run), 1e3)));
    gaps(run, step_s);
  }

  void gaps(std::size_t run, double step_s) {
    const std::vector<double>& stamps_s = time_s(run);
    const double bridge_s = data_.runs[run].measured->recorded.bridge_s;
    const double bridged_s = bridge_s > domain::Recorded{}.bridge_s ? bridge_s : 0.0;  // somebody said so
    std::size_t gaps = 0, widest = 1;
    for (std::size_t k = 1; k < stamps_s.size(); ++k) {
      const double gap_s = stamps_s[k] - stamps_s[k - 1];
      if (gap_s > std::max({of_clocks.gap_steps * step_s, of_clocks.gap_s, bridged_s})) ++gaps;
      if (gap_s > stamps_s[widest] - stamps_s[widest - 1]) widest = k;
    }
    if (gaps > 0 && static_cast<double>(gaps) < of_clocks.most_gaps * static_cast<double>(stamps_s.size()))
      find(
          "gap", run,
          fmt::format(
              "no rows from {:.4g} s to {:.4g} s, elsewhere {:.3g} ms apart{}: what drove the rig meanwhile "
              "is not known; leave out what is after or before it: to: {:.6g} s or from: {:.6g} s of the run",
              stamps_s[widest - 1], stamps_s[widest], 1e3 * step_s,
              gaps > 1 ? fmt::format(" ({} gaps)", gaps) : "", stamps_s[widest - 1] - stamps_s.front(),
              stamps_s[widest] - stamps_s.front()));
  }

  const domain::Dataset& data_;
  std::map<std::size_t, double> steps_s_{};  ///< of runs with stamps
  std::vector<Finding> found_{};
  std::vector<std::string> kinds_{};  ///< of each finding
};

}  // namespace

std::string too_short(const std::vector<double>& time_s, ColumnPlace time) {
  if (time_s.size() < 3 || lasts(time_s) >= of_clocks.shortest_run_s ||
      typical_step_s(time_s) >= of_clocks.shortest_step_s)
    return "";
  return lasts_next_to_nothing(time_s, time);
}

std::vector<Finding> wrong_clocks(const domain::Dataset& data) {
  return Clocks(data)();
}

}  // namespace mckibben::data
