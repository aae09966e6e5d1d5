// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/data/amount.hpp>
#include <sim/data/clocks.hpp>
#include <sim/data/lost_rows.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/rounded.hpp>
#include <sim/data/scatter.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/units.hpp>
#include <sim/domain/number.hpp>

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

/// Below which that share of them lies.
double lower_share(Series values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::ranges::nth_element(values, at);
  return *at;
}

/// The unit in which a number comes nearest to what a supply gives, without going beyond.
std::string unit_below(double number, double most_Pa) {
  for (const auto& [name, size] : pressure_units)
    if (number * size <= most_Pa) return std::string(name);
  return "Pa";
}

class Plausible {
 public:
  explicit Plausible(const domain::Dataset& data) : data_(data) {}

  std::vector<Finding> operator()() {
    found_ = wrong_clocks(data_);
    kinds_.resize(found_.size(), "clock");
    for (run_ = 0; run_ < data_.runs.size(); ++run_) {
      map_ = with_our_names(domain::merged(data_.columns, run().columns), data_.rig.command_unit());
      if (run().measured)
        for (const domain::MeasuredColumn& column : run().measured->columns) look_at(column);
      else {
        command({&command_}, run().current_mA);
        never_moves("contraction", run().judged().values);
        grid("contraction", run().judged().values);
      }
    }
    absolute();
    same_rows();
    std::ranges::move(lost_rows(data_), std::back_inserter(found_));
    return std::move(found_);
  }

