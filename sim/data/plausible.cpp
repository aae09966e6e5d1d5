// See the header.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/judged.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/scatter.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnPlace, domain::line_of;
using Series = std::vector<double>;

constexpr const PlausibleThresholds& limits = thresholds.plausible;

Series known(const Series& values) {
  Series list;
  for (const double value : values)
    if (!std::isnan(value)) list.push_back(value);
  return list;
}

double typical_step_s(const Series& time_s) {
  Series steps;
  for (std::size_t k = 1; k < time_s.size(); ++k) steps.push_back(time_s[k] - time_s[k - 1]);
  return steps.empty() ? 0.0 : upper_median(std::move(steps));
}

struct PressureUnit {
  std::string_view name;
  double size_Pa;
};
constexpr PressureUnit pressure_units[] = {{"MPa", 1e6}, {"bar", 1e5},  {"psi", 6894.757}, {"kPa", 1e3},
                                           {"hPa", 1e2}, {"mbar", 1e2}, {"Pa", 1.0}};

std::optional<double> size_Pa(std::string_view unit) {
  for (const PressureUnit& one : pressure_units)
    if (unit == one.name) return one.size_Pa;
  return std::nullopt;
}

class Plausible {
 public:
  explicit Plausible(const domain::Dataset& data) : data_(data) {}

  std::vector<Finding> operator()() {
    for (run_ = 0; run_ < data_.runs.size(); ++run_) {
      map_ = with_our_names(domain::merged(data_.columns, run().columns), data_.rig.command_unit());
      if (run().measured && run().measured->point_s == 0.0) clock(run().measured->time_s);
      if (run().measured)
        for (const domain::MeasuredColumn& column : run().measured->columns) look_at(column);
      else
        never_moves("contraction", run().contraction_ratio);
    }
    same_rows();
    return std::move(found_);
  }

 private:
  const domain::Run& run() const { return data_.runs[run_]; }
  std::string line(const std::string& key, const ColumnPlace& meant) const {
    return fmt::format("write columns: {{{}}}", line_of(key, meant));
  }
  /// The same of several runs is one finding; numbers are those of the first.
  void find(const std::string& quantity, const std::string& kind, std::string message, Severity severity) {
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (kinds_[i] == quantity + kind && found_[i].severity == severity) {
        if (found_[i].runs.back() != run_) found_[i].runs.push_back(run_);
        return;
      }
    kinds_.push_back(quantity + kind);
    found_.push_back(
        {.quantity = quantity, .runs = {run_}, .message = std::move(message), .severity = severity});
  }

  void clock(const Series& time_s) {
    if (time_s.size() < 3) return;
    const double lasts_s = time_s.back() - time_s.front(), step_s = typical_step_s(time_s);
    ColumnPlace meant = map_["time"];
    if (lasts_s < limits.shortest_run_s && step_s < limits.shortest_step_s) {
      const std::string said = meant.unit;
      meant.unit = said == "ms" ? "s" : said == "us" ? "ms" : said == "ns" ? "us" : "s";
      find("time", "short",
           fmt::format(
               "lasts {:.3g} ms, its {} rows are {:.3g} us apart: is its time in {}, not in {}? Then {}",
               1e3 * lasts_s, time_s.size(), 1e6 * step_s, meant.unit, said, line("time", meant)),
           Severity::refused);
      return;
    }
    if (step_s >= limits.longest_step_s && lasts_s > limits.longest_run_s) {
      const std::string said = meant.unit;
      meant.unit = said == "s" ? "ms" : said == "ms" ? "us" : "ns";
      find("time", "long",
           fmt::format("lasts {:.3g} h, its rows are {:.3g} s apart: is its time in {}, not in {}? Then {}",
                       lasts_s / 3600.0, step_s, meant.unit, said, line("time", meant)),
           Severity::doubtful);
    }
    std::size_t gaps = 0, widest = 1;
    for (std::size_t k = 1; k < time_s.size(); ++k) {
      const double gap_s = time_s[k] - time_s[k - 1];
      if (gap_s > std::max(limits.gap_steps * step_s, limits.gap_s)) ++gaps;
      if (gap_s > time_s[widest] - time_s[widest - 1]) widest = k;
    }
    if (gaps > 0 && static_cast<double>(gaps) < limits.most_gaps * static_cast<double>(time_s.size()))
      find("", "gap",
           fmt::format(
               "no rows from {:.4g} s to {:.4g} s, elsewhere {:.3g} ms apart{}: what drove the rig meanwhile "
               "is not known; leave the rows before or after it out with from: or to: of the run",
               time_s[widest - 1], time_s[widest], 1e3 * step_s,
               gaps > 1 ? fmt::format(" ({} gaps)", gaps) : ""),
           Severity::doubtful);
  }

