// Gauges against what the supply has: whatever else a muscle does, it is filled with no more.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/columns.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/units.hpp>

namespace mckibben::data {
namespace {

constexpr const ColumnThresholds& of_gauges = thresholds.column;

/// The unit in which a gauge comes near to the rig's pressure, and nearest; null if there is none.
const Unit* meant_unit(const std::vector<Unit>& units, const Unit* said, double most_Pa, double model_Pa) {
  const Unit* meant = nullptr;
  double nearest = std::log(of_gauges.near_one);
  for (const Unit& unit : units) {
    if (said == nullptr || &unit == said) continue;
    const double off = std::abs(std::log(most_Pa / said->size * unit.size / model_Pa));
    if (off < nearest) meant = &unit;
    nearest = std::min(nearest, off);
  }
  return meant;
}

}  // namespace

void check_supply(const domain::Dataset& data, const std::vector<Expected>& expected,
                  std::vector<Finding>& findings) {
  std::vector<Finding> beyond;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::ColumnMap map =
        with_our_names(domain::merged(data.columns, data.runs[i].columns), data.rig.command_unit());
    for (std::size_t reading = 0; reading < data.runs[i].readings.size(); ++reading) {
      const plant::Channel& channel = data.runs[i].readings[reading].channel;
      const std::string key = channel.key_in_dataset();
      Compared gauge;
      if (channel.is_pressure()) gauge.add(i, data.runs[i], expected[i], reading);
      const auto told = [&](const Finding& one) {
        return one.severity == Severity::refused && std::ranges::find(one.runs, i) != one.runs.end();
      };
      if (gauge.measured.empty() || std::ranges::any_of(findings, told)) continue;
      const plant::Valve& valve = channel.muscle == 2 && data.rig.pair() != nullptr
                                      ? data.rig.pair()->opposite.valve
                                      : data.rig.valve;
      const plant::Sensor* sheet = data.rig.sensors.of(plant::Sensed::muscle_pressure);
      const double accuracy_Pa = sheet != nullptr ? sheet->accuracy : 0.0,
                   most_Pa = upper_share(gauge.measured, thresholds.plausible.lowest_share);
      // An atmosphere more reads a gauge of absolute pressure.
      if (!(most_Pa > of_gauges.beyond_rig * valve.supply_pressure_Pa + data.rig.gas.atmosphere_Pa +
                          of_gauges.zero_accuracies * accuracy_Pa))
        continue;
      const std::vector<Unit> units = units_of_pressure();
      domain::ColumnPlace place = map[key];
      const Unit* const said = find_unit(units, place.unit);
      const Unit* const meant = meant_unit(units, said, most_Pa, std::ranges::max(gauge.model));
      std::string seen =
          fmt::format("{} is up to {:.4g} bar, and the rig's supply has {:.3g} bar", key,
                      most_Pa / plant::Pa_per_bar, valve.supply_pressure_Pa / plant::Pa_per_bar);
      if (meant != nullptr) {
        place.unit = meant->name;
        seen += fmt::format("; as {} it would be {:.3g} bar", meant->name,
                            most_Pa / said->size * meant->size / plant::Pa_per_bar);
      }
      const std::string so =
          meant != nullptr
              ? fmt::format("; if that is right, write columns: {{{}}}", line_in_unit(key, place))
              : fmt::format(": are unit, zero and factor of its gauge right in columns: {{{}}}",
                            domain::line_of(key, place));
      add(beyond, key, {i}, seen, so + "; or set valve.supply_pressure of the rig",
          meant != nullptr ? Severity::refused : Severity::doubtful);
    }
  }
  // What else their numbers would say of them, or of a valve, they say no more.
  for (const Finding& one : beyond)
    std::erase_if(findings, [&](const Finding& other) {
      return other.quantity == one.quantity && other.severity != Severity::refused &&
             std::ranges::includes(one.runs, other.runs);
    });
  findings.insert(findings.begin(), beyond.begin(), beyond.end());
}

}  // namespace mckibben::data