 private:
  const domain::Run& run() const { return data_.runs[run_]; }
  std::string line(const std::string& key, const ColumnPlace& meant) const {
    return fmt::format("write columns: {{{}}}", line_in_unit(key, meant));
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

  void look_at(const domain::MeasuredColumn& column) {
    const std::string key = column.channel.key_in_dataset();
    if (column.channel.is_pressure()) {
      if (column.given && column.channel.signal->key == "muscle_pressure") given_pressure(key, column.values);
      return;
    }
    if (column.given && column.channel.signal == &command_) command(column.channel, column.values);
    if (key == "contraction" && column.given) return held_length(key, column.values);
    const bool position = key == "contraction" || key == "angle";
    if (!position || column.given) return;
    never_moves(key, column.values);
    grid(key, column.values);
  }

  /// What the valve does not answer to. At 0, below its zero_command, benches rest, the thesis's sines too.
  void command(const plant::Channel& channel, const Series& values) {
    const plant::Valve& valve = channel.muscle == 2 ? data_.rig.pair()->opposite.valve : data_.rig.valve;
    const double slack = limits.beyond_span * (valve.span_command - valve.zero_command);
    const Series commands = known(values);
    if (const auto why = commands.empty() ? std::nullopt : rounded(commands, data_.rig))
      find(channel.key_in_dataset(), "rounded", fmt::format("{} {}", channel.key_in_dataset(), *why),
           Severity::doubtful);
    if (commands.empty()) return;
    const std::string key = channel.key_in_dataset();
    const auto ask = [&](const char* goes, double value, const char* so, const char* does) {
      find(key, goes,
           fmt::format("{0} goes {1} to {2:.4g} {5}, and the rig's valve answers to {3:.4g} to {4:.4g} {5}: "
                       "{6} that {7}; are zero_command and span_command the valve's, and unit, zero and "
                       "factor the column's?",
                       key, goes, value, valve.zero_command, valve.span_command,
                       name_of(data_.rig.command_unit()), so,
                       valve.is_on_off() ? does : "the simulated pressure does not change"),
           Severity::doubtful);
    };
    const auto [low, high] = std::ranges::minmax(commands);
    if (high > valve.span_command + slack)
      ask("up", high, "above", "it is open all the time, a duty of 100 %");
    if (low < -slack) ask("down", low, "below", "it vents all the time");
    if (const auto why = between_states(commands, valve))
      find(key, "between", fmt::format("{} {}", key, *why), Severity::doubtful);
  }

  void never_moves(const std::string& key, const Series& values) {
    const Series readings = known(values);
    if (readings.size() < limits.least_rows || range(readings) > 0.0 || !drive_moves()) return;
    find(key, "dead",
         fmt::format(
             "{} never moves, though what drives the rig does: is {} the right column, and was its sensor "
             "connected? Name another in columns: {{{}}}, or leave the run out",
             key, map_[key].column, line_of(key, map_[key])),
         Severity::doubtful);
  }

  bool drive_moves() const {
    if (!run().measured) return !run().current_mA.empty() && range(run().current_mA) > 0.0;
    return std::ranges::any_of(run().measured->columns, [](const domain::MeasuredColumn& column) {
      const Series values = known(column.values);
      return column.given && !values.empty() && range(values) > 0.0;
    });
  }

  /// A muscle that is held longer than at rest: its threads are taut, and a length that is off by 0.1 mm is
  /// off by much force.
  void held_length(const std::string& key, const Series& values) {
    const Series ratios = known(values);
    if (ratios.empty()) return;
    const plant::Braid braid(data_.rig.muscle);
    const double lowest = std::ranges::min(ratios), longer_m = -lowest * braid.rest_length_m();
    const Series pressures_Pa = known(run().measured->given("muscle_pressure"));
    const double most_Pa =
        pressures_Pa.empty() ? data_.rig.valve.supply_pressure_Pa : std::ranges::max(pressures_Pa);
    const double stop_N = braid.stop_stiffness_N_per_m() * longer_m;
    if (!(stop_N > limits.taut_share * braid.largest_force_N(most_Pa))) return;
    ColumnPlace meant = map_[key];
    const double per_unit = meant.factor * run().ratio_per_unit;
    meant.zero = domain::significant(meant.zero + lowest / per_unit, 6);
    find(key, "taut",
         fmt::format(
             "the muscle is held {:.3g} mm longer than at rest, where the taut threads of the rig "
             "add {:.3g} N to the braid's pull: is the zero of the length or rest_length off? About "
             "columns: {{{}}}; or a real muscle stretches there: write muscle: {{stop_stiffness: ...}}",
             1e3 * longer_m, stop_N, line_of(key, meant)),
         Severity::doubtful);
  }

  void given_pressure(const std::string& key, const Series& values_Pa) {
    const Series values = known(values_Pa);
    if (values.size() < limits.least_rows) return;
    const double low = std::ranges::min(values), high = std::ranges::max(values);
    const double supply_Pa = data_.rig.valve.supply_pressure_Pa;
    if (high > limits.beyond_supply * supply_Pa && high > limits.high_Pa) {
      find(key, "high",
           other_unit(key,
                      fmt::format("up to {:.4g} bar, and the rig's supply has {:.3g} bar",
                                  high / plant::Pa_per_bar, supply_Pa / plant::Pa_per_bar),
                      high),
           Severity::refused);
      return;
    }
    if (high < limits.lifts_nothing_Pa && moves_far()) {
      find(key, "low",
           other_unit(key,
                      fmt::format("never above {:.3g} bar, which moves no muscle, and yet it moves",
                                  high / plant::Pa_per_bar),
                      high),
           Severity::refused);
      return;
    }
    const auto rests =
        std::ranges::count_if(values, [&](double value) { return value < low + limits.rests * low; });
    lows_[key].push_back(
        {run_, lower_share(values, limits.lowest_share),
         static_cast<double>(rests) > limits.resting_share * static_cast<double>(values.size())});
  }

  /// What it would be in another unit, and the line that says so.
  std::string other_unit(const std::string& key, const std::string& seen, double high_Pa) {
    const std::optional<double> is = size_Pa(map_[key].unit);
    ColumnPlace meant = map_[key];
    const double most_Pa = limits.beyond_supply * data_.rig.valve.supply_pressure_Pa;
    if (is) meant.unit = unit_below(high_Pa / *is, most_Pa);
    if (!is || meant.unit == map_[key].unit)
      return fmt::format(
          "{} is {}: write the unit, zero and factor of its gauge in columns: {{{}}}, or set "
          "valve.supply_pressure of the rig",
          key, seen, line_of(key, meant));
    return fmt::format(
        "{} is {}; as {} it would be {:.3g} bar; if that is right, {}, otherwise set "
        "valve.supply_pressure of the rig",
        key, seen, meant.unit, high_Pa / *is * *size_Pa(meant.unit) / plant::Pa_per_bar, line(key, meant));
  }

  /// Gauges of open air: no run goes below its pressure, or one rests there.
  void absolute() {
    const auto near = [](const Low& one) {
      return one.low_Pa > limits.least_atmosphere_Pa && one.low_Pa < limits.most_atmosphere_Pa;
    };
    for (auto& [key, lows] : lows_) {
      if (!near(std::ranges::min(lows, {}, &Low::low_Pa)))
        std::erase_if(lows, [&](const Low& one) { return !one.rests || !near(one); });
      if (lows.empty()) continue;
      const Low& lowest = std::ranges::min(lows, {}, &Low::low_Pa);
      const std::string then = if_absolute(data_, lowest.run, key);
      if (then.empty()) continue;
      found_.push_back({.quantity = key,
                        .message = fmt::format("{} rests at {:.4g} bar: is it absolute? {}", key,
                                               lowest.low_Pa / plant::Pa_per_bar, then),
                        .severity = Severity::doubtful});
      for (const Low& one : lows) found_.back().runs.push_back(one.run);
      kinds_.push_back(key + "absolute");
    }
  }

  bool moves_far() const {
    const Series readings = known(run().measured->read("contraction"));
    return readings.size() > limits.least_rows && range(readings) > limits.moves_far;
  }

  void grid(const std::string& key, const Series& values) {
    const plant::Sensor& sensor = data_.rig.sensors.position();
    const double said = reading_per_count(data_.rig), step = coarse_step(data_, run(), values);
    if (step == 0.0) return;
    const bool turns = key == "angle" || sensor.kind == plant::SensorKind::potentiometer;
    const double size = turns ? step * (sensor.counts_pulses() ? 1.0 : sensor.resolution / said)
                              : 1e3 * step * data_.rig.muscle.rest_length_m;
    find(
        key, "grid",
        fmt::format(
            "{} is in steps {:.3g} times what the rig's sensor resolves; if they are its readings', write in "
            "the rig sensors: [{{signal: contraction, kind: {}, resolution: {:.3g} {}}}]",
            key, step / said,
            turns                    ? "potentiometer"
            : sensor.counts_pulses() ? "laser"
                                     : name_of(sensor.kind),
            size, turns ? "rad" : "mm"),
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
    if (!a.measured) return equal(a.current_mA, b.current_mA) && equal(a.judged().values, b.judged().values);
    return a.measured->time_s.size() > limits.least_rows && equal(a.measured->time_s, b.measured->time_s) &&
           std::ranges::equal(a.measured->columns, b.measured->columns, [](const auto& x, const auto& y) {
             return x.given == y.given && equal(x.values, y.values);
           });
  }

  const domain::Dataset& data_;
  const plant::Signal& command_ = plant::command_of(data_.rig.command_unit());
  std::size_t run_ = 0;
  domain::ColumnMap map_;
  std::vector<Finding> found_;
  std::vector<std::string> kinds_;  ///< of each finding
  struct Low {
    std::size_t run;
    double low_Pa;
    bool rests;
  };
  std::map<std::string, std::vector<Low>> lows_;  ///< of given pressures
};

}  // namespace

std::optional<double> size_Pa(std::string_view unit) {
  unit = unit.substr(0, unit.find_first_of(" ("));  // psi a, bar(abs)
  for (const auto& [name, size] : pressure_units)
    if (unit == name) return size;
  return std::nullopt;
}

std::optional<double> size_in_ours(const domain::Run& run, const plant::Channel& channel,
                                   std::string_view unit) {
  if (channel.is("contraction")) return run.ratio_per_unit;
  if (channel.is_pressure()) return size_Pa(unit);
  constexpr std::array<std::pair<std::string_view, double>, 6> sizes{{{"N", 1.0},
                                                                      {"kN", 1e3},
                                                                      {"kgf", plant::gravity_m_per_s2},
                                                                      {"lbf", 4.448222},
                                                                      {"rad", 1.0},
                                                                      {"deg", plant::degree_rad}}};
  for (const auto& [name, size] : sizes)
    if (unit == name) return size;
  return unit == channel.signal->unit.name ? std::optional(1.0) : std::nullopt;
}

double coarse_step(const domain::Dataset& data, const domain::Run& run, const Series& values) {
  if (run.measured && (run.measured->counted || run.measured->point_s > 0.0)) return 0.0;
  const Series readings = known(values);
  std::size_t stays = 0;  // a slow motion on a grid stays where it is; an even one has even moves as well
  for (std::size_t k = 1; k < readings.size(); ++k) stays += readings[k] == readings[k - 1] ? 1 : 0;
  if (static_cast<double>(stays) < limits.stays * static_cast<double>(readings.size())) return 0.0;
  const double step = step_of(readings);
  return step < limits.coarser * reading_per_count(data.rig) || step > limits.coarsest ? 0.0 : step;
}

std::string if_absolute(const domain::Dataset& data, std::size_t run, const std::string& key) {
  ColumnPlace meant =
      with_our_names(domain::merged(data.columns, data.runs[run].columns), data.rig.command_unit())[key];
  if (meant.zero != 0.0) return "";
  const double atmosphere_Pa = data.rig.gas.atmosphere_Pa;
  const std::optional<double> unit_Pa = size_Pa(meant.unit);
  meant.zero = unit_Pa ? atmosphere_Pa / *unit_Pa / meant.factor : 1.01325;
  return fmt::format(
      "Then zero is what its gauge reads in open air, {:.6g} bar in its unit ({}): columns: {{{}}}",
      atmosphere_Pa / plant::Pa_per_bar, meant.unit, line_of(key, meant));
}

std::vector<Finding> implausible(const domain::Dataset& data) {
  return Plausible(data)();
}

}  // namespace mckibben::data
