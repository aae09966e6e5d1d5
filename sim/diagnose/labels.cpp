// One-dimensional fits of the load, and robust statistics of them; see the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <sim/data/series.hpp>
#include <sim/diagnose/labels.hpp>
#include <sim/diagnose/shapes.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

using Series = std::vector<double>;  // a value for each run of the data set

/// An offset that no parameter in error makes.
double sure_of_kg(double load_kg) {
  return thresholds.label.sure_kg + thresholds.label.sure_share * load_kg;
}

class Scales {
 public:
  Scales(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs,
         unsigned threads)
      : data_(data), masked_(masked), threads_(threads), loads_kg_(data.runs.size()) {
    weigh(runs);
  }

  /// The run whose label is most in doubt among `runs`.
  std::optional<WrongLabel> worst(const Runs& runs) const;

  double common_ratio(const Runs& runs) const {
    Series ratios;
    for (const std::size_t run : runs) ratios.push_back(loads_kg_[run] / data_.runs[run].load_kg);
    return data::median(std::move(ratios));
  }

 private:
  /// Residuals and slope for the load, at other loads than the labels.
  Experiment::Slopes at(const Series& loads_kg, const Runs& runs) const {
    domain::Dataset moved = data_;
    for (const std::size_t run : runs)
      moved.runs[run].load_kg = std::max(loads_kg[run], thresholds.label.least_kg);
    constexpr double step_kg = thresholds.label.step_kg;
    const Experiment::Change heavier{[](Loaded& h) { h.load_kg += step_kg; }, step_kg};
    return Experiment(moved, masked_, threads_).slopes(moved.rig, {&heavier, 1}, runs);
  }
  std::vector<Experiment::Part> parts(const Runs& runs) const {
    return Experiment(data_, masked_, threads_).parts(runs);
  }
  /// Each run's sum of squares.
  Series squares(const Series& loads_kg, const Runs& runs) const {
    const auto slopes = at(loads_kg, runs);
    Series sums(loads_kg.size(), 0.0);
    for (const auto& part : parts(runs))
      sums[part.run] = slopes.residuals.segment(part.begin, part.rows).squaredNorm();
    return sums;
  }
  /// What explains the run better than any load does: another zero, or another current. None if nothing does.
  std::optional<Fault> other_fault(std::size_t run, const Series& usual_kg) const {
    domain::Dataset usual = data_;
    usual.runs[run].load_kg = usual_kg[run];
    const Experiment experiment(usual, masked_, threads_);
    const auto slopes = experiment.slopes(usual.rig, inputs_in_error(usual), {run});
    const auto part = experiment.parts({run}).front();
    const Eigen::VectorXd residuals = slopes.residuals.segment(part.begin, part.rows);
    double least = squares_[run];
    std::optional<Fault> best;
    const auto consider = [&](FaultKind kind, const Eigen::VectorXd& column) {
      const double size = column.dot(residuals) / column.squaredNorm();
      const double left = (residuals - size * column).squaredNorm();
      if (!(left < least)) return;
      least = left;
      best = Fault{run, kind, size};
    };
    consider(FaultKind::zero, Eigen::VectorXd::Constant(part.rows, 1.0 / experiment.floor().judged));
    consider(FaultKind::current_scale, slopes.columns.col(0).segment(part.begin, part.rows));
    consider(FaultKind::current_offset, slopes.columns.col(1).segment(part.begin, part.rows));
    return best;
  }
  void weigh(const Runs& runs);

  const domain::Dataset& data_;
  const std::vector<std::vector<bool>>& masked_;
  unsigned threads_;
  Series loads_kg_;  // that fit best
  Series squares_;
};

