// Trimmed least squares, then a dictionary; see the header. All is linear at the rig that is given: a run's
// fault must be far larger than what is left of the others.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <Eigen/QR>

#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/judge.hpp>
#include <sim/diagnose/regression.hpp>
#include <sim/diagnose/shapes.hpp>

namespace mckibben::diagnose {
namespace {

/// Mean squares, in floors: of runs that raise no question; of runs that are taken for sound.
constexpr double unquestioned = 4.0, sound = near_floor * near_floor;
/// Faults must leave less than this share of the misfit that the rig, or an effect, leaves.
constexpr double strictly_better = 0.3;
/// A shape explains a run if it leaves so little of its misfit.
constexpr double explained = 0.03;
/// Mean square, in floors, of a run that no shape explains: from here on it is of another rig. Less may as
/// well be left by a law that is not quite right.
constexpr double of_another_rig = 64.0;
/// Leaving out runs is worth a thought if an effect then leaves less than this share of what any leaves.
constexpr double worth_suspecting = 0.5;
/// Shapes that begin at a row of their choice must do that much better.
constexpr double for_choice = 0.9;
/// At least so many runs must be sound, and so many times as many as are not.
constexpr std::size_t least_sound = 3, sound_for_one = 2;
/// Where one run is looked for, the worst so many are tried.
constexpr std::size_t most_tried = 6;
/// Smaller sizes are nothing to talk of.
constexpr double least_scale = 0.004, least_mA = 0.03, least_drift = 5e-4, least_ticks = 0.6;

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Hypothesis {
  std::vector<Fault> faults{};
  double cost = infinite;
};

class Examination {
 public:
  Examination(const Experiment& experiment, const Model& at, const Runs& runs,
              const std::vector<Candidate>& effects)
      : experiment_(experiment), at_(at), runs_(runs), effects_(effects) {
    fly();
  }

  Examined operator()() {
    const Regression alone = regression(Kept(runs_.size(), true));
    const double most = worst(alone);
    if (runs_.size() <= least_sound || most <= unquestioned) return {};
    Hypothesis best = few(most > sound ? sound : unquestioned);
    for (const Hypothesis& other :
         {common_lateness(alone), own_line(FaultKind::zero), own_line(FaultKind::drift)})
      if (other.cost < best.cost) best = other;
    const bool better = !best.faults.empty() && best.cost <= strictly_better * alone.cost();
    if (!better && most <= sound) return {};
    draw_effects();
    const double with_an_effect = alone.cost() - most_gained(alone);
    if (better && best.cost <= strictly_better * with_an_effect) return {best.faults, {}};
    if (most <= sound) return {};
    return {{}, suspicions(with_an_effect)};
  }

 private:
  using Kept = std::vector<bool>;

  Eigen::Index begin(std::size_t i) const { return begins_[i]; }
  Eigen::Index rows(std::size_t i) const { return begins_[i + 1] - begins_[i]; }

  /// A candidate's straight line, drawn at half its typical size.
  struct Drawn {
    const Candidate* candidate;
    double shape;
    Eigen::VectorXd column;
    bool possible(double amplitude) const {
      return candidate->either_sign || amplitude * candidate->typical >= 0.0;
    }
  };

  /// What an effect leaves of the runs that it fits best, and its size there.
  struct Trimmed {
    Kept kept;
    double cost, amplitude;
  };

  void fly();
  void draw_effects();
  double most_gained(const Regression& alone) const;
  Trimmed trimmed(const Drawn& effect, std::map<Kept, Regression>& fits) const;
  std::vector<Suspicion> suspicions(double at_best) const;
  Hypothesis few(double near) const;
  Hypothesis common_lateness(const Regression& alone) const;
  Hypothesis own_line(FaultKind kind) const;
  std::optional<Fault> look_up(std::size_t i, Kept kept) const;

