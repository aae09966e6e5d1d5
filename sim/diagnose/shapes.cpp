// See the header.
#include <algorithm>

#include <sim/diagnose/shapes.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

Eigen::VectorXd from_row(Eigen::VectorXd column, Eigen::Index row) {
  column.head(row).setZero();
  return column;
}

}  // namespace

Eigen::VectorXd lateness(const Eigen::VectorXd& model, int ticks) {
  Eigen::VectorXd column(model.size());
  for (Eigen::Index k = 0; k < model.size(); ++k)
    column[k] = (model[std::clamp<Eigen::Index>(k - ticks, 0, model.size() - 1)] - model[k]) /
                static_cast<double>(ticks);
  return column;
}

Eigen::VectorXd ramp(Eigen::Index rows) {
  return Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0);
}

std::vector<Experiment::Change> inputs_in_error(const domain::Dataset& data) {
  constexpr double share = thresholds.fault.current_share;
  const double offset = thresholds.fault.current_mA * data.rig.valve.per_mA();
  if (data.pressure_is_given()) {
    constexpr double offset_bar = thresholds.fault.pressure_bar;
    const auto gauge = [](plant::GaugeLaw law, const auto& change) {
      return [=](Loaded& h) {
        auto& error = h.rig.effects.get<plant::GaugeError>();
        if (error.absent()) error.variant = law;
        change(error);
      };
    };
    return {{gauge(plant::GaugeLaw::gain, [](plant::GaugeError& error) { error.gain += share; }), share},
            {gauge(plant::GaugeLaw::offset,
                   [](plant::GaugeError& error) { error.offset_Pa += offset_bar * plant::Pa_per_bar; }),
             offset_bar}};
  }
  return {{[](Loaded& h) {
             h.rig.valve.zero_command *= 1.0 + share;
             h.rig.valve.span_command *= 1.0 + share;
           },
           share},
          {[offset](Loaded& h) {
             h.rig.valve.zero_command += offset;
             h.rig.valve.span_command += offset;
           },
           offset}};
}

void each_shape(const Undisturbed& run, const std::function<void(const Shape&)>& visit) {
  const Eigen::Index rows = run.model.size();
  visit({FaultKind::zero, 0, 0.0, Eigen::VectorXd::Ones(rows)});
  visit({FaultKind::drift, 0, 0.0, ramp(rows)});
  if (run.of_stamps) {
    const Eigen::VectorXd slight = 0.5 * (lateness(run.model, 1) + lateness(run.model, -1));
    for (const double half : {0.5, -0.5}) visit({FaultKind::late, 0, half, slight});
  }
  for (int ticks = 1; ticks <= thresholds.fault.most_ticks; ++ticks)
    for (const int signed_ticks : {ticks, -ticks})
      visit({FaultKind::late, 0, static_cast<double>(signed_ticks), lateness(run.model, signed_ticks)});
  visit({FaultKind::current_scale, 0, 0.0, run.scale});
  visit({FaultKind::current_offset, 0, 0.0, run.offset});
  visit({FaultKind::reading_scale, 0, 0.0, run.model});
  const Eigen::Index stride = std::max<Eigen::Index>(1, rows / thresholds.fault.beginnings);
  for (Eigen::Index row = stride; row + stride < rows; row += stride)
    visit(
        {FaultKind::slipped, static_cast<std::size_t>(row), 0.0, from_row(Eigen::VectorXd::Ones(rows), row)});
  for (const int ticks : thresholds.fault.lost_ticks) {
    const Eigen::VectorXd early = -lateness(run.model, -ticks);
    for (Eigen::Index row = stride; row + stride < rows; row += stride)
      visit({FaultKind::rows_lost, static_cast<std::size_t>(row), static_cast<double>(ticks),
             from_row(early, row)});
  }
}

}  // namespace mckibben::diagnose
