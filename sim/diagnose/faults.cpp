// Trimmed least squares, then a dictionary; see the header. All is linear at the rig that is given: a run's
// fault must be far larger than what is left of the others.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <Eigen/QR>

#include <sim/diagnose/examination.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const FaultThresholds& of_faults = thresholds.fault;

/// What sizes vary by [rms] if the loads tell them, else 0.
double varied_by_loads(const std::vector<Fault>& faults, const std::vector<domain::Run>& runs) {
  const auto squares = [](const std::vector<double>& sizes) {
    const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
    return std::accumulate(sizes.begin(), sizes.end(), 0.0,
                           [&](double sum, double size) { return sum + (size - mean) * (size - mean); });
  };
  std::vector<double> all;
  std::map<double, std::vector<double>> of_load;
  for (const Fault& fault : faults) {
    all.push_back(fault.size);
    of_load[runs[fault.run].load_kg].push_back(fault.size);
  }
  if (all.size() < of_load.size() + of_faults.spare_runs) return 0.0;
  const double of_all = squares(all);
  double within = 0.0;
  for (const auto& [load, sizes] : of_load) within += squares(sizes);
  if (within >= of_faults.within_loads * of_all) return 0.0;
  return std::sqrt(of_all / static_cast<double>(all.size()));
}

}  // namespace

Examined Examination::operator()() {
  const Examination brief(*this, Brief{});
  const Regression alone = brief.regression(Kept(runs_.size(), true));
  const double most = brief.worst(alone);
  if (runs_.size() <= of_faults.least_sound || most <= of_faults.unquestioned) return {};
  Hypothesis best = few(brief, most > sound ? sound : of_faults.unquestioned);
  for (const Hypothesis& other :
       {brief.common_lateness(alone), own_line(FaultKind::zero), own_line(FaultKind::drift)})
    if (other.cost < best.cost) best = other;
  const bool better = !best.faults.empty() && best.cost <= of_faults.strictly_better * alone.cost();
  if (!better && most <= sound) return {};
  if (!better && asked(experiment_.data(), runs_).size() < runs_.size()) return {{}, suspicions_of_a_few()};
  draw_effects();
  const Examination drawn(*this, Brief{});
  const Regression numbers = drawn.regression(Kept(runs_.size(), true));
  const double with_an_effect = numbers.cost() - drawn.most_gained(numbers);
  if (better && best.cost <= of_faults.strictly_better * with_an_effect) return {best.faults, {}};
  if (most <= sound) return {};
  return {{}, drawn.suspicions(numbers, with_an_effect)};
}

bool Examination::worth_telling(FaultKind kind, double size) const {
  switch (kind) {
    case FaultKind::late:
      return std::abs(size) * experiment_.data().readings_in_a_row() >= of_faults.least_ticks;
    case FaultKind::rows_lost:
      return std::abs(size) >= of_faults.least_ticks;
    case FaultKind::current_scale:
    case FaultKind::reading_scale:
      return std::abs(size) >= of_faults.least_scale;
    case FaultKind::current_offset:
      return std::abs(size) >= (experiment_.data().pressure_is_given()
                                    ? of_faults.least_bar
                                    : of_faults.least_mA * experiment_.data().rig.valve.per_mA());
    case FaultKind::drift:
      return std::abs(size) >= of_faults.least_drift;
    default:
      return std::abs(size) >= of_faults.least_counts * count();
  }
}

void Examination::fly() {
  weight_ = 1.0 / (experiment_.floor().judged * std::sqrt(thresholds.scatter.first_inflation));
  const auto fitted = experiment_.slopes(at_.rig, at_.free, runs_);
  const auto driven = experiment_.slopes(at_.rig, inputs_in_error(experiment_.data()), runs_);
  const auto parts = experiment_.parts(runs_);
  begins_ = {0};
  for (const auto& part : parts) begins_.push_back(begins_.back() + part.rows);
  const auto free = static_cast<Eigen::Index>(at_.free.size());
  residuals_.setZero(begins_.back() + free);
  columns_.setZero(begins_.back() + free, free);
  const double scale = experiment_.floor().judged, to_weighted = scale * weight_;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& part = parts[i];
    const auto of_run = [&](const auto& rows) { return rows.middleRows(part.begin, part.rows); };
    residuals_.segment(begin(i), rows(i)) = to_weighted * of_run(fitted.residuals);
    columns_.middleRows(begin(i), rows(i)) = to_weighted * of_run(fitted.columns);
    const auto& measured = experiment_.data().runs[part.run].judged();
    const Eigen::Map<const Eigen::VectorXd> shown(measured.data(), part.rows);
    readings_.push_back(static_cast<double>(part.rows));
    undisturbed_.push_back({shown - scale * of_run(fitted.residuals), scale * of_run(driven.columns).col(0),
                            scale * of_run(driven.columns).col(1),
                            experiment_.data().readings_in_a_row() > 1.0});
  }
  for (const int ticks : of_faults.common_ticks) {
    lates_.push_back({ticks, Eigen::VectorXd::Zero(residuals_.size())});
    for (std::size_t i = 0; i < parts.size(); ++i)
      lates_.back().column.segment(begin(i), rows(i)) = weighted(lateness(undisturbed_[i].model, ticks));
  }
  for (Eigen::Index j = 0; j < free; ++j) {
    const Parameter& p = at_.free[static_cast<std::size_t>(j)];
    if (!p.has_prior) continue;
    residuals_[begins_.back() + j] = -p.scaled(value_of(at_.rig, p.path));
    columns_(begins_.back() + j, j) = 1.0;
  }
}