  void look_at(const domain::MeasuredColumn& column) {
    const std::string key = column.channel.key_in_dataset();
    if (column.is_pressure()) {
      if (column.given && column.channel.signal->key == "muscle_pressure") given_pressure(key, column.values);
      return;
    }
    const bool position = key == "contraction" || key == "angle";
    if (!position || column.given) return;
    never_moves(key, column.values);
    grid(key, column.values);
  }

  void never_moves(const std::string& key, const Series& values) {
    const Series readings = known(values);
    if (readings.size() < limits.least_rows || range(readings) > 0.0 || !drive_moves()) return;
    find(key, "dead",
         fmt::format(
             "{} never moves, though what drives the rig does: is {} the right column, and was its sensor "
             "connected?",
             key, map_[key].column),
         Severity::doubtful);
  }

  bool drive_moves() const {
    if (!run().measured) return !run().current_mA.empty() && range(run().current_mA) > 0.0;
    return std::ranges::any_of(run().measured->columns, [](const domain::MeasuredColumn& column) {
      const Series values = known(column.values);
      return column.given && !values.empty() && range(values) > 0.0;
    });
  }

  void given_pressure(const std::string& key, const Series& values_Pa) {
    const Series values = known(values_Pa);
    if (values.size() < limits.least_rows) return;
    const double low = std::ranges::min(values), high = std::ranges::max(values);
    const double supply_Pa = data_.rig.valve.supply_pressure_Pa;
    const ColumnPlace& said = map_[key];
    if (high > limits.beyond_supply * supply_Pa && high > limits.high_Pa) {
      std::string meant;  // the largest unit in which the supply would do
      for (const PressureUnit& one : pressure_units) {
        const double would_be_Pa = high * one.size_Pa / size_Pa(said.unit).value_or(0.0);
        if (would_be_Pa > limits.beyond_supply * supply_Pa) continue;
        ColumnPlace place = said;
        place.unit = one.name;
        meant = fmt::format("as {} it would be {:.3g} bar; if that is right, {}, otherwise ", one.name,
                            would_be_Pa / plant::Pa_per_bar, line(key, place));
        break;
      }
      find(key, "high",
           fmt::format("{} is up to {:.4g} bar, and the rig's supply has {:.3g} bar; {}set "
                       "valve.supply_pressure of the rig",
                       key, high / plant::Pa_per_bar, supply_Pa / plant::Pa_per_bar, meant),
           Severity::refused);
      return;
    }
    if (high < limits.lifts_nothing_Pa && moves_far()) {
      find(key, "low",
           fmt::format(
               "{} is never above {:.3g} bar, which moves no muscle, and yet it moves: is it in another unit "
               "than {}? Then write so, as in columns: {{{}}}",
               key, high / plant::Pa_per_bar, said.unit,
               line_of(key, {said.column, "bar", said.zero, said.factor})),
           Severity::refused);
      return;
    }
    const auto rests =
        std::ranges::count_if(values, [&](double value) { return value < low + limits.rests * low; });
    if (low > limits.least_atmosphere_Pa && low < limits.most_atmosphere_Pa && said.zero == 0.0 &&
        static_cast<double>(rests) > limits.resting_share * static_cast<double>(values.size())) {
      find(
          key, "absolute",
          fmt::format(
              "{} rests at {:.4g} bar: is it absolute? Then zero is what its gauge reads in open air, {:.6g} "
              "bar in its unit ({}): columns: {{{}}}",
              key, low / plant::Pa_per_bar, data_.rig.gas.atmosphere_Pa / plant::Pa_per_bar, said.unit,
              line_of(key, {said.column, said.unit, zero_of_atmosphere(said), said.factor})),
          Severity::doubtful);
    }
  }

