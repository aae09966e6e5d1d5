// See the header. Units are suspected from the slope of what was measured over what the rig would do.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/run/column_sanity.hpp>
#include <sim/run/sanity_thresholds.hpp>
#include <sim/run/series.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

using domain::ColumnPlace, domain::line_of;
using Series = std::vector<double>;

constexpr const ColumnThresholds& of_columns = sanity_thresholds.column;

double largest(const Series& values) {
  return *std::max_element(values.begin(), values.end());
}
double lowest(const Series& values) {
  return *std::min_element(values.begin(), values.end());
}

ColumnPlace with_unit(ColumnPlace place, std::string unit) {
  place.unit = std::move(unit);
  return place;
}

/// What one of each unit is as a contraction ratio.
std::array<std::pair<const char*, double>, 9> ratios_per_unit(const plant::Rig& rig) {
  const double metre = 1.0 / rig.muscle.rest_length_m, radian = rig.joint.wheel_radius_m * metre;
  return {{{"1", 1.0},
           {"%", 0.01},
           {"mm", 1e-3 * metre},
           {"cm", 1e-2 * metre},
           {"m", metre},
           {"in", 0.0254 * metre},
           {"count", plant::count_height_m(rig) * metre},
           {"deg", std::numbers::pi / 180.0 * radian},
           {"rad", radian}}};
}

/// Rows in which nothing but the scale differs.
bool only_scaled(const Series& measured, const Series& model, double factor) {
  double scaled = 0.0, as_is = 0.0;
  for (std::size_t k = 0; k < model.size(); ++k) {
    scaled += std::pow(measured[k] / factor - model[k], 2);
    as_is += std::pow(measured[k] - model[k], 2);
  }
  return scaled < of_columns.scaled_share * as_is;
}

class Columns {
 public:
  Columns(const domain::Dataset& data, std::vector<domain::Objection>& objections)
      : data_(data),
        objections_(objections),
        longest_(plant::Braid(data.rig.muscle).largest_contraction_ratio()) {}

  void look(std::size_t i, const Expected& expected) {
    const domain::Run& run = data_.runs[i];
    map_ = with_names(domain::merged(data_.columns, run.columns));
    run_ = i;
    if (!data_.own_clock) {  // else ranges of the rig's valve have been looked at
      if (exchanged(run)) return;
      current(run);
    }
    if (expected.contraction_ratio.size() != run.contraction_ratio.size()) return;
    contraction(run.contraction_ratio, expected.contraction_ratio);
    if (run.muscle_pressure_Pa) pressure(*run.muscle_pressure_Pa, expected.pressure_Pa);
  }

 private:
  static domain::ColumnMap with_names(domain::ColumnMap map) {
    if (map.current.absent()) map.current = {"current_mA", "mA"};
    if (map.contraction.absent()) map.contraction = {"contraction_ratio", "1"};
    if (map.muscle_pressure.absent()) map.muscle_pressure = {"muscle_pressure_bar", "bar"};
    return map;
  }

  /// One objection for all runs of which the same is to be said; `seen` is of the first.
  void find(const char* quantity, const std::string& seen, const std::string& so) {
    const auto same_as = [&](const domain::Objection& objection) { return objection.message.ends_with(so); };
    const auto found = std::find_if(objections_.begin(), objections_.end(), same_as);
    if (found == objections_.end())
      objections_.push_back({quantity, {run_}, fmt::format("{}{}", seen, so)});
    else
      found->runs.push_back(run_);
  }
  static std::string mend(std::string_view what, std::string_view line) {
    return fmt::format("{}; write columns: {{{}}}", what, line);
  }

  bool exchanged(const domain::Run& run) {
    if (!run.muscle_pressure_Pa) return false;
    const double most_bar = largest(*run.muscle_pressure_Pa) / plant::Pa_per_bar;
    if (most_bar < of_columns.beyond_rig * data_.rig.valve.supply_pressure_Pa / plant::Pa_per_bar ||
        most_bar > data_.rig.dac.largest_current_mA + of_columns.rounding_mA ||
        largest(run.current_mA) >
            of_columns.within_supply * data_.rig.valve.supply_pressure_Pa / plant::Pa_per_bar)
      return false;
    std::swap(map_.current.column, map_.muscle_pressure.column);
    find("muscle_pressure",
         fmt::format("muscle_pressure is up to {:.4g} bar, more than the supply has, "
                     "and the current up to {:.3g} mA: ",
                     most_bar, largest(run.current_mA)),
         mend("these two columns look exchanged",
              fmt::format("{}, {}", line_of("current", map_.current),
                          line_of("muscle_pressure", map_.muscle_pressure))));
    return true;
  }

  void current(const domain::Run& run) {
    const double dead_mA = data_.rig.valve.zero_current_mA;
    const double amperes_mA = data_.rig.valve.span_current_mA * of_columns.amperes;
    const double most_mA = largest(run.current_mA);
    const std::string never = fmt::format("current: never above {:.3g} mA", most_mA);
    if (most_mA > 0.0 && most_mA < amperes_mA)
      find("current", never,
           mend("; this looks like amperes, not mA", line_of("current", with_unit(map_.current, "A"))));
    else if (most_mA < dead_mA &&
             range(run.contraction_ratio) > of_columns.moving_counts * contraction_per_count(data_.rig))
      find("current", never,
           fmt::format(", where the valve does nothing (below {:.3g} mA), yet the muscle moves; is this "
                       "another unit, or a share of the range? unit, "
                       "zero and factor in columns: current say so",
                       dead_mA));
  }