Examination::Examination(const Examination& whole, const Runs& few)
    : experiment_(whole.experiment_),
      at_(whole.at_),
      runs_(few),
      effects_(whole.effects_),
      weight_(whole.weight_),
      begins_{0} {
  std::vector<Eigen::Index> rows;
  const auto take = [&](Eigen::Index from, Eigen::Index to) {
    for (Eigen::Index row = from; row < to; ++row) rows.push_back(row);
  };
  for (std::size_t i = 0; i < whole.runs_.size(); ++i) {
    if (std::find(few.begin(), few.end(), whole.runs_[i]) == few.end()) continue;
    take(whole.begins_[i], whole.begins_[i + 1]);
    begins_.push_back(static_cast<Eigen::Index>(rows.size()));
    readings_.push_back(whole.readings_[i]);
    undisturbed_.push_back(whole.undisturbed_[i]);
  }
  take(whole.begins_.back(), whole.residuals_.size());
  residuals_ = whole.residuals_(rows);
  columns_ = whole.columns_(rows, Eigen::all);
  for (const Late& late : whole.lates_) lates_.push_back({late.ticks, late.column(rows)});
}

Examination::Examination(const Examination& whole, Brief)
    : experiment_(whole.experiment_),
      at_(whole.at_),
      runs_(whole.runs_),
      effects_(whole.effects_),
      weight_(whole.weight_),
      begins_{0},
      readings_(whole.readings_),
      lates_(whole.lates_),
      drawn_(whole.drawn_) {
  const Eigen::Index free = whole.columns_.cols();
  const auto count = static_cast<Eigen::Index>(1 + lates_.size() + drawn_.size()) + free;
  // Runs, then the priors.
  std::vector<Eigen::MatrixXd> parts;
  Eigen::Index total = 0;
  for (std::size_t i = 0; i <= runs_.size(); ++i) {
    const Eigen::Index from = whole.begins_[i];
    const Eigen::Index rows = (i < runs_.size() ? whole.begins_[i + 1] : whole.residuals_.size()) - from;
    Eigen::MatrixXd part(rows, count);
    part.col(0) = whole.residuals_.segment(from, rows);
    part.middleCols(1, free) = whole.columns_.middleRows(from, rows);
    Eigen::Index next = 1 + free;
    for (const Late& late : lates_) part.col(next++) = late.column.segment(from, rows);
    for (const Drawn& effect : drawn_) part.col(next++) = effect.column.segment(from, rows);
    parts.push_back(in_brief(std::move(part)));
    total += parts.back().rows();
    if (i < runs_.size()) begins_.push_back(total);
  }
  Eigen::MatrixXd all(total, count);
  Eigen::Index row = 0;
  for (const Eigen::MatrixXd& part : parts) {
    all.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  residuals_ = all.col(0);
  columns_ = all.middleCols(1, free);
  Eigen::Index next = 1 + free;
  for (Late& late : lates_) late.column = all.col(next++);
  for (Drawn& effect : drawn_) effect.column = all.col(next++);
}

/// The fault of the dictionary that explains run `i` next to those kept; another rig if none does. None if
/// the size is nothing to talk of.
std::optional<Fault> Examination::look_up(std::size_t i, Kept kept) const {
  kept[i] = true;
  const Regression fitted = regression(kept);
  Shape best{FaultKind::another_rig};
  double most = 0.0, size = 0.0;
  each_shape(undisturbed_[i], [&](const Shape& shape) {
    auto [drop, amplitude] = fitted.gain(weighted(shape.column), begin(i));
    if (shape.row > 0) drop *= of_faults.for_choice;
    if (shape.drawn_at != 0.0 && std::abs(amplitude - shape.drawn_at) >
                                     of_faults.drawn_ticks + of_faults.drawn_share * std::abs(shape.drawn_at))
      return;
    if (drop <= most || !worth_telling(shape.kind, amplitude)) return;
    most = drop;
    size = amplitude;
    best = shape;
  });
  Regression with = fitted;
  if (most > 0.0) with.add(everywhere(i, weighted(best.column)));
  const double before = mean_square(fitted.left(), i);
  if (mean_square(with.left(), i) <= std::max(sound, of_faults.explained * before) && most > 0.0)
    return Fault{runs_[i], best.kind, size, best.row};
  if (before < of_faults.another_rig) return std::nullopt;
  return Fault{runs_[i], FaultKind::another_rig};
}

/// A few runs of their own kind, the others near the floor without them: within `near` [mean square].
Hypothesis Examination::few(const Examination& brief, double near) const {
  Kept kept(runs_.size(), true);
  std::vector<std::size_t> odd;
  for (;;) {
    const Regression fitted = brief.regression(kept);
    std::vector<std::pair<double, std::size_t>> worst;
    for (std::size_t i = 0; i < runs_.size(); ++i)
      if (kept[i]) worst.emplace_back(brief.mean_square(fitted.left(), i), i);
    std::sort(worst.rbegin(), worst.rend());
    if (worst.front().first <= near) {
      Hypothesis found{{}, fitted.cost()};
      for (const std::size_t i : odd) {
        const auto fault = look_up(i, kept);
        if (!fault) return {};
        found.faults.push_back(*fault);
      }
      std::sort(found.faults.begin(), found.faults.end(),
                [](const Fault& a, const Fault& b) { return a.run < b.run; });
      return found;
    }
    if (worst.size() <= of_faults.least_sound ||
        worst.size() - 1 < of_faults.sound_for_one * (odd.size() + 1))
      return {};
    double least = infinite;
    std::size_t oddest = 0;
    for (std::size_t tried = 0; tried < std::min(worst.size(), of_faults.most_tried); ++tried) {
      Kept fewer = kept;
      fewer[worst[tried].second] = false;
      const double cost = brief.regression(fewer).cost();
      if (cost < least) {
        least = cost;
        oddest = worst[tried].second;
      }
    }
    kept[oddest] = false;
    odd.push_back(oddest);
  }
}

/// All runs late by the same whole number of ticks.
Hypothesis Examination::common_lateness(const Regression& alone) const {
  Hypothesis best;
  for (const Late& late : lates_) {
    const double amplitude = alone.gain(late.column, 0).amplitude;
    if (std::abs(amplitude - late.ticks) > of_faults.whole_tick) continue;
    Regression with = alone;
    with.add(late.column);
    if (with.cost() >= best.cost) continue;
    best = {{}, with.cost()};
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      best.faults.push_back({runs_[i], FaultKind::late, std::round(amplitude), 0, true});
      if (mean_square(with.left(), i) > sound) best.cost = infinite;
    }
  }
  return best.cost < infinite ? best : Hypothesis{};
}

