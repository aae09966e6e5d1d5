// See the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <sim/diagnose/constancy.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const ConstancyThresholds& constant_by = thresholds.constancy;

/// A way to take the data apart: which part each row of the residuals is in.
struct Parting {
  std::string along;
  std::vector<std::string> parts;
  std::vector<std::size_t> of_row;
};

/// Where parts begin if numbers apart by at least this ratio are of different ones.
std::vector<double> apart(std::vector<double> values, double ratio) {
  std::sort(values.begin(), values.end());
  std::vector<double> begins;
  for (const double value : values)
    if (begins.empty() || value > ratio * begins.back()) begins.push_back(value);
  return begins;
}

std::size_t place_of(double value, const std::vector<double>& begins) {
  return static_cast<std::size_t>(std::upper_bound(begins.begin(), begins.end(), value) - begins.begin()) - 1;
}

/// What a run is told apart by, in words.
std::string level_in_words(const domain::Run& run, double level) {
  return run.length_is_given() ? fmt::format("contraction {:.3g}", level) : fmt::format("{:.6g} kg", level);
}

Parting by_level(const Experiment& experiment, const Runs& runs) {
  const domain::Dataset& data = experiment.data();
  const bool lengths = data.force_is_judged();
  std::vector<double> levels;
  for (const std::size_t run : runs) levels.push_back(level_of(data.runs[run]));
  const auto parts = apart(levels, 1.0);
  Parting parting{lengths ? "length" : "load", {}, {}};
  for (const double level : parts) parting.parts.push_back(level_in_words(data.runs[runs.front()], level));
  for (std::size_t i = 0; i < runs.size(); ++i)
    parting.of_row.insert(parting.of_row.end(), experiment.rows(runs[i]), place_of(levels[i], parts));
  return parting;
}

using States = std::vector<std::vector<plant::State<double>>>;

/// How fast its pressure changes on average, of each run.
std::vector<double> rates(const States& states, double row_s) {
  std::vector<double> list;
  for (const auto& run : states) {
    double way = 0.0;
    for (std::size_t k = 1; k < run.size(); ++k)
      way += std::abs(run[k].side.muscle_pressure_Pa - run[k - 1].side.muscle_pressure_Pa);
    list.push_back(way / (row_s * static_cast<double>(std::max<std::size_t>(run.size(), 2) - 1)));
  }
  return list;
}

Parting by_motion(const Experiment& experiment, const Runs& runs, const States& states) {
  const auto rate = rates(states, experiment.data().row_s());
  const auto parts = apart(rate, constant_by.same_motion);
  Parting parting{"motion", {}, {}};
  for (const double slowest : parts)
    parting.parts.push_back(fmt::format("pressure changing by {:.2g} bar/s", slowest / plant::Pa_per_bar));
  for (std::size_t i = 0; i < runs.size(); ++i)
    parting.of_row.insert(parting.of_row.end(), experiment.rows(runs[i]), place_of(rate[i], parts));
  return parting;
}

/// Speeds in two halves, those of a row and not of its run.
Parting by_speed(const Experiment& experiment, const Rig& rig, const Runs& runs, const States& states) {
  const bool pair = rig.pair() != nullptr;
  const double per_ratio = pair ? rig.muscle.rest_length_m / rig.joint.wheel_radius_m / plant::degree_rad
                                : 1e3 * rig.muscle.rest_length_m;
  std::vector<double> speeds;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t row = 0; row < experiment.rows(runs[i]); ++row)
      speeds.push_back(per_ratio * std::abs(states[i][row % states[i].size()].joint.contraction_speed_per_s));
  std::vector<double> moving;
  std::copy_if(speeds.begin(), speeds.end(), std::back_inserter(moving),
               [](double speed) { return speed > thresholds.where.rest_mm_per_s; });
  if (moving.empty()) return {};
  const auto middle = moving.begin() + static_cast<std::ptrdiff_t>(moving.size() / 2);
  std::nth_element(moving.begin(), middle, moving.end());
  const std::string unit = pair ? "deg/s" : "mm/s";
  Parting parting{
      "speed",
      {fmt::format("below {:.2g} {}", *middle, unit), fmt::format("above {:.2g} {}", *middle, unit)},
      {}};
  for (const double speed : speeds) parting.of_row.push_back(speed < *middle ? 0 : 1);
  return parting;
}

std::vector<Parting> partings(const Experiment& experiment, const Rig& rig, const Runs& runs) {
  std::vector<Parting> list{by_level(experiment, runs)};
  if (!experiment.data().force_is_judged()) {
    States states;
    for (Readings& of_run : experiment.readings(rig, runs)) states.push_back(std::move(of_run.states));
    list.push_back(by_motion(experiment, runs, states));
    list.push_back(by_speed(experiment, rig, runs, states));
  }
  std::erase_if(list, [](const Parting& parting) { return parting.parts.size() < 2; });
  return list;
}

