// See the header.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/weighed.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnPlace, domain::line_of;

constexpr const ColumnThresholds& of_gains = thresholds.column;

/// Of the squares of `by`, what is left of the readings beside the model with this scale and zero.
double share_left(const Compared& rows, double scale, double zero, const auto& by) {
  double left = 0.0, all = 0.0;
  for (std::size_t k = 0; k < rows.model.size(); ++k) {
    left += std::pow((rows.measured[k] - zero) / scale - rows.model[k], 2);
    all += std::pow(by(k), 2);
  }
  return left / all;
}

constexpr int digits = 4;  // of numbers in a line to write

}  // namespace

std::optional<Finding> halved_or_doubled(const Compared& reading, const std::string& key, ColumnPlace place) {
  const Line line(reading.measured, reading.model);
  const bool turns = key == "angle";  // of other muscles, too, by a little more or less: then only scaled
  const double near = turns ? of_gains.same : of_gains.halved;
  for (const double factor : {0.5, 2.0}) {
    if (std::abs(std::log(line.slope / factor)) > std::log(near) || line.correlation < of_gains.alike)
      continue;
    const auto model = [&](std::size_t k) { return reading.model[k]; };
    if (!(share_left(reading, turns ? line.slope : factor, 0.0, model) <=
          (turns ? of_gains.scaled_share : of_gains.halved_share)))
      continue;
    const char* const rig = key == "contraction" && divided_by_length(place)
                                ? "pulses_per_turn of its encoder or rest_length of the rig"
                                : "pulses_per_turn of the rig's encoder";
    place.factor /= factor;
    return Finding{.quantity = key,
                   .runs = reading.runs,
                   .message = fmt::format(
                       "{} is {:.2f} times what pressure and load say, everywhere: are counts "
                       "per turn {}, as by a decoder that sees other edges? Then columns: {{{}}}, or {}",
                       key, line.slope, factor < 1.0 ? "halved" : "doubled", line_of(key, place), rig),
                   .severity = Severity::doubtful};
  }
  return std::nullopt;
}

std::optional<Finding> other_zero(const Compared& contraction, ColumnPlace place, double ratio_per_unit) {
  double sum = 0.0;
  for (std::size_t k = 0; k < contraction.model.size(); ++k)
    sum += contraction.measured[k] - contraction.model[k];
  const double off = sum / static_cast<double>(contraction.model.size());
  const auto as_it_is = [&](std::size_t k) { return contraction.measured[k] - contraction.model[k]; };
  if (std::abs(off) < of_gains.other_zero * range(contraction.model) ||
      !(share_left(contraction, 1.0, off, as_it_is) < of_gains.scaled_share))
    return std::nullopt;
  place.zero = domain::significant(place.zero + off / ratio_per_unit / place.factor, digits);
  return Finding{
      .quantity = "contraction",
      .runs = contraction.runs,
      .message = fmt::format("contraction is {:.3g} {} than pressure and load say, everywhere: is its "
                             "zero what it reads at rest length? About columns: {{{}}}",
                             std::abs(off), off > 0.0 ? "more" : "less", line_of("contraction", place)),
      .severity = Severity::doubtful};
}

namespace {

/// A load that is written ten times too large seems to be too heavy, and its run to begin above the stop:
/// that is asked of the load.
void leave_out_misplaced(const domain::Dataset& data, const std::vector<Expected>& expected,
                         std::vector<std::size_t>& runs, std::vector<double>& offs) {
  if (runs.empty()) return;
  const std::vector<Weighed> list = weigh(data, expected, true);
  for (const auto& [one, factor] : misplaced_points_in(list))
    if (const auto at = std::ranges::find(runs, one.run);
        factor < 1.0 && at != runs.end() && !all_are_off(list, one)) {
      offs.erase(offs.begin() + (at - runs.begin()));
      runs.erase(at);
    }
}

}  // namespace

