// See the header.
#include <algorithm>
#include <cmath>

#include <sim/data/amount.hpp>
#include <sim/identify/gaps.hpp>
#include <sim/identify/held_out.hpp>

namespace mckibben::identify {

std::vector<Eigen::VectorXd> unpredicted_by_all(const Identified& found) {
  const auto groups = groups_of(found.study->rows);
  std::vector<Eigen::VectorXd> list;
  list.reserve(found.models.size());
  for (const Model& model : found.models) list.push_back(unpredicted(model, groups));
  return list;
}

diagnose::Gap gap_of(const Identified& found, const Three& three, const diagnose::NoiseFloor& floor) {
  const Rows& rows = found.study->rows;
  diagnose::Gap gap{.noise_floor = std::max(floor.judged, rows.count / std::sqrt(12.0)),
                    .nominal_rmse = rows.rms(three.by_nominal),
                    .recalibrated_rmse = rows.rms(three.by_recalibrated),
                    .corrected_rmse = rows.rms(three.by_corrected),
                    .jitter = floor.jitter,
                    .judged = rows.data().judged()};
  const auto above = [&](double error) {
    return std::max(0.0, error * error - gap.noise_floor * gap.noise_floor);
  };
  if (above(gap.nominal_rmse) > 0.0)
    gap.closed = std::clamp(1.0 - above(gap.corrected_rmse) / above(gap.nominal_rmse), 0.0, 1.0);
  for (std::size_t kind = 1; kind < rows.kinds.size(); ++kind) {
    const plant::Channel& of_kind = rows.kinds[kind];
    const auto of = [&](const Eigen::VectorXd& left) { return rows.rms(left, {}, kind); };
    gap.beside.push_back({of_kind.key_in_dataset(), std::string(data::si_unit(*of_kind.signal)),
                          floor.beside(of_kind), of(three.by_nominal), of(three.by_recalibrated),
                          of(three.by_corrected)});
  }
  return gap;
}

std::vector<diagnose::RunGap> gaps_of_runs(const Identified& found, const Three& three,
                                           const diagnose::Experiment& experiment) {
  const Rows& rows = found.study->rows;
  const auto& runs = rows.data().runs;
  std::vector<diagnose::RunGap> gaps(runs.size());
  diagnose::Runs left_out;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    diagnose::RunGap& gap = gaps[run];
    gap.id = runs[run].id;
    gap.load_kg = runs[run].load_kg;
    gap.held_out = std::ranges::find(rows.runs, run) != rows.runs.end();
    gap.left_out = !gap.held_out;
    if (gap.left_out) left_out.push_back(run);
    gap.measured = runs[run].judged().values;
    for (double& read : gap.measured) read += experiment.floor().middle;
  }
  const auto tell = [&](const Model& model, const Eigen::VectorXd& left, double diagnose::RunGap::*rmse,
                        std::vector<double> diagnose::RunGap::*simulated) {
    for (const Block& block : rows.blocks) {
      if (!rows.is_judged(block)) continue;
      diagnose::RunGap& gap = gaps[rows.runs[block.run]];
      gap.*rmse = rows.rms(left, block.run);
      const Eigen::VectorXd predicted = (rows.read - left).segment(block.begin, block.rows);
      (gap.*simulated).assign(predicted.begin(), predicted.end());
    }
    if (left_out.empty()) return;
    auto readings = experiment.readings(model.problem->dictionary.setting(model.point).rig, left_out);
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      const std::size_t run = left_out[i];
      gaps[run].*rmse = experiment.rmse(experiment.residuals(readings[i], run), {run});
      gaps[run].*simulated = std::move(readings[i].readings.front());
    }
  };
  tell(three.nominal, three.by_nominal, &diagnose::RunGap::nominal_rmse, &diagnose::RunGap::nominal);
  tell(three.recalibrated, three.by_recalibrated, &diagnose::RunGap::recalibrated_rmse,
       &diagnose::RunGap::recalibrated);
  tell(three.corrected, three.by_corrected, &diagnose::RunGap::corrected_rmse, &diagnose::RunGap::corrected);
  return gaps;
}

}  // namespace mckibben::identify
