// See the header.
#include <algorithm>
#include <iterator>
#include <utility>

#include <sim/data/judged.hpp>
#include <sim/data/stamps.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/look.hpp>

namespace mckibben::run {
namespace {

domain::Run beginning_of(domain::Run run, std::size_t rows) {
  if (rows >= run.judged().size()) return run;
  for (auto* column : {&run.current_mA, &run.contraction_ratio, &run.force_N, &run.angle_rad})
    if (!column->empty()) column->resize(rows);
  for (const domain::Beside which : domain::besides)
    if (which != domain::Beside::force && run.gauge(which)) run.gauge(which)->resize(rows);
  if (!run.missing.empty()) run.missing.resize(rows);
  if (run.measured) run.measured->rows.resize(rows);
  return run;
}

}  // namespace

std::vector<data::Expected> expected_of(const domain::Dataset& data,
                                        const std::vector<ReplayedRun>& replayed) {
  std::vector<data::Expected> list(replayed.size());
  const bool pair = data.rig.pair() != nullptr;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const domain::Run& run = data.runs[i];
    const double longer = run.rest_length_m > 0.0 ? data.rig.muscle.rest_length_m / run.rest_length_m : 1.0;
    for (const Sample& sample : replayed[i].recording.samples) {
      list[i].judged.push_back(run.kind_of_judged() == domain::Judged::angle ? sample.angle_rad
                               : run.kind_of_judged() == domain::Judged::force
                                   ? sample.cord_force_N
                                   : sample.shown_ratio() * longer);
      list[i].pressure_Pa.push_back(sample.state.side.muscle_pressure_Pa);
      if (pair) list[i].opposite_pressure_Pa.push_back(sample.state.opposite.muscle_pressure_Pa);
      if (run.beside(domain::Beside::force) != nullptr)
        list[i].force_N.push_back(std::max(sample.cord_force_N, 0.0));
      for (const domain::Beside which : domain::valve_gauges)
        if (run.beside(which) != nullptr)
          list[i].beside(which).push_back(
              sample.side_state(domain::channel_of(which, true).muscle).valve_pressure_Pa);
    }
  }
  return list;
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
    rows += std::min(run.judged().size(), most_rows_of_a_run);
    all = all && run.judged().size() <= most_rows_of_a_run;
  }
  const std::size_t step = rows / most_rows + 1;
  std::vector<domain::Run> runs = std::exchange(data.runs, {});
  for (std::size_t i = 0; i < runs.size(); i += step)
    data.runs.push_back(beginning_of(std::move(runs[i]), most_rows_of_a_run));
  const auto replayed = replay(data, 0, [](const auto&, auto, auto) {});
  if (interrupted()) throw Interrupted();
  data::Examined examined = data::examine(data, expected_of(data, replayed));
  if (step == 1 && all)
    data::require_enough(data, examined.left_out, examined.findings);
  else
    std::erase_if(examined.findings, [](const data::Finding& one) { return one.quantity.empty(); });
  for (data::Finding& finding : examined.findings)
    for (std::size_t& run : finding.runs) run *= step;
  std::ranges::move(examined.findings, std::back_inserter(findings));
  return {std::move(findings), data.runs.size()};
}

}  // namespace mckibben::run