  /// With rows of 0 for the runs that are not kept.
  template <class Rows>
  Rows only(const Kept& kept, Rows values) const {
    for (std::size_t i = 0; i < runs_.size(); ++i)
      if (!kept[i]) values.middleRows(begin(i), rows(i)).setZero();
    return values;
  }
  /// The rig's parameters fitted to the runs that are kept.
  Regression regression(const Kept& kept) const {
    const Eigen::MatrixXd columns = only(kept, columns_);
    Regression result(only(kept, residuals_));
    for (Eigen::Index j = 0; j < columns.cols(); ++j) result.add(columns.col(j));
    return result;
  }
  /// Of a run's residuals, in floors.
  double mean_square(const Eigen::VectorXd& left, std::size_t i) const {
    return first_temperature * left.segment(begin(i), rows(i)).squaredNorm() / static_cast<double>(rows(i));
  }
  double worst(const Regression& fitted) const {
    double most = 0.0;
    for (std::size_t i = 0; i < runs_.size(); ++i) most = std::max(most, mean_square(fitted.left(), i));
    return most;
  }
  /// Contraction ratio as the regression counts it.
  Eigen::VectorXd weighted(const Eigen::VectorXd& ratio) const { return weight_ * ratio; }
  Eigen::VectorXd everywhere(std::size_t i, const Eigen::VectorXd& part) const {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(residuals_.size());
    column.segment(begin(i), rows(i)) = part;
    return column;
  }
  double count() const { return std::max(experiment_.floor().count, experiment_.floor().ratio); }
  bool worth_telling(FaultKind kind, double size) const {
    switch (kind) {
      case FaultKind::late:
      case FaultKind::rows_lost:
        return std::abs(size) >= least_ticks;
      case FaultKind::current_scale:
      case FaultKind::reading_scale:
        return std::abs(size) >= least_scale;
      case FaultKind::current_offset:
        return std::abs(size) >= least_mA;
      case FaultKind::drift:
        return std::abs(size) >= least_drift;
      default:
        return std::abs(size) >= 0.6 * count();
    }
  }

