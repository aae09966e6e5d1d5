// See the header. A unit is suspected from the slope of what was measured over what the rig would do.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <plant/instruments.hpp>
#include <sim/data/amount.hpp>
#include <sim/data/columns.hpp>
#include <sim/data/exchanged.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/units.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnPlace, domain::line_of;
using Series = std::vector<double>;

constexpr const ColumnThresholds& of_columns = thresholds.column;

double largest(const Series& values) {
  return *std::max_element(values.begin(), values.end());
}
double lowest(const Series& values) {
  return *std::min_element(values.begin(), values.end());
}

/// A quantity of the map, and how it is judged.
struct Quantity {
  std::string key;
  ColumnPlace place;
  std::vector<Unit> units;
  std::string_view shown = "";             ///< ` bar`: the unit of messages,
  double of_shown = 1.0;                   ///< what one of it is in ours,
  double said = of_shown;                  ///< and one of the unit that the map says, if it is none of these
  double moves = 0.0;                      ///< the model must move by more
  double alike = of_columns.hardly_alike;  ///< correlation, if only unit and sign are wrong
  double opposite = of_columns.opposite;   ///< slope below minus this: the other sign
  double most = 0.0;     ///< that a rig can do: of a unit that is too small there must be more
  bool by_mean = false;  ///< the mean says more of what hardly moves than a slope does

  const Unit* unit_said() const { return find_unit(units, place.unit); }
};

std::string in_words(const std::string& unit) {
  if (unit == "1") return "a ratio";
  if (unit == "%") return "per cent";
  if (unit == "mm") return "millimetres (mm)";
  if (unit == "m") return "metres";
  if (unit == "deg") return "degrees";
  if (unit == "rad") return "radians";
  return unit == "count" ? "counts" : unit;
}

/// Rows in which nothing but the scale differs.
bool only_scaled(const Compared& rows, double factor) {
  double scaled = 0.0, as_is = 0.0;
  for (std::size_t k = 0; k < rows.model.size(); ++k) {
    scaled += std::pow(rows.measured[k] / factor - rows.model[k], 2);
    as_is += std::pow(rows.measured[k] - rows.model[k], 2);
  }
  return scaled < of_columns.scaled_share * as_is;
}

/// The unit that explains a scale.
std::optional<Unit> other_unit(const Quantity& quantity, const Compared& rows, double scale) {
  const Unit* const said = quantity.unit_said();
  const double most = std::max(largest(rows.measured), -lowest(rows.measured));
  std::optional<Unit> found;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Unit& unit : quantity.units) {
    const double factor = (said != nullptr ? said->size : quantity.said) / unit.size;
    const double size = std::abs(std::log(factor)), off = std::abs(std::log(scale / factor));
    // What a rig can do may be another load or another supply just as well.
    if (factor > 1.0 && most < of_columns.beyond_rig * quantity.most) continue;
    if (size < std::log(of_columns.near_one) || off > std::min(nearest, std::log(unit.same))) continue;
    if (size < std::log(of_columns.far) && !only_scaled(rows, factor)) continue;
    nearest = off;
    found = unit;
  }
  return found;
}

class Columns {
 public:
  Columns(const domain::Dataset& data, const std::vector<Expected>& expected, std::vector<Finding>& findings)
      : data_(data), expected_(expected), findings_(findings) {}

