// See the header.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/amount.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/parts.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/stamps.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/units.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/look.hpp>

namespace mckibben::run {
namespace {

/// Sum of the squared differences between measured and simulated; infinite if a run was not simulated.
double squares(const domain::Dataset& data, const std::vector<data::Expected>& expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const domain::Run& run = data.runs[i];
    const domain::Reading& judged = run.judged();
    if (expected[i].judged().size() != run.rows()) return std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < run.rows(); ++k)
      if (!judged.is_missing(k)) sum += std::pow(judged.values[k] - expected[i].judged()[k], 2);
  }
  return sum;
}

/// A given pressure that never comes near open air's tells nothing by itself; with one atmosphere less the
/// rig may come much nearer. Of two muscles most of it cancels.
void ask_absolute(domain::Dataset data, double squares_as_said, std::vector<data::Finding>& findings) {
  if (!data.pressure_is_given() || data.rig.pair() != nullptr) return;
  const auto& limits = data::thresholds.plausible;
  double lowest_Pa = std::numeric_limits<double>::infinity();
  for (domain::Run& run : data.runs)
    for (domain::MeasuredColumn& column : run.measured->columns)
      if (column.given && column.channel.is_pressure())
        for (double& value_Pa : column.values) {
          lowest_Pa = std::fmin(lowest_Pa, value_Pa);
          value_Pa -= data.rig.gas.atmosphere_Pa;
        }
  if (lowest_Pa < limits.most_atmosphere_Pa) return;
  const double left = std::sqrt(
      squares(data, expected_of(data, replay(data, 0, [](const auto&, auto, auto) {}))) / squares_as_said);
  const std::string key = "muscle_pressure", then = data::if_absolute(data, 0, key);
  if (!(left < limits.nearer) || then.empty()) return;
  std::vector<std::size_t> runs(data.runs.size());
  std::iota(runs.begin(), runs.end(), std::size_t{0});
  findings.push_back({.quantity = key,
                      .runs = std::move(runs),
                      .message = fmt::format(
                          "{} never comes below {:.3g} bar, and with one atmosphere less {:.2g} times the "
                          "rig's error is left: is it absolute, or the muscle weaker than the rig says? {}",
                          key, lowest_Pa / plant::Pa_per_bar, left, then),
                      .severity = data::Severity::doubtful});
}

}  // namespace

std::vector<data::Expected> expected_of(const domain::Dataset& data,
                                        const std::vector<ReplayedRun>& replayed) {
  std::vector<data::Expected> list(replayed.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const domain::Run& run = data.runs[i];
    const auto& samples = replayed[i].recording.samples;
    for (const Sample& sample : samples) list[i].pressure_Pa.push_back(sample.state.side.muscle_pressure_Pa);
    for (const domain::Reading& reading : run.readings)
      std::ranges::transform(samples, std::back_inserter(list[i].readings.emplace_back()),
                             shown_of(reading.channel, run, data.rig, false));
  }
  return list;
}

void add_not_at_rest(const domain::Dataset& data, const std::vector<ReplayedRun>& replayed,
                     std::vector<data::Finding>& findings) {
  if (data.recorded.start != domain::Start::settled || data.recorded.skip_s > 0.0) return;
  const bool angle = data.rig.has_angle();
  bool may_move = !angle;
  double fastest = 0.0;
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < replayed.size(); ++i) {
    if (replayed[i].recording.samples.empty() || data.runs[i].length_is_given() ||
        data.runs[i].reads_only_pressures())
      continue;
    const Sample& first = replayed[i].recording.samples.front();
    const double speed =
        std::abs(angle ? first.angle_speed_rad_per_s : first.state.joint.contraction_speed_per_s);
    if (!moves(speed, data.rig)) continue;
    runs.push_back(i);
    fastest = std::max(fastest, speed);
    may_move = may_move && !(data.runs[i].measured && data.runs[i].measured->point_s > 0.0);
  }
  if (runs.empty()) return;
  findings.push_back({.runs = std::move(runs),
                      .message = still_moves(fastest, data.rig) +
                                 (may_move ? ", or start: moving at the top of dataset.yaml" : ""),
                      .severity = data::Severity::doubtful});
}

namespace {

/// A reading of those runs against the rig's.
data::Compared compared(const domain::Dataset& data, const std::vector<ReplayedRun>& replayed,
                        const std::string& reading, const std::vector<std::size_t>& runs) {
  const std::vector<data::Expected> expected = expected_of(data, replayed);
  data::Compared rows;
  for (const std::size_t i : runs) {
    const domain::Run& run = data.runs[i];
    for (std::size_t place = 0; place < run.readings.size(); ++place)
      if (run.readings[place].channel.key_in_dataset() == reading) rows.add(i, run, expected[i], place);
  }
  return rows;
}

/// What its column would be in the unit that fits the rig; empty if none does.
std::string in_another_unit(const data::Compared& rows, const std::string& reading, domain::ColumnPlace place,
                            const plant::Rig& rig) {
  const auto units = reading == "contraction"                        ? data::units_of_contraction(rig)
                     : reading.find("pressure") != std::string::npos ? data::units_of_pressure()
                                                                     : std::vector<data::Unit>{};
  const auto fits = data::unit_that_fits(rows, place, units);
  if (!fits) return "";
  place.unit = fits->name;
  return fmt::format("; in {} it would be {:.0f} %: columns: {{{}}}", fits->name, 100.0 * fits->left,
                     data::line_in_unit(reading, place));
}

}  // namespace