  const Experiment& experiment_;
  const Model& at_;
  const Runs& runs_;
  const std::vector<Candidate>& effects_;
  double weight_ = 1.0;               ///< of a contraction ratio
  std::vector<Eigen::Index> begins_;  ///< of each run's rows; one more for the end of the last
  Eigen::VectorXd residuals_;         ///< then a row for each prior
  Eigen::MatrixXd columns_;           ///< of the free parameters
  std::vector<Undisturbed> undisturbed_;
  std::vector<Drawn> drawn_;
};

void Examination::fly() {
  weight_ = 1.0 / (experiment_.floor().ratio * std::sqrt(first_temperature));
  const auto fitted = experiment_.slopes(at_.rig, at_.free, runs_);
  const auto driven = experiment_.slopes(at_.rig, currents_in_error(), runs_);
  const auto parts = experiment_.parts(runs_);
  begins_ = {0};
  for (const auto& part : parts) begins_.push_back(begins_.back() + part.rows);
  const auto free = static_cast<Eigen::Index>(at_.free.size());
  residuals_.setZero(begins_.back() + free);
  columns_.setZero(begins_.back() + free, free);
  const double scale = experiment_.floor().ratio, to_weighted = scale * weight_;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& part = parts[i];
    const auto of_run = [&](const auto& rows) { return rows.middleRows(part.begin, part.rows); };
    residuals_.segment(begin(i), rows(i)) = to_weighted * of_run(fitted.residuals);
    columns_.middleRows(begin(i), rows(i)) = to_weighted * of_run(fitted.columns);
    const auto& measured = experiment_.data().runs[part.run].contraction_ratio;
    const Eigen::Map<const Eigen::VectorXd> shown(measured.data(), part.rows);
    undisturbed_.push_back({shown - scale * of_run(fitted.residuals), scale * of_run(driven.columns).col(0),
                            scale * of_run(driven.columns).col(1)});
  }
  for (Eigen::Index j = 0; j < free; ++j) {
    const Parameter& p = at_.free[static_cast<std::size_t>(j)];
    if (!p.has_prior) continue;
    residuals_[begins_.back() + j] = -p.scaled(value_of(at_.rig, p.path));
    columns_(begins_.back() + j, j) = 1.0;
  }
}

void Examination::draw_effects() {
  std::vector<Experiment::Change> changes;
  for (const Candidate& c : effects_) {
    if (carries(at_.rig, c.effect)) continue;
    for (const double shape : c.shapes.empty() ? std::vector{0.0} : c.shapes) {
      changes.push_back({[&c, shape](Hanging& h) {
                           h.rig = c.chosen(h.rig);
                           if (!c.shape.empty()) *find(h.rig, c.shape).value = shape;
                           *find(h.rig, c.amplitude).value = c.absent + 0.5 * c.typical;
                         },
                         0.5 * c.typical, true});
      drawn_.push_back({&c, shape, Eigen::VectorXd::Zero(residuals_.size())});
    }
  }
  if (changes.empty()) return;
  const auto slopes = experiment_.slopes(at_.rig, changes, runs_);
  const auto parts = experiment_.parts(runs_);
  for (std::size_t c = 0; c < changes.size(); ++c)
    for (std::size_t i = 0; i < parts.size(); ++i)
      drawn_[c].column.segment(begin(i), rows(i)) =
          experiment_.floor().ratio * weight_ *
          slopes.columns.col(static_cast<Eigen::Index>(c)).segment(parts[i].begin, parts[i].rows);
}

/// What one effect of the catalogue takes off the misfit at best; all of nothing if there is none.
double Examination::most_gained(const Regression& alone) const {
  if (drawn_.empty()) return -infinite;
  double most = 0.0;
  for (const Drawn& effect : drawn_) {
    const auto [drop, amplitude] = alone.gain(effect.column, 0);
    if (effect.possible(amplitude)) most = std::max(most, drop);
  }
  return most;
}

/// As many runs as may be at fault are left out, each time the one without which least is left. `fits`: those
/// without an effect, which are the same for all.
Examination::Trimmed Examination::trimmed(const Drawn& effect, std::map<Kept, Regression>& fits) const {
  const auto left_of = [&](const Kept& kept) {
    auto fit = fits.find(kept);
    if (fit == fits.end()) fit = fits.emplace(kept, regression(kept)).first;
    const auto [drop, amplitude] = fit->second.gain(only(kept, effect.column), 0);
    return Trimmed{kept, fit->second.cost() - (effect.possible(amplitude) ? drop : 0.0), amplitude};
  };
  Trimmed best = left_of(Kept(runs_.size(), true));
  for (std::size_t odd = 0; odd < runs_.size() / (sound_for_one + 1); ++odd) {
    Trimmed least{.kept = {}, .cost = infinite, .amplitude = 0.0};
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!best.kept[i]) continue;
      Kept fewer = best.kept;
      fewer[i] = false;
      if (Trimmed left = left_of(fewer); left.cost < least.cost) least = std::move(left);
    }
    best = std::move(least);
  }
  return best;
}

/// Effects that leave far less, without a few runs, than `at_best` any leaves of all; each in its best shape.
std::vector<Suspicion> Examination::suspicions(double at_best) const {
  std::map<Kept, Regression> fits;
  std::vector<std::pair<Trimmed, const Drawn*>> list;
  for (const Drawn& effect : drawn_) {
    Trimmed left = trimmed(effect, fits);
    if (left.cost <= worth_suspecting * at_best && effect.possible(left.amplitude))
      list.emplace_back(std::move(left), &effect);
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.first.cost < b.first.cost; });
  std::set<const Candidate*> told;
  std::vector<Suspicion> best;
  for (const auto& [left, effect] : list) {
    const Candidate& c = *effect->candidate;
    if (!told.insert(&c).second) continue;
    Suspicion& suspicion = best.emplace_back(
        Suspicion{{.candidate = c, .amplitude = c.absent + left.amplitude, .shape = effect->shape}, {}});
    for (std::size_t i = 0; i < runs_.size(); ++i)
      if (left.kept[i]) suspicion.sound.push_back(runs_[i]);
  }
  return best;
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
    if (shape.row > 0) drop *= for_choice;
    if (shape.drawn_at != 0.0 && std::abs(amplitude - shape.drawn_at) > 0.25 + 0.3 * std::abs(shape.drawn_at))
      return;
    if (drop <= most || !worth_telling(shape.kind, amplitude)) return;
    most = drop;
    size = amplitude;
    best = shape;
  });
  Regression with = fitted;
  if (most > 0.0) with.add(everywhere(i, weighted(best.column)));
  const double before = mean_square(fitted.left(), i);
  if (mean_square(with.left(), i) <= std::max(sound, explained * before) && most > 0.0)
    return Fault{runs_[i], best.kind, size, best.row};
  if (before < of_another_rig) return std::nullopt;
  return Fault{runs_[i], FaultKind::another_rig};
}