/// The sizes of one effect in the parts of the data.
Drift drift_in(const Experiment& experiment, const Model& model, const Candidate& effect,
               std::size_t amplitude, const Experiment::Slopes& at, const Parting& parting, const Runs& runs,
               double inflation) {
  const auto free = static_cast<Eigen::Index>(model.free.size());
  const auto parts = static_cast<Eigen::Index>(parting.parts.size());
  const auto a = static_cast<Eigen::Index>(amplitude);
  // The effect's column gives way to one for each part.
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(at.columns.rows(), free + parts);
  columns.leftCols(free) = at.columns;
  // What else is free of it stays: it would take up differences between the parts.
  const std::string own = keys_of(effect.who());
  for (Eigen::Index j = 0; j < free; ++j)
    if (model.free[static_cast<std::size_t>(j)].path.starts_with(own)) columns.col(j).setZero();
  for (Eigen::Index row = 0; row < columns.rows(); ++row)
    columns(row, free + static_cast<Eigen::Index>(parting.of_row[static_cast<std::size_t>(row)])) =
        at.columns(row, a);
  Eigen::MatrixXd priors = Eigen::MatrixXd::Zero(free + parts, free + parts);
  Eigen::VectorXd from_origin = Eigen::VectorXd::Zero(free + parts);
  for (Eigen::Index j = 0; j < free; ++j) {
    const Parameter& p = model.free[static_cast<std::size_t>(j)];
    if (!p.has_prior) continue;
    priors(j, j) = 1.0;
    from_origin[j] = p.scaled(value_of(model.rig, p.path));
  }
  const Eigen::VectorXd lengths = columns.colwise().squaredNorm();
  const Eigen::MatrixXd information =
      columns.transpose() * columns / inflation + priors +
      thresholds.screen.ridge * Eigen::MatrixXd::Identity(free + parts, free + parts);
  const auto solver = information.ldlt();
  const Eigen::VectorXd change = solver.solve(columns.transpose() * at.residuals / inflation - from_origin);
  const Eigen::MatrixXd inverse = solver.solve(Eigen::MatrixXd::Identity(free + parts, free + parts));
  const Eigen::MatrixXd scatter =
      priors + scatter_of(experiment, runs, columns, at.residuals - columns * change, inflation).scores;
  const Eigen::MatrixXd robust = inverse * scatter * inverse;
  const Parameter& p = model.free[amplitude];
  const double value = value_of(model.rig, p.path), scaled = p.scaled(value);
  const double unit = p.logarithmic ? std::abs(value) : std::abs(p.unscaled(1.0) - p.unscaled(0.0));
  // No less than what is stated if nothing scattered more than it is thought to; where the effect makes no
  // difference nothing is known of it.
  const auto of_parts = [&](const Eigen::MatrixXd& all) { return all.diagonal().tail(parts).array(); };
  const Eigen::VectorXd wider = (of_parts(inverse) / of_parts(robust)).max(1.0).sqrt();
  Eigen::MatrixXd covariance =
      unit * unit * (wider.asDiagonal() * robust.bottomRightCorner(parts, parts) * wider.asDiagonal());
  std::vector<SizeIn> sizes;
  for (Eigen::Index c = 0; c < parts; ++c) {
    if (lengths[free + c] < thresholds.fit.least_influence)
      covariance(c, c) = std::numeric_limits<double>::infinity();
    sizes.push_back({parting.parts[static_cast<std::size_t>(c)], p.unscaled(scaled + change[free + c]),
                     std::sqrt(covariance(c, c))});
  }
  return drift_of(parting.along, std::move(sizes), covariance, value - effect.absent);
}

}  // namespace

Drift drift_of(std::string along, std::vector<SizeIn> sizes, const Eigen::MatrixXd& covariance, double size) {
  Drift drift{.along = std::move(along), .sizes = std::move(sizes)};
  for (std::size_t i = 0; i < drift.sizes.size(); ++i) {
    const auto a = static_cast<Eigen::Index>(i);
    if (drift.sizes[i].error < constant_by.known * std::abs(size)) ++drift.known;
    for (std::size_t j = 0; j < i; ++j) {
      const auto b = static_cast<Eigen::Index>(j);
      const double variance = covariance(a, a) + covariance(b, b) - 2.0 * covariance(a, b);
      const double apart = std::abs(drift.sizes[i].value - drift.sizes[j].value);
      if (!std::isfinite(variance) || !(variance > 0.0)) continue;
      const double deviations = apart / std::sqrt(variance), share = apart / std::abs(size);
      if (deviations < constant_by.deviations || share < drift.share) continue;
      drift.share = share;
      drift.deviations = deviations;
    }
  }
  return drift;
}

std::vector<Constancy> constancies(const Experiment& experiment, const Model& fitted, const Runs& runs,
                                   double inflation) {
  const auto at = experiment.slopes(fitted.rig, fitted.free, runs);
  const auto ways = partings(experiment, fitted.rig, runs);
  std::vector<Constancy> list;
  for (const Candidate& effect : fitted.effects) {
    Constancy& constancy = list.emplace_back();
    const auto amplitude = std::ranges::find(fitted.free, effect.amplitude, &Parameter::path);
    if (amplitude == fitted.free.end()) continue;  // no reading depends on it
    const auto place = static_cast<std::size_t>(amplitude - fitted.free.begin());
    for (const Parting& parting : ways)
      constancy.push_back(drift_in(experiment, fitted, effect, place, at, parting, runs, inflation));
  }
  return list;
}

}  // namespace mckibben::diagnose