void add_far_off(const domain::Dataset& data, const std::vector<ReplayedRun>& replayed,
                 std::vector<data::Finding>& findings) {
  constexpr double most = 1.0 / 3.0;  // of what was read in all runs
  struct Worst {
    Gap gap{};
    std::vector<std::pair<std::size_t, double>> runs{};  ///< and the rmse of each
  };
  std::map<std::string, Worst> worst;
  for (std::size_t i = 0; i < replayed.size(); ++i)
    for (const Gap& gap : replayed[i].gaps) {
      if (gap.rows == 0) continue;
      auto& [one, runs] = worst[gap.reading];
      one.rmse = std::max(one.rmse, gap.rmse);
      one.low = std::min(one.low, gap.low);
      one.high = std::max(one.high, gap.high);
      runs.emplace_back(i, gap.rmse);
    }
  for (auto& [reading, found] : worst) {
    const double read = found.gap.high - found.gap.low, share = found.gap.rmse / read;
    const auto explains = [&](const data::Finding& one) {
      return one.quantity == reading || one.severity == data::Severity::refused;
    };
    if (!(share > most) || !std::isfinite(share) || std::ranges::any_of(findings, explains)) continue;
    std::vector<std::size_t> far;  // but for runs whose loads are found to be wrong
    double worst_of_far = 0.0;
    for (const auto& [run, rmse] : found.runs) {
      const auto load = [run = run](const data::Finding& one) {
        return one.quantity == "load" && std::ranges::find(one.runs, run) != one.runs.end();
      };
      if (!(rmse > most * read) || std::ranges::any_of(findings, load)) continue;
      far.push_back(run);
      worst_of_far = std::max(worst_of_far, rmse);
    }
    if (far.empty()) continue;
    const auto columns = data::with_our_names(domain::merged(data.columns, data.runs[far.front()].columns),
                                              data.rig.command_unit());
    const data::Compared rows = compared(data, replayed, reading, far);
    const bool by_length = reading == "contraction" && data::divided_by_length(columns[reading]);
    findings.push_back({.quantity = reading,
                        .runs = std::move(far),
                        .message = fmt::format("{}: rmse is up to {:.0f} % of what was read: before "
                                               "diagnose, look at the column's zero, factor "
                                               "and unit, at the loads and at the rig{}{}",
                                               reading, 100.0 * worst_of_far / read,
                                               by_length ? fmt::format(", also at its rest_length, {:.4g} mm",
                                                                       1e3 * data.rig.muscle.rest_length_m)
                                                         : "",
                                               in_another_unit(rows, reading, columns[reading], data.rig)),
                        .severity = data::Severity::doubtful});
  }
}

Look look(domain::Dataset data) {
  std::vector<data::Finding> findings;
  if (!data.rows_of_stamps) findings = data::mend_at_stamps(data);
  data = data::with_rows(std::move(data));
  const auto& [most_rows, most_of_a_run, most_s] = data::thresholds.look;
  const std::size_t most_rows_of_a_run =
      std::min(most_of_a_run, std::max<std::size_t>(2, static_cast<std::size_t>(most_s / data.row_s())));
  std::size_t rows = 0;
  bool all = true;
  for (const domain::Run& run : data.runs) {
    rows += std::min(run.rows(), most_rows_of_a_run);
    all = all && run.rows() <= most_rows_of_a_run;
  }
  const std::size_t step = rows / most_rows + 1;
  std::vector<domain::Run> runs = std::exchange(data.runs, {});
  for (std::size_t i = 0; i < runs.size(); i += step)
    data.runs.push_back(data::beginning_of(std::move(runs[i]), most_rows_of_a_run));
  const auto replayed = replay(data, 0, [](const auto&, auto, auto) {});
  if (interrupted()) throw Interrupted();
  const std::vector<data::Expected> expected = expected_of(data, replayed);
  data::Examined examined = data::examine(data, expected);
  if (step == 1 && all)
    data::require_enough(data, examined.left_out, examined.findings);
  else
    std::erase_if(examined.findings, [](const data::Finding& one) { return one.quantity.empty(); });
  add_not_at_rest(data, replayed, examined.findings);
  ask_absolute(data, squares(data, expected), examined.findings);
  add_far_off(data, replayed, examined.findings);
  for (data::Finding& finding : examined.findings)
    for (std::size_t& run : finding.runs) run *= step;
  std::ranges::move(examined.findings, std::back_inserter(findings));
  return {std::move(findings), data.runs.size()};
}

}  // namespace mckibben::run