std::optional<Finding> other_zero_at_rest(const domain::Dataset& data, const std::vector<Expected>& expected,
                                          ColumnPlace place) {
  if (data.recorded.start != domain::Start::settled || data.rig.has_angle()) return std::nullopt;
  const plant::Braid braid(data.rig.muscle);
  std::vector<std::size_t> runs;
  std::vector<double> offs;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::Run& run = data.runs[i];
    const domain::Reading* read = run.find("contraction");
    if (read == nullptr || expected[i].judged().empty() || read->is_missing(0)) continue;
    const double pull_N = braid.force_N(thresholds.load.lifted, expected[i].pressure_Pa.front());
    if (!(pull_N < of_gains.hardly_pulls * run.load_kg * plant::gravity_m_per_s2)) continue;
    const double off = read->values.front() - expected[i].judged().front();
    if (std::abs(off) < of_gains.off_at_rest) continue;
    runs.push_back(i);
    offs.push_back(off);
  }
  leave_out_misplaced(data, expected, runs, offs);
  if (runs.empty()) return std::nullopt;
  const double off = upper_median(offs);
  place.zero =
      domain::significant(place.zero + off / data.runs[runs.front()].ratio_per_unit / place.factor, digits);
  return Finding{
      .quantity = "contraction",
      .runs = std::move(runs),
      .message = fmt::format("contraction begins {:.3g} {} than where the load rests, too heavy to be "
                             "lifted: is its zero what it "
                             "reads at rest length, and is the rest_length right? About columns: {{{}}}",
                             std::abs(off), off > 0.0 ? "more" : "less", line_of("contraction", place)),
      .severity = Severity::doubtful};
}

std::optional<Finding> beyond_the_rig(const domain::Dataset& data, const std::vector<Expected>& expected) {
  const auto most_of = [](const std::vector<double>& ratios) {
    return ratios.empty() ? 0.0 : *std::ranges::max_element(ratios);
  };
  double rig = plant::Braid(data.rig.muscle).largest_contraction_ratio(), most = 0.0;
  for (const Expected& one : expected) rig = std::max(rig, most_of(one.judged()));
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const double reached = most_of(data.runs[i].values("contraction"));
    if (reached < of_gains.beyond_reach * rig) continue;
    runs.push_back(i);
    most = std::max(most, reached);
  }
  if (runs.empty()) return std::nullopt;
  return Finding{
      .quantity = "contraction",
      .runs = std::move(runs),
      .message = fmt::format("contraction reaches {:.3g}, and this rig {:.3g} at most: are rest_length, "
                             "braid_angle and end_correction, and unit and zero of the reading right?",
                             most, rig),
      .severity = Severity::doubtful};
}

std::optional<Finding> reversed_flow(const domain::Dataset& data) {
  const plant::Valve& valve = data.rig.valve;
  if (!valve.is_on_off() || valve.ports != plant::Ports::two || data.rig.pair() != nullptr ||
      data.rig.has_angle() || data.judged() == domain::Judged::force)
    return std::nullopt;
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(of_gains.flow_s / data.row_s())));
  double along = 0.0, all = 0.0, pressed = 0.0, all_pressed = 0.0;
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::Run& run = data.runs[i];
    const std::vector<double>&read = run.judged().values, &command = run.current_mA;
    const domain::Reading* gauge = run.find("muscle_pressure");
    if (command.size() != read.size() || read.size() <= rows) continue;
    runs.push_back(i);
    const double least = of_gains.flow_share * range(read);
    for (std::size_t k = 0; k + rows < read.size(); k += rows) {
      const double rise = read[k + rows] - read[k];
      if (run.judged().is_missing(k) || run.judged().is_missing(k + rows) || !(std::abs(rise) > least))
        continue;
      double fills = 0.0;
      for (std::size_t row = k; row < k + rows; ++row) fills += 2.0 * valve.way(command[row]) - 1.0;
      along += fills * rise;
      all += std::abs(fills * rise);
      const double by_gauge = gauge != nullptr ? fills * (gauge->values[k + rows] - gauge->values[k]) : 0.0;
      if (!std::isfinite(by_gauge)) continue;
      pressed += by_gauge;
      all_pressed += std::abs(by_gauge);
    }
  }
  if (!(along < -of_gains.opposite_flow * all)) return std::nullopt;
  const bool flow_is_right = pressed > of_gains.opposite_flow * all_pressed;
  const domain::ColumnMap said = domain::merged(data.columns, data.runs.front().columns);
  const bool of_ticks = !data.own_clock && valve.command_unit == plant::CommandUnit::mA;
  const std::string key = flow_is_right                           ? "contraction"
                          : of_ticks || !said["current"].absent() ? "current"
                                                                  : "command";
  ColumnPlace place = with_our_names(said, valve.command_unit)[key];
  std::string line;
  if (flow_is_right) {
    place.factor = -place.factor;
    if (!said[key].absent()) line = fmt::format("; write columns: {{{}}}", line_of(key, place));
  } else if (place.unit == name_of(valve.command_unit)) {
    place.zero += (valve.zero_command + valve.span_command) / place.factor;
    place.factor = -place.factor;
    line = fmt::format("; write columns: {{{}}}", line_of(key, place));
  }
  return Finding{
      .quantity = key,
      .runs = std::move(runs),
      .message = fmt::format("{}: {}: its sign is the other one{}", key,
                             flow_is_right ? "where valves fill, pressure rises and the muscle gives way"
                                           : "where it fills by the rig, the muscle gives way, and where it "
                                             "vents, it pulls",
                             line)};
}