  void operator()() {
    if (auto found = reversed_flow(data_)) return findings_.push_back(std::move(*found));
    findings_ = pressures_of_a_held_muscle(data_);
    if (!findings_.empty()) return;
    findings_ = exchanged(data_, expected_);
    if (!findings_.empty()) {  // what else their columns seem to be is not so
      map_ =
          with_our_names(domain::merged(data_.columns, data_.runs.front().columns), data_.rig.command_unit());
      Compared all;
      for (std::size_t i = 0; i < data_.runs.size(); ++i) all.add(i, data_.runs[i], expected_[i]);
      if (data_.judged() == domain::Judged::angle) angle(all);
      return;
    }
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      const domain::Run& run = data_.runs[i];
      map_ = with_our_names(domain::merged(data_.columns, run.columns), data_.rig.command_unit());
      const bool hangs = data_.judged() == domain::Judged::contraction && run.find("contraction") != nullptr;
      const bool of_mA = data_.rig.command_unit() == plant::CommandUnit::mA;
      // Else ranges of the rig's valve have been looked at.
      if (hangs && !data_.own_clock && of_mA) current(i);
      if (hangs) judge(contraction(run), compared(i));
      for (std::size_t reading = 1; reading < run.readings.size(); ++reading)
        if (run.readings[reading].channel.is_pressure()) gauge(i, reading);
    }
    if (auto found = other_span_of_the_valve()) {
      findings_.clear();  // under other pressures than the rig's nothing else is what it seems
      return findings_.push_back(std::move(*found));
    }
    for (const auto& [line, gauge] : gauges_)
      if (auto found = other_gain(gauge.second, gauge.first.key, gauge.first.place))
        findings_.push_back(std::move(*found));
    map_ =
        with_our_names(domain::merged(data_.columns, data_.runs.front().columns), data_.rig.command_unit());
    Compared all;
    std::map<std::string, std::vector<Compared>> forces;  // of cords, by their keys
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      const auto& readings = data_.runs[i].readings;
      all.add(i, data_.runs[i], expected_[i]);
      for (std::size_t reading = 1; reading < readings.size(); ++reading)
        if (const plant::Channel& channel = readings[reading].channel; channel.signal->key == "force")
          forces[channel.key_in_dataset()].push_back(compared(i, reading));
    }
    if (data_.judged() == domain::Judged::contraction && findings_.empty()) only_gain_or_zero(all);
    if (data_.judged() == domain::Judged::angle) angle(all);
    if (data_.judged() == domain::Judged::force) judge(force("force", false), all);
    if (const domain::Reading& read = data_.runs.front().judged(); read.channel.is_pressure())
      judge(pressure(read.channel), all);
    for (const auto& [key, runs] : forces) load_cell(key, runs);
    if (data_.recorded.start != domain::Start::settled) return;
    const plant::Sensor* sheet = data_.rig.sensors.of(plant::Sensed::muscle_pressure);
    for (const auto& [line, gauge] : gauges_)
      if (auto found = other_zero_of_gauge(gauge.second, gauge.first.key, gauge.first.place,
                                           sheet != nullptr ? sheet->accuracy : 0.0))
        findings_.push_back(std::move(*found));
  }

 private:
  /// Of one muscle whose valve is commanded and whose gauge was read in all runs, whatever their columns.
  std::optional<Finding> other_span_of_the_valve() const {
    if (data_.rig.pair() != nullptr || data_.pressure_is_given() || data_.valve_pressure_is_given())
      return std::nullopt;
    std::vector<Compared> runs;
    for (const auto& [line, gauge] : gauges_)
      if (gauge.first.key == "muscle_pressure")
        runs.insert(runs.end(), gauge.second.begin(), gauge.second.end());
    if (runs.size() != data_.runs.size()) return std::nullopt;
    const domain::ColumnMap map =
        with_our_names(domain::merged(data_.columns, data_.runs.front().columns), data_.rig.command_unit());
    return other_span(runs, "muscle_pressure", map["muscle_pressure"], data_.rig.valve);
  }

  Compared compared(std::size_t i, std::size_t reading = 0) const {
    Compared rows;
    rows.add(i, data_.runs[i], expected_[i], reading);
    return rows;
  }

  Quantity contraction(const domain::Run& run) const {
    const plant::Rig& rig = data_.rig;
    Quantity judged{.key = "contraction",
                    .place = map_["contraction"],
                    .units = units_of_contraction(rig),
                    .said = run.ratio_per_unit,
                    .moves = moving(),
                    .alike = of_columns.alike,
                    .opposite = of_columns.opposite_contraction,
                    .most = plant::Braid(rig.muscle).largest_contraction_ratio()};
    if (judged.place.unit == "1") judged.units.push_back({divided_twice, 1e3 * rig.muscle.rest_length_m});
    return judged;
  }
  /// Where nothing but a scale or a zero differs.
  void only_gain_or_zero(const Compared& rows) {
    if (rows.measured.size() < 2 || range(rows.model) <= moving()) return;
    if (auto found = halved_or_doubled(rows, "contraction", map_["contraction"]))
      findings_.push_back(std::move(*found));
    else if (auto other = other_zero(rows, map_["contraction"], data_.runs.front().ratio_per_unit))
      findings_.push_back(std::move(*other));
    else if (auto at_rest = other_zero_at_rest(data_, expected_, map_["contraction"]))
      findings_.push_back(std::move(*at_rest));
  }
  double moving() const {
    return of_columns.moving_counts * plant::count_height_m(data_.rig) / data_.rig.muscle.rest_length_m;
  }

  void angle(const Compared& rows) {
    const Quantity quantity{
        .key = "angle",
        .place = map_["angle"],
        .units = {{"rad", 1.0, of_columns.same_turn}, {"deg", plant::degree_rad, of_columns.same_turn}},
        .shown = " rad"};
    if (judge(quantity, rows) && rows.measured.size() > 1)
      if (auto found = halved_or_doubled(rows, "angle", quantity.place))
        findings_.push_back(std::move(*found));
  }

  // What hangs on a cord says how large its force is, whatever moves it.
  Quantity force(const std::string& key, bool by_mean) const {
    return {.key = key,
            .place = map_[key],
            .units = units_of_force(),
            .shown = " N",
            .opposite = by_mean ? of_columns.opposite_mean : of_columns.opposite,
            .by_mean = by_mean};
  }
  void load_cell(const std::string& key, const std::vector<Compared>& runs) {
    const Quantity quantity = force(key, true);
    const plant::Sensor* sheet = data_.rig.sensors.of(plant::Sensed::force);
    const double accuracy_N = sheet != nullptr ? sheet->accuracy : 0.0;
    if (data_.rig.lifts_a_load())
      if (auto found = load_cell_read_otherwise(data_, expected_, runs, key, accuracy_N); !found.empty()) {
        findings_.insert(findings_.end(), found.begin(), found.end());
        return;
      }
    Compared all;
    for (const Compared& one : runs) all.add(one);
    if (!judge(quantity, all) || !data_.rig.lifts_a_load()) return;
    if (const Unit* unit = quantity.unit_said())
      if (auto found = load_cell_off(data_, expected_, runs, key, quantity.place, unit->size, accuracy_N))
        findings_.push_back(std::move(*found));
  }

  Quantity pressure(const plant::Channel& gauge) const {
    const std::string key = gauge.key_in_dataset();
    return {.key = key,
            .place = map_[key],
            .units = units_of_pressure(),
            .shown = " bar",
            .of_shown = plant::Pa_per_bar,
            .moves = of_columns.gauge_bar * plant::Pa_per_bar,
            .opposite = std::numeric_limits<double>::infinity()};  // what does not follow is dead
  }

  static std::string mend(std::string_view what, std::string_view line) {
    return fmt::format("{}; write columns: {{{}}}", what, line);
  }

  /// Scale and sign against the model. False if something is wrong with them.
  bool judge(const Quantity& quantity, const Compared& rows) {
    if (rows.measured.size() < 2) return true;
    const Line line(rows.measured, rows.model);
    double scale = line.slope, alike = line.correlation;
    if (quantity.by_mean) {
      scale = mean(rows.model) > 0.0 ? mean(rows.measured) / mean(rows.model) : 0.0;
      alike = scale > 0.0 ? 1.0 : -1.0;
    } else if (range(rows.model) <= quantity.moves) {
      return true;
    }
    if (scale == 0.0) return true;
    const auto unit =
        std::abs(alike) < quantity.alike ? std::nullopt : other_unit(quantity, rows, std::abs(scale));
    const bool opposite = scale < 0.0 && alike < -of_columns.opposite_alike &&
                          ((unit && !quantity.by_mean) || scale < -quantity.opposite);
    if (!opposite && (!unit || scale < 0.0)) return true;
    ColumnPlace meant = quantity.place;
    std::string what;
    if (opposite) {
      meant.factor = -meant.factor;
      what = "it goes the other way than the rig would; its sign is the other one";
    }
    if (unit && unit->name == divided_twice) {
      what += "this looks like a ratio that was divided by the rest length in millimetres, as if it were mm";
    } else if (unit) {
      meant.unit = unit->name;
      what += fmt::format("{}this looks like {}, not {}", opposite ? ", and " : "", in_words(unit->name),
                          in_words(quantity.place.unit));
    }
    if (!unit || unit->name != divided_twice)
      what = mend(what, unit ? line_in_unit(quantity.key, meant) : line_of(quantity.key, meant));
    if (unit && quantity.key == "contraction" && divided_by_length(quantity.place) &&
        divided_by_length(meant))
      what +=
          fmt::format(", or correct the rig's rest_length, {:.4g} mm", 1e3 * data_.rig.muscle.rest_length_m);
    if (opposite && data_.rig.pair() != nullptr && quantity.key == "angle")
      what += ", or exchange muscle 1 and muscle 2";
    const double seen = quantity.by_mean ? mean(rows.measured)
                        : opposite       ? range(rows.measured)
                                         : largest(rows.measured);
    add(findings_, quantity.key, rows.runs,
        fmt::format("{} {} {:.4g}{}, {:.3g} times what the rig would do; ", quantity.key,
                    quantity.by_mean ? "is on average"
                    : opposite       ? "moves by"
                                     : "is up to",
                    seen / quantity.of_shown, quantity.shown, scale),
        what);
    return false;
  }

  void current(std::size_t i) {
    const domain::Run& run = data_.runs[i];
    const plant::Valve& valve = data_.rig.valve;
    const double most_mA = largest(run.current_mA);
    const std::string never = fmt::format("current: never above {:.3g} mA", most_mA);
    ColumnPlace amperes = map_["current"];
    amperes.unit = std::string("A");  // g++ 12 warns of a literal
    if (most_mA > 0.0 && most_mA < valve.span_command * of_columns.amperes)
      add(findings_, "current", {i}, never,
          mend("; this looks like amperes, not mA", line_in_unit("current", amperes)));
    else if (most_mA < valve.zero_command && range(run.judged().values) > moving())
      add(findings_, "current", {i}, never,
          fmt::format(", where the valve does nothing (below {:.3g} mA), yet the muscle moves; is this "
                      "another unit, or a share of the range? unit, zero and factor in columns: current say "
                      "so",
                      valve.zero_command));
  }

  void gauge(std::size_t i, std::size_t reading) {
    Compared rows = compared(i, reading);
    if (rows.measured.empty()) return;
    const Quantity quantity = pressure(data_.runs[i].readings[reading].channel);
    if (!judge(quantity, rows)) return;
    const Line line(rows.measured, rows.model);
    const double atmosphere_Pa = data_.rig.gas.atmosphere_Pa, rest_Pa = off_at_rest(rows);
    const auto an_atmosphere = [&](double difference_Pa) {
      return std::abs(std::abs(difference_Pa) / atmosphere_Pa - 1.0) < of_columns.atmosphere;
    };
    const bool everywhere = an_atmosphere(line.mean_difference) &&
                            an_atmosphere(lowest(rows.measured) - lowest(rows.model)) &&
                            is_gauge_slope(line.slope);
    if (everywhere || an_atmosphere(rest_Pa)) {
      absolute(quantity, i, everywhere ? line.mean_difference : rest_Pa, everywhere);
      return;
    }
    if (range(rows.model) <= quantity.moves) return;
    if (!is_gauge_slope(line.slope))
      if (auto found = other_unit_of_gauge(rows, quantity.key, quantity.place, quantity.units))
        return findings_.push_back(std::move(*found));
    auto& [one, runs] = gauges_[line_of(quantity.key, quantity.place)];
    one = quantity;
    runs.push_back(std::move(rows));
  }

  /// What a gauge reads more, in the middle, where the model's pressure is as low as it comes; 0 where it
  /// hardly rests there.
  static double off_at_rest(const Compared& rows) {
    const double rest_Pa = lowest(rows.model) + thresholds.reading.gauge_step_Pa;
    Series off_Pa;
    for (std::size_t k = 0; k < rows.model.size(); ++k)
      if (rows.model[k] < rest_Pa) off_Pa.push_back(rows.measured[k] - rows.model[k]);
    return off_Pa.size() < thresholds.plausible.least_rows ? 0.0 : upper_median(std::move(off_Pa));
  }

  void absolute(const Quantity& quantity, std::size_t run, double off_Pa, bool everywhere) {
    ColumnPlace meant = quantity.place;
    const double sign = off_Pa > 0.0 ? 1.0 : -1.0;
    if (const std::optional<double> said = size_Pa(meant.unit))
      meant.zero += sign * data_.rig.gas.atmosphere_Pa / *said / meant.factor;
    add(findings_, quantity.key, {run},
        fmt::format("{} is about one atmosphere too {}{}; ", quantity.key, sign > 0.0 ? "high" : "low",
                    everywhere ? ""
                               : fmt::format(" where the rig is at rest, {:.3g} bar, in the middle",
                                             off_Pa / plant::Pa_per_bar)),
        mend(sign > 0.0 ? "this looks like absolute, not gauge pressure: the zero takes the atmosphere off"
                        : "an atmosphere seems to be taken off what is gauge pressure already",
             line_of(quantity.key, meant)),
        everywhere ? Severity::refused : Severity::doubtful);
  }

  static constexpr const char* divided_twice = "";

  const domain::Dataset& data_;
  const std::vector<Expected>& expected_;
  std::vector<Finding>& findings_;
  domain::ColumnMap map_;  ///< with our names where it says none
  std::map<std::string, std::pair<Quantity, std::vector<Compared>>> gauges_;  ///< by their lines of columns
};

}  // namespace

void check_columns(const domain::Dataset& data, const std::vector<Expected>& expected,
                   std::vector<Finding>& findings) {
  Columns(data, expected, findings)();
}

}  // namespace mckibben::data