// Gauss-Newton in one dimension, with steps halved where they overshoot: the load has little say while it
// rests on the braid stop.
void Scales::weigh(const Runs& runs) {
  for (std::size_t i = 0; i < data_.runs.size(); ++i) loads_kg_[i] = data_.runs[i].load_kg;
  squares_.assign(loads_kg_.size(), std::numeric_limits<double>::infinity());
  Series tried_kg = loads_kg_, step_kg(loads_kg_.size(), 0.0);
  Runs moving = runs;
  for (int iteration = 0; iteration < thresholds.label.steps && !moving.empty(); ++iteration) {
    const auto slopes = at(tried_kg, moving);
    for (const auto& part : parts(moving)) {
      const auto residuals = slopes.residuals.segment(part.begin, part.rows);
      const auto slope = slopes.columns.col(0).segment(part.begin, part.rows);
      double& load_kg = loads_kg_[part.run];
      double& step = step_kg[part.run];
      if (residuals.squaredNorm() < squares_[part.run]) {
        squares_[part.run] = residuals.squaredNorm();
        load_kg = tried_kg[part.run];
        step = slope.dot(residuals) / std::max(slope.squaredNorm(), thresholds.fit.least_influence);
        step = std::clamp(step, thresholds.label.least_step * load_kg, thresholds.label.most_step * load_kg);
      } else {
        step *= 0.5;
      }
      tried_kg[part.run] = load_kg + step;
    }
    std::erase_if(moving,
                  [&](std::size_t run) { return std::abs(step_kg[run]) < thresholds.label.exact_kg; });
  }
}

std::optional<WrongLabel> Scales::worst(const Runs& runs) const {
  const auto label_kg = [&](std::size_t run) { return data_.runs[run].load_kg; };
  const auto offset_kg = [&](std::size_t run) { return loads_kg_[run] - label_kg(run); };
  const auto of_others = [&](std::size_t run, const auto& value) {
    Series values;
    for (const std::size_t other : runs)
      if (other != run) values.push_back(value(other));
    return data::median(std::move(values));
  };
  // How far each run's offset is from that of the others, and its load with theirs.
  Series away_kg(data_.runs.size(), 0.0), usual_kg = away_kg, doubt = away_kg;
  Runs doubted;
  for (const std::size_t run : runs) {
    const double common_kg = of_others(run, offset_kg);
    const double spread_kg =
        of_others(run, [&](std::size_t other) { return std::abs(offset_kg(other) - common_kg); });
    away_kg[run] = offset_kg(run) - common_kg;
    usual_kg[run] = label_kg(run) + common_kg;
    const double limit_kg = std::max(thresholds.label.spreads * spread_kg, sure_of_kg(label_kg(run))) +
                            thresholds.label.trend * std::abs(label_kg(run) - of_others(run, label_kg));
    doubt[run] = std::abs(away_kg[run]) / limit_kg;
    if (doubt[run] > 1.0) doubted.push_back(run);
  }
  if (doubted.empty()) return std::nullopt;
  std::sort(doubted.begin(), doubted.end(),
            [&](std::size_t a, std::size_t b) { return doubt[a] > doubt[b]; });
  const Series usual = squares(usual_kg, runs);
  for (const std::size_t run : doubted) {
    if (squares_[run] > thresholds.label.still_there * usual[run]) continue;
    Series same_kg = usual_kg;
    for (double& load_kg : same_kg) load_kg += away_kg[run];
    const Series same = squares(same_kg, runs);
    if (of_others(run, [&](std::size_t other) { return same[other] / usual[other]; }) <
        thresholds.label.others_suffer)
      continue;
    return WrongLabel{run, label_kg(run) + away_kg[run], other_fault(run, usual_kg)};
  }
  return std::nullopt;
}

}  // namespace

Labels check_labels(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, Runs runs,
                    unsigned threads) {
  Labels labels;
  if (runs.size() < thresholds.label.least_runs) return labels;
  const Scales scales(data, masked, runs, threads);
  labels.common_ratio = scales.common_ratio(runs);
  // The worst first, because it disturbs the others' medians: two that were exchanged come one after the
  // other.
  while (runs.size() + labels.wrong.size() >= thresholds.label.least_runs &&
         runs.size() >= thresholds.label.least_left) {
    const auto next = scales.worst(runs);
    if (!next) break;
    labels.wrong.push_back(*next);
    std::erase(runs, next->run);
  }
  return labels;
}

}  // namespace mckibben::diagnose