std::optional<FittingUnit> unit_that_fits(const Compared& reading, const ColumnPlace& said,
                                          const std::vector<Unit>& units) {
  const Unit* const own = find_unit(units, said.unit);
  const double most =
      names_unit(said.column, said.unit) ? of_gains.beside_stated_unit : of_gains.fitting_unit;
  if (own == nullptr || reading.measured.empty() || range(reading.measured) == 0.0) return std::nullopt;
  std::optional<FittingUnit> best;
  for (const Unit& unit : units) {
    const double factor = unit.size / own->size;
    const double moves = factor * range(reading.measured) / range(reading.model);
    if (!(std::abs(std::log(moves)) < std::log(of_gains.near_one))) continue;
    double squares = 0.0;
    for (std::size_t k = 0; k < reading.model.size(); ++k)
      squares += std::pow(factor * reading.measured[k] - reading.model[k], 2);
    const double left =
        std::sqrt(squares / static_cast<double>(reading.model.size())) / (factor * range(reading.measured));
    if (left < (best ? best->left : most)) best = {unit.name, left};
  }
  return best && best->name != said.unit ? best : std::nullopt;
}

std::optional<Finding> other_unit_of_gauge(const Compared& gauge, const std::string& key, ColumnPlace place,
                                           const std::vector<Unit>& units) {
  const Line line(gauge.measured, gauge.model);
  if (line.correlation < of_gains.alike || line.slope <= 0.0) return std::nullopt;
  const auto unit = unit_that_fits(gauge, place, units);
  if (!unit) return std::nullopt;
  place.unit = unit->name;
  return Finding{
      .quantity = key,
      .runs = gauge.runs,
      .message = fmt::format("{} is {:.3g} times what the rig would do: is it in {}? Then columns: {{{}}}",
                             key, line.slope, unit->name, line_in_unit(key, place)),
      .severity = Severity::doubtful};
}

bool is_gauge_slope(double slope) {
  return slope >= of_gains.least_gauge_slope && slope <= of_gains.most_gauge_slope;
}

std::optional<Finding> other_gain(const std::vector<Compared>& runs, const std::string& key,
                                  ColumnPlace place) {
  Compared gauge;
  std::vector<double> slopes;
  for (const Compared& run : runs) {
    slopes.push_back(Line(run.measured, run.model).slope);
    gauge.runs.insert(gauge.runs.end(), run.runs.begin(), run.runs.end());
    gauge.measured.insert(gauge.measured.end(), run.measured.begin(), run.measured.end());
    gauge.model.insert(gauge.model.end(), run.model.begin(), run.model.end());
  }
  const auto [least, most] = std::ranges::minmax(slopes);
  if (std::ranges::any_of(slopes, is_gauge_slope) || least <= 0.0 || most > of_gains.one_gauge * least)
    return std::nullopt;
  const Line line(gauge.measured, gauge.model);
  if (line.correlation < of_gains.alike) return std::nullopt;
  const double power = std::pow(10.0, std::round(std::log10(line.slope)));
  const bool is_power = std::abs(std::log(line.slope / power)) < std::log(of_gains.same);
  place.factor = domain::significant(place.factor / (is_power ? power : line.slope), digits);
  return Finding{
      .quantity = key,
      .runs = gauge.runs,
      .message = fmt::format("{} is {:.3g} times what the rig would do, and no unit says why: is a factor "
                             "of its gauge, or of its heading, left out? Then columns: {{{}}}",
                             key, line.slope, line_of(key, place)),
      .severity = Severity::doubtful};
}