/// A few runs of their own kind, the others near the floor without them: within `near` [mean square].
Hypothesis Examination::few(double near) const {
  Kept kept(runs_.size(), true);
  std::vector<std::size_t> odd;
  for (;;) {
    const Regression fitted = regression(kept);
    std::vector<std::pair<double, std::size_t>> worst;
    for (std::size_t i = 0; i < runs_.size(); ++i)
      if (kept[i]) worst.emplace_back(mean_square(fitted.left(), i), i);
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
    if (worst.size() <= least_sound || worst.size() - 1 < sound_for_one * (odd.size() + 1)) return {};
    double least = infinite;
    std::size_t oddest = 0;
    for (std::size_t tried = 0; tried < std::min(worst.size(), most_tried); ++tried) {
      Kept fewer = kept;
      fewer[worst[tried].second] = false;
      const double cost = regression(fewer).cost();
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
  for (const int ticks : {1, 2, 3, 4, 5, 6, -1, -2, -3, -4, -5, -6}) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(residuals_.size());
    for (std::size_t i = 0; i < runs_.size(); ++i)
      column.segment(begin(i), rows(i)) = weighted(lateness(undisturbed_[i].model, ticks));
    const double amplitude = alone.gain(column, 0).amplitude;
    if (std::abs(amplitude - ticks) > 0.5) continue;
    Regression with = alone;
    with.add(column);
    if (with.cost() >= best.cost) continue;
    best = {{}, with.cost()};
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      best.faults.push_back({runs_[i], FaultKind::late, std::round(amplitude), 0, true});
      if (mean_square(with.left(), i) > sound) best.cost = infinite;
    }
  }
  return best.cost < infinite ? best : Hypothesis{};
}

/// Each run with a zero, or a drift, of its own.
Hypothesis Examination::own_line(FaultKind kind) const {
  const auto all = static_cast<Eigen::Index>(runs_.size()), free = columns_.cols();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(columns_.rows(), free + all);
  columns.leftCols(free) = columns_;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    auto line = columns.col(free + static_cast<Eigen::Index>(i)).segment(begin(i), rows(i));
    line = weighted(kind == FaultKind::drift ? ramp(rows(i)) : Eigen::VectorXd::Ones(rows(i)));
  }
  const Eigen::VectorXd solved = columns.colPivHouseholderQr().solve(residuals_);
  const Eigen::VectorXd left = residuals_ - columns * solved;
  Hypothesis found{{}, left.squaredNorm()};
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (mean_square(left, i) > sound) return {};
    const double size = solved[free + static_cast<Eigen::Index>(i)];
    if (worth_telling(kind, size)) found.faults.push_back({runs_[i], kind, size});
  }
  const bool common = found.faults.size() == runs_.size() &&
                      std::all_of(found.faults.begin(), found.faults.end(), [&](const Fault& fault) {
                        return fault.size * found.faults.front().size > 0.0;
                      });
  for (Fault& fault : found.faults) fault.common = common;
  return found;
}

}  // namespace

Examined examine(const Experiment& experiment, const Model& at, const Runs& runs,
                 const std::vector<Candidate>& catalogue) {
  return Examination(experiment, at, runs, catalogue)();
}

}  // namespace mckibben::diagnose