  double zero_of_atmosphere(const ColumnPlace& said) const {
    const std::optional<double> unit_Pa = size_Pa(said.unit);
    return unit_Pa ? data_.rig.gas.atmosphere_Pa / *unit_Pa / said.factor : 1.01325;
  }

  bool moves_far() const {
    const Series readings = known(run().measured->read("contraction"));
    return readings.size() > limits.least_rows && range(readings) > limits.moves_far;
  }

  void grid(const std::string& key, const Series& values) {
    if (run().measured->counted || run().measured->point_s > 0.0) return;
    const plant::Sensor& sensor = data_.rig.sensors.position();
    const Series readings = known(values);
    std::size_t stays = 0;  // a slow motion on a grid stays where it is; an even one has even moves as well
    for (std::size_t k = 1; k < readings.size(); ++k) stays += readings[k] == readings[k - 1] ? 1 : 0;
    if (static_cast<double>(stays) < limits.stays * static_cast<double>(readings.size())) return;
    const double said = reading_per_count(data_.rig), step = step_of(readings);
    if (step < limits.coarser * said || step > limits.coarsest) return;
    find(key, "grid",
         fmt::format(
             "{} is in steps {:.3g} times what the rig's sensor resolves: sensors: [{{signal: {}, kind: {}, "
             "resolution: ...}}] of the rig should say the larger one",
             key, step / said, key, name_of(sensor.kind)),
         Severity::doubtful);
  }

  /// The same rows of one file, or the same numbers under another name.
  void same_rows() {
    for (std::size_t i = 0; i < data_.runs.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const domain::Run &one = data_.runs[k], &other = data_.runs[i];
        if (!same(one, other)) continue;
        const bool loads = one.given_load_kg != other.given_load_kg;
        found_.push_back({.quantity = loads ? "load" : "",
                          .runs = {i},
                          .message = fmt::format(
                              "holds the same rows as run {}{}: {}", one.id,
                              loads ? fmt::format(", under another load ({:.6g} and {:.6g} kg)", one.load_kg,
                                                  other.load_kg)
                                    : "",
                              one.file == other.file ? "name its own file" : "is one a copy of the other?"),
                          .severity = Severity::doubtful});
        kinds_.emplace_back("same");
        break;
      }
  }

  static bool equal(const Series& a, const Series& b) {
    return std::ranges::equal(a, b,
                              [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  }
  static bool same(const domain::Run& a, const domain::Run& b) {
    if (a.measured.has_value() != b.measured.has_value()) return false;
    if (!a.measured && a.current_mA.size() <= limits.least_rows) return false;
    if (!a.measured)
      return equal(a.current_mA, b.current_mA) && equal(a.contraction_ratio, b.contraction_ratio);
    return a.measured->time_s.size() > limits.least_rows && equal(a.measured->time_s, b.measured->time_s) &&
           std::ranges::equal(a.measured->columns, b.measured->columns, [](const auto& x, const auto& y) {
             return x.given == y.given && equal(x.values, y.values);
           });
  }

  const domain::Dataset& data_;
  std::size_t run_ = 0;
  domain::ColumnMap map_;
  std::vector<Finding> found_;
  std::vector<std::string> kinds_;  ///< of each finding
};

}  // namespace

std::vector<Finding> implausible(const domain::Dataset& data) {
  return Plausible(data)();
}

}  // namespace mckibben::data