std::optional<Finding> other_span(const std::vector<Compared>& runs, const std::string& key,
                                  ColumnPlace place, const plant::Valve& valve) {
  if (valve.is_on_off() || valve.seals() || runs.empty()) return std::nullopt;
  const auto share_of = [](const Compared& rows) {  // of what the rig would do
    double along = 0.0, all = 0.0;
    for (std::size_t k = 0; k < rows.model.size(); ++k) {
      along += rows.measured[k] * rows.model[k];
      all += rows.model[k] * rows.model[k];
    }
    return along / all;
  };
  Compared gauge;
  for (const Compared& run : runs) gauge.add(run);
  std::ranges::sort(gauge.runs);
  const double share = share_of(gauge);
  const auto differs = [&](const Compared& run) {
    return !(std::abs(std::log(share_of(run) / share)) < std::log(of_gains.one_span));
  };
  const auto as_it_is = [&](std::size_t k) { return (gauge.measured[k] - gauge.model[k]) / share; };
  if (!(std::abs(std::log(share)) > std::log(of_gains.other_span)) || std::ranges::any_of(runs, differs) ||
      !(share_left(gauge, share, 0.0, as_it_is) < of_gains.scaled_share))
    return std::nullopt;
  const double span_Pa = valve.zero_pressure_Pa + Line(gauge.measured, gauge.model).slope *
                                                      (valve.span_pressure_Pa - valve.zero_pressure_Pa);
  place.factor = domain::significant(place.factor / share, digits);
  return Finding{
      .quantity = key,
      .runs = gauge.runs,
      .message = fmt::format("{} is {:.3g} times what the valve would give: is span_pressure of "
                             "the rig's valve {:.3g} bar, not {:.3g} bar? Or is a factor of its gauge, or of "
                             "its heading, left out: columns: {{{}}}?",
                             key, share, span_Pa / plant::Pa_per_bar,
                             valve.span_pressure_Pa / plant::Pa_per_bar, line_of(key, place)),
      .severity = Severity::doubtful};
}

namespace {

/// Whether all runs are off by that.
bool agree_on(double off, const std::vector<double>& offs) {
  return std::ranges::all_of(
      offs, [&](double one) { return std::abs(one - off) <= of_gains.same_zero * std::abs(off); });
}

/// What a gauge reads more, in the middle, as long as the model rests at its beginning, at its lowest; none
/// where it rests for a few rows only. Nothing lags there.
std::optional<double> off_at_beginning(const Compared& gauge) {
  const double near_Pa = thresholds.reading.gauge_step_Pa;
  std::vector<double> off_Pa;
  for (std::size_t k = 0; k < gauge.model.size() && std::abs(gauge.model[k] - gauge.model[0]) < near_Pa; ++k)
    off_Pa.push_back(gauge.measured[k] - gauge.model[k]);
  if (off_Pa.size() < thresholds.plausible.least_rows ||
      gauge.model[0] > *std::ranges::min_element(gauge.model) + near_Pa)
    return std::nullopt;
  return median(std::move(off_Pa));
}

}  // namespace

std::optional<Finding> other_zero_of_gauge(const std::vector<Compared>& runs, const std::string& key,
                                           ColumnPlace place, double accuracy_Pa) {
  std::vector<double> offs_Pa, lowest_Pa;
  Finding found{.quantity = key, .message = {}, .severity = Severity::doubtful};
  for (const Compared& run : runs) {
    if (Line(run.measured, run.model).correlation < of_gains.hardly_alike) return std::nullopt;
    found.runs.insert(found.runs.end(), run.runs.begin(), run.runs.end());
    lowest_Pa.push_back(*std::ranges::min_element(run.measured) - *std::ranges::min_element(run.model));
    if (const auto off_Pa = off_at_beginning(run)) offs_Pa.push_back(*off_Pa);
  }
  const std::optional<double> unit_Pa = size_Pa(place.unit);
  if (offs_Pa.empty() || !unit_Pa) return std::nullopt;
  const double off_Pa = median(offs_Pa);
  const auto comes_back = [&](double one) { return one / off_Pa < 1.0 - of_gains.same_zero; };
  if (std::abs(off_Pa) < std::max(of_gains.zero_Pa, of_gains.zero_accuracies * accuracy_Pa) ||
      !agree_on(off_Pa, offs_Pa) || std::ranges::any_of(lowest_Pa, comes_back))
    return std::nullopt;
  place.zero = domain::significant(place.zero + off_Pa / *unit_Pa / place.factor, digits - 1);
  found.message = fmt::format(
      "{} reads {:.3g} bar {} than the rig has where runs begin: is its zero what its gauge reads "
      "without pressure? About columns: {{{}}}",
      key, std::abs(off_Pa) / plant::Pa_per_bar, off_Pa > 0.0 ? "more" : "less", line_of(key, place));
  return found;
}

}  // namespace mckibben::data