  void contraction(const Series& measured, const Series& model) {
    if (range(model) <= of_columns.moving_counts * contraction_per_count(data_.rig)) return;
    const Line line(measured, model);
    ColumnPlace meant = map_.contraction;
    if (line.slope < of_columns.fallen_slope && line.correlation < of_columns.fallen_correlation) {
      meant.factor = -meant.factor;
      find(
          "contraction",
          fmt::format("contraction goes from {:.3g} to {:.3g}: ", measured.front(), lowest(measured)),
          mend("it falls while the current rises; its sign is the other one", line_of("contraction", meant)));
      return;
    }
    if (line.slope <= 0.0 || line.correlation < of_columns.alike) return;
    const auto unit = contraction_unit(measured, model, line.slope);
    if (!unit) return;
    meant = with_unit(std::move(meant), *unit);
    const std::string seen = fmt::format("contraction is up to {:.4g}, {:.3g} times what the rig would do; ",
                                         largest(measured), line.slope);
    if (unit->empty())
      find("contraction", seen,
           "this looks like a ratio that was divided by the rest length in millimetres, as if it were mm");
    else
      find("contraction", seen,
           mend(fmt::format("this looks like {}, not {}", in_words(*unit), in_words(map_.contraction.unit)),
                line_of("contraction", meant)));
  }

  /// The unit that explains the slope; empty for a ratio that was taken for mm before.
  std::optional<std::string> contraction_unit(const Series& measured, const Series& model,
                                              double slope) const {
    const double as_read = data_.runs[run_].ratio_per_unit;
    std::optional<std::string> found;
    double nearest = std::log(of_columns.same);
    const auto consider = [&](const std::string& unit, double factor) {
      // What a muscle can do may be another load or another supply just as well.
      if (factor > 1.0 && largest(measured) < of_columns.beyond_rig * longest_) return;
      const double size = std::abs(std::log(factor)), off = std::abs(std::log(slope / factor));
      if (size < std::log(of_columns.near_one) || off > nearest) return;
      if (size < std::log(of_columns.far) && !only_scaled(measured, model, factor)) return;
      nearest = off;
      found = unit;
    };
    for (const auto& [unit, ratio] : ratios_per_unit(data_.rig)) consider(unit, as_read / ratio);
    if (map_.contraction.unit == "1") consider("", 1e-3 / data_.rig.muscle.rest_length_m);
    return found;
  }

  static std::string in_words(const std::string& unit) {
    if (unit == "1") return "a ratio";
    if (unit == "%") return "per cent";
    if (unit == "mm") return "millimetres (mm)";
    if (unit == "m") return "metres";
    return unit == "count" ? "counts" : unit;
  }

  void pressure(const Series& shown, const Series& model) {
    const Line line(shown, model);
    ColumnPlace meant = map_.muscle_pressure;
    if (range(model) > of_columns.gauge_bar * plant::Pa_per_bar) {
      for (const auto& [factor, unit] :
           {std::pair{100.0, "kPa"}, {14.504, "psi"}, {1e3, "mbar"}, {0.1, "MPa"}, {1e5, "Pa"}}) {
        if (line.slope <= 0.0 || std::abs(std::log(line.slope / factor)) > std::log(of_columns.same))
          continue;
        find("muscle_pressure",
             fmt::format("muscle_pressure is up to {:.4g} bar; ", largest(shown) / plant::Pa_per_bar),
             mend(fmt::format("this looks like {}, not bar", unit),
                  line_of("muscle_pressure", with_unit(map_.muscle_pressure, unit))));
      }
      if (line.slope < of_columns.least_gauge_slope || line.slope > of_columns.most_gauge_slope) return;
    }
    const auto an_atmosphere = [&](double difference_Pa) {
      return std::abs(difference_Pa / data_.rig.gas.atmosphere_Pa - 1.0) < of_columns.atmosphere;
    };
    if (!an_atmosphere(line.mean_difference) || !an_atmosphere(lowest(shown) - lowest(model))) return;
    if (meant.unit == "bar") meant.zero += data_.rig.gas.atmosphere_Pa / plant::Pa_per_bar / meant.factor;
    find("muscle_pressure", "muscle_pressure is about one atmosphere too high; ",
         mend("this looks like absolute, not gauge pressure: the zero takes the atmosphere off",
              line_of("muscle_pressure", meant)));
  }

  const domain::Dataset& data_;
  std::vector<domain::Objection>& objections_;
  double longest_;  ///< contraction ratio that a muscle reaches without a load
  domain::ColumnMap map_;
  std::size_t run_ = 0;
};

}  // namespace

void check_columns(const domain::Dataset& data, const std::vector<Expected>& expected,
                   std::vector<domain::Objection>& objections) {
  Columns columns(data, objections);
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if (!data.runs[i].contraction_ratio.empty()) columns.look(i, expected[i]);
}

}  // namespace mckibben::run