/// Each run with a zero, or a drift, of its own. These lines have no row in common: each is taken out of its
/// run, what is left is fitted, and how large it is follows.
Hypothesis Examination::own_line(FaultKind kind) const {
  const auto line = [&](std::size_t i) {
    return weighted(kind == FaultKind::drift ? ramp(rows(i)) : Eigen::VectorXd::Ones(rows(i)));
  };
  Eigen::VectorXd residuals = residuals_;
  Eigen::MatrixXd columns = columns_;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Eigen::VectorXd along = line(i).normalized();
    auto own = residuals.segment(begin(i), rows(i));
    own -= along * along.dot(own);
    auto of_columns = columns.middleRows(begin(i), rows(i));
    of_columns -= along * (along.transpose() * of_columns).eval();
  }
  const Eigen::VectorXd solved = columns.colPivHouseholderQr().solve(residuals);
  const Eigen::VectorXd left = residuals - columns * solved, with_lines = residuals_ - columns_ * solved;
  Hypothesis found{{}, left.squaredNorm()};
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (mean_square(left, i) > sound) return {};
    const Eigen::VectorXd own = line(i);
    const double size = own.dot(with_lines.segment(begin(i), rows(i))) / own.squaredNorm();
    if (worth_telling(kind, size)) found.faults.push_back({runs_[i], kind, size});
  }
  const bool common = found.faults.size() == runs_.size() &&
                      std::all_of(found.faults.begin(), found.faults.end(), [&](const Fault& fault) {
                        return fault.size * found.faults.front().size > 0.0;
                      });
  const bool by_load = worth_telling(kind, varied_by_loads(found.faults, experiment_.data().runs));
  for (Fault& fault : found.faults) {
    fault.common = common;
    fault.told_by_load = by_load;
  }
  return found;
}

Examined examine(const Experiment& experiment, const Model& at, const Runs& runs,
                 const std::vector<Candidate>& catalogue) {
  return Examination(experiment, at, runs, catalogue)();
}

}  // namespace mckibben::diagnose
