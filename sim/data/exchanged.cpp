// See the header.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/exchanged.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnPlace, domain::line_of;

/// A pressure beyond the supply that would do as a current, and a current that would do as a pressure.
std::optional<Finding> current_and_pressure(const domain::Dataset& data, const domain::ColumnMap& map) {
  constexpr const ColumnThresholds& limits = thresholds.column;
  if (data.own_clock || data.judged() != domain::Judged::contraction ||
      data.rig.command_unit() != plant::CommandUnit::mA)
    return std::nullopt;
  Finding found{.quantity = "muscle_pressure", .message = {}};
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::Run& run = data.runs[i];
    const domain::Reading* gauge = run.find("muscle_pressure");
    if (gauge == nullptr || gauge->values.empty() || run.current_mA.empty()) continue;
    const double most_bar = std::ranges::max(gauge->values) / plant::Pa_per_bar,
                 most_mA = std::ranges::max(run.current_mA);
    const double supply_bar = data.rig.valve.supply_pressure_Pa / plant::Pa_per_bar;
    if (most_bar < limits.beyond_rig * supply_bar ||
        most_bar > data.rig.dac.largest_command + limits.rounding_mA ||
        most_mA > limits.within_supply * supply_bar)
      continue;
    found.runs.push_back(i);
    if (!found.message.empty()) continue;
    ColumnPlace current = map["current"], pressure = map["muscle_pressure"];
    std::swap(current.column, pressure.column);
    found.message = fmt::format(
        "muscle_pressure is up to {:.4g} bar, more than the supply has, and the current up to "
        "{:.3g} mA: these two columns look exchanged; write columns: {{{}, {}}}",
        most_bar, most_mA, line_of("current", current), line_of("muscle_pressure", pressure));
  }
  if (found.runs.empty()) return std::nullopt;
  return found;
}

std::optional<Finding> of_the_other_muscle(const domain::Dataset& data, const std::vector<Expected>& expected,
                                           const domain::ColumnMap& map, const plant::Signal& signal) {
  const std::string keys[] = {plant::Channel{&signal, 1}.key_in_dataset(),
                              plant::Channel{&signal, 2}.key_in_dataset()};
  Finding found{.quantity = keys[0], .message = {}, .severity = Severity::doubtful};
  double as_said = 0.0, exchanged = 0.0;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    Compared one, two;
    for (std::size_t reading = 0; reading < data.runs[i].readings.size(); ++reading)
      if (const plant::Channel& channel = data.runs[i].readings[reading].channel; channel.signal == &signal)
        (channel.muscle == 1 ? one : two).add(i, data.runs[i], expected[i], reading);
    if (one.measured.size() != two.measured.size()) continue;
    found.runs.push_back(i);
    for (std::size_t k = 0; k < one.measured.size(); ++k) {
      as_said += std::pow(one.measured[k] - one.model[k], 2) + std::pow(two.measured[k] - two.model[k], 2);
      exchanged += std::pow(one.measured[k] - two.model[k], 2) + std::pow(two.measured[k] - one.model[k], 2);
    }
  }
  if (!(exchanged < thresholds.column.exchanged_share * as_said)) return std::nullopt;
  ColumnPlace first = map[keys[0]], second = map[keys[1]];
  std::swap(first.column, second.column);
  found.message = fmt::format(
      "with {} and {} exchanged {:.0f} % of the rig's error is left: are they? About columns: {{{}, {}}}",
      keys[0], keys[1], 100.0 * std::sqrt(exchanged / as_said), line_of(keys[0], first),
      line_of(keys[1], second));
  return found;
}

}  // namespace

std::vector<Finding> exchanged(const domain::Dataset& data, const std::vector<Expected>& expected) {
  const domain::ColumnMap map =
      with_our_names(domain::merged(data.columns, data.runs.front().columns), data.rig.command_unit());
  std::vector<Finding> findings = exchanged_with_a_load_cell(data, expected);
  if (auto found = current_and_pressure(data, map)) findings.push_back(std::move(*found));
  for (const domain::Reading& read : data.runs.front().readings)
    if (read.channel.muscle == 1)
      if (auto found = of_the_other_muscle(data, expected, map, *read.channel.signal))
        findings.push_back(std::move(*found));
  return findings;
}

}  // namespace mckibben::data
