// Ceres runs the trust region; residuals and slopes come from batches of simulations. See the header.
#include <algorithm>
#include <cmath>
#include <exception>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <ceres/ceres.h>
#include <glog/logging.h>

#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/in_brief.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {
namespace {

class Misfit final : public ceres::CostFunction {
 public:
  Misfit(const Experiment& experiment, const Model& model, const Runs& runs, const FitSettings& settings,
         const KnownSlopes& known)
      : experiment_(experiment),
        model_(model),
        runs_(runs),
        inflation_(settings.inflation),
        thorough_(settings.thorough),
        known_(known) {
    const auto columns = static_cast<Eigen::Index>(1 + model.free.size());
    for (const std::size_t run : runs) {
      const auto of_run = static_cast<Eigen::Index>(experiment.rows(run));
      rows_ += of_run;
      brief_rows_ += std::min(of_run, columns);
    }
    for (const Parameter& p : model.free) priors_ += p.has_prior ? 1 : 0;
    set_num_residuals(static_cast<int>(brief_rows_ + priors_));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.free.size()));
    for (std::size_t j = 0; j < model.free.size(); ++j)
      if (known_slope(model.free[j]) == nullptr) fresh_.push_back(model.free[j]);
  }

  Experiment::Slopes slopes(const Rig& rig) const {
    auto fresh =
        thorough_ ? experiment_.fine_slopes(rig, fresh_, runs_) : experiment_.slopes(rig, fresh_, runs_);
    Eigen::MatrixXd columns(rows_, static_cast<Eigen::Index>(model_.free.size()));
    Eigen::Index next = 0;
    for (std::size_t j = 0; j < model_.free.size(); ++j) {
      const auto* known = known_slope(model_.free[j]);
      if (known != nullptr)
        columns.col(static_cast<Eigen::Index>(j)) = *known;
      else
        columns.col(static_cast<Eigen::Index>(j)) = fresh.columns.col(next++);
    }
    return {std::move(fresh.residuals), std::move(columns)};
  }

  /// Ceres gets the rows of each run in brief. Slopes always come along, at little cost beside the rig
  /// itself: it asks for those of a step that it takes, right after.
  bool Evaluate(double const* const* values, double* residuals, double** jacobians) const override {
    if (thrown_) return false;
    const double weight = 1.0 / std::sqrt(inflation_);
    try {
      const Eigen::MatrixXd& at = brief_at(values[0]);
      const Eigen::Index columns = at.cols() - 1;
      Eigen::Map<Eigen::VectorXd> r(residuals, brief_rows_ + priors_);
      r.head(brief_rows_) = weight * at.col(0);
      Eigen::Index row = brief_rows_;
      for (Eigen::Index c = 0; c < columns; ++c)
        if (model_.free[static_cast<std::size_t>(c)].has_prior) r[row++] = values[0][c];
      if (jacobians == nullptr || jacobians[0] == nullptr) return r.allFinite();
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(
          jacobians[0], brief_rows_ + priors_, columns);
      j.setZero();
      j.topRows(brief_rows_) = -weight * at.rightCols(columns);
      row = brief_rows_;
      for (Eigen::Index c = 0; c < columns; ++c)
        if (model_.free[static_cast<std::size_t>(c)].has_prior) j(row++, c) = 1.0;
      return r.allFinite();
    } catch (const engine::NumericalFailure&) {
      return false;  // a step too far: Ceres tries a shorter one
    } catch (...) {
      thrown_ = std::current_exception();  // not through Ceres; it gives up after a few refusals
      return false;
    }
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  /// Residuals, then slopes.
  const Eigen::MatrixXd& brief_at(const double* values) const {
    const std::vector<double> wanted(values, values + model_.free.size());
    if (wanted == last_values_) return last_;
    last_values_.clear();
    const auto at = slopes(rig_at(model_, values));
    last_.resize(brief_rows_, 1 + at.columns.cols());
    Eigen::Index from = 0, to = 0;
    for (const std::size_t run : runs_) {
      const auto rows = static_cast<Eigen::Index>(experiment_.rows(run));
      Eigen::MatrixXd whole(rows, last_.cols());
      whole << at.residuals.segment(from, rows), at.columns.middleRows(from, rows);
      const Eigen::MatrixXd brief = in_brief(std::move(whole));
      last_.middleRows(to, brief.rows()) = brief;
      from += rows;
      to += brief.rows();
    }
    last_values_ = wanted;
    return last_;
  }

  const Eigen::VectorXd* known_slope(const Parameter& p) const {
    for (const auto& [path, column] : known_)
      if (path == p.path) return &column;
    return nullptr;
  }

  const Experiment& experiment_;
  const Model& model_;
  const Runs& runs_;
  double inflation_;
  bool thorough_;
  const KnownSlopes& known_;
  Eigen::Index rows_ = 0, brief_rows_ = 0, priors_ = 0;
  std::vector<Parameter> fresh_;
  mutable std::vector<double> last_values_;
  mutable Eigen::MatrixXd last_;  // at these
  mutable std::exception_ptr thrown_;
};

/// Residuals and priors: sum of squares / inflation + deviations^2.
double cost_of(const Fitted& fitted, double inflation) {
  double cost = fitted.residuals.squaredNorm() / inflation;
  for (const Parameter& p : fitted.model.free) {
    const double deviations = p.has_prior ? p.scaled(value_of(fitted.model.rig, p.path)) : 0.0;
    cost += deviations * deviations;
  }
  return cost;
}

/// "Converged" would be the wrong word for what never had a reason to move.
void refuse_without_influence(Fitted& fitted) {
  std::vector<Parameter> free;
  std::vector<Eigen::Index> kept;
  for (std::size_t j = 0; j < fitted.model.free.size(); ++j) {
    Parameter& p = fitted.model.free[j];
    const auto column = static_cast<Eigen::Index>(j);
    if (fitted.columns.col(column).squaredNorm() < thresholds.fit.least_influence) {
      fitted.model.refused.push_back(p.path);
    } else {
      kept.push_back(column);
      free.push_back(std::move(p));
    }
  }
  fitted.model.free = std::move(free);
  fitted.columns = Eigen::MatrixXd(fitted.columns(Eigen::all, kept));
}

/// Numbers at a bound beyond which the misfit would fall: they stay there while the others move (Bertsekas,
/// SIAM J. Control Optim. 20 (1982) 221-246). A step that is cut off at a bound is none of least squares.
std::vector<int> held_at_bounds(const Fitted& fitted, double inflation) {
  std::vector<int> held;
  for (Eigen::Index j = 0; j < fitted.columns.cols(); ++j) {
    const Parameter& p = fitted.model.free[static_cast<std::size_t>(j)];
    const double value = value_of(fitted.model.rig, p.path), at = p.scaled(value);
    const double near = thresholds.screen.at_bound * (p.highest - p.lowest);
    const double falls = fitted.columns.col(j).dot(fitted.residuals) / inflation - (p.has_prior ? at : 0.0);
    if ((value < p.lowest + near && falls < 0.0) || (value > p.highest - near && falls > 0.0))
      held.push_back(static_cast<int>(j));
  }
  return held;
}

/// What a prior says of each number: of one without, next to nothing.
Eigen::VectorXd priors_of(const Model& model) {
  Eigen::VectorXd priors(static_cast<Eigen::Index>(model.free.size()));
  for (Eigen::Index j = 0; j < priors.size(); ++j)
    priors[j] = model.free[static_cast<std::size_t>(j)].has_prior ? 1.0 : thresholds.screen.ridge;
  return priors;
}

/// Half the second derivatives of the cost by scaled values, if the slopes held all the way.
Eigen::MatrixXd normal_of(const Fitted& fitted, double inflation) {
  Eigen::MatrixXd normal = fitted.columns.transpose() * fitted.columns / inflation;
  normal.diagonal() += priors_of(fitted.model);
  return normal;
}

/// Where straight lines along a fit's slopes lead, in scaled values; numbers that are held stay.
struct Lines {
  Eigen::VectorXd step;
  double least = 0.0;  ///< cost at the end of the step

  Lines(const Fitted& fitted, double inflation, const std::vector<int>& held = {}) {
    const Eigen::VectorXd priors = priors_of(fitted.model);
    Eigen::VectorXd moved = scaled_values(fitted.model);
    for (Eigen::Index j = 0; j < moved.size(); ++j)
      if (!fitted.model.free[static_cast<std::size_t>(j)].has_prior) moved[j] = 0.0;
    Eigen::MatrixXd normal = normal_of(fitted, inflation);
    Eigen::VectorXd downhill =
        fitted.columns.transpose() * fitted.residuals / inflation - priors.cwiseProduct(moved);
    for (const int j : held) {
      normal.row(j).setZero();
      normal(j, j) = 1.0;
      downhill[j] = 0.0;
    }
    step = normal.partialPivLu().solve(downhill);
    least = (fitted.residuals - fitted.columns * step).squaredNorm() / inflation +
            (moved + step).cwiseAbs2().dot(priors);
  }
};

/// Moves the rig of `fitted` to the least misfit along these slopes. The reason why not, if it cannot.
std::string descend(Misfit& misfit, Fitted& fitted, double inflation, bool thorough) {
  Model& model = fitted.model;
  Eigen::VectorXd values = scaled_values(model);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&misfit, nullptr, values.data());
  for (std::size_t j = 0; j < model.free.size(); ++j) {
    const Parameter& p = model.free[j];
    problem.SetParameterLowerBound(values.data(), static_cast<int>(j), p.scaled(p.lowest));
    problem.SetParameterUpperBound(values.data(), static_cast<int>(j), p.scaled(p.highest));
  }
  const auto held = held_at_bounds(fitted, inflation);
  if (held.size() == model.free.size()) return {};
  if (!held.empty())
    problem.SetManifold(values.data(), new ceres::SubsetManifold(static_cast<int>(model.free.size()), held));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = thresholds.fit.iterations;
  // Steps are projected onto the bounds; a line search along them would need all slopes at each trial.
  options.max_num_line_search_step_size_iterations = 0;
  options.function_tolerance =
      thorough ? thresholds.fit.thorough_cost_tolerance : thresholds.fit.cost_tolerance;
  options.parameter_tolerance =
      thorough ? thresholds.fit.thorough_parameter_tolerance : thresholds.fit.parameter_tolerance;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;                 // the simulations have their own
  FLAGS_minloglevel = google::GLOG_FATAL;  // a refused step is no news
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  misfit.rethrow();
  if (!summary.IsSolutionUsable()) return summary.message;
  model.rig = rig_at(model, values.data());
  for (const Parameter& p : model.free)
    if (p.period > 0.0) p.put(model.rig, std::remainder(value_of(model.rig, p.path), p.period));
  return {};
}

/// Slopes anew, along the axes of the valley that a fit has ended in, over about as far as each is known.
/// Where numbers all but make up for each other the difference that one of them makes must be right to a
/// thousandth to say anything of the way along the valley; it is not where loads stick or a play is used up.
void take_slopes_along_axes(const Experiment& experiment, Fitted& fitted, const Runs& runs,
                            double inflation) {
  const auto& by = thresholds.fit;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(normal_of(fitted, inflation));
  const Eigen::VectorXd at = scaled_values(fitted.model);
  const Eigen::Index count = at.size();
  std::vector<Experiment::Change> changes;
  Eigen::MatrixXd moved(count, count);
  const auto go = [&](Eigen::Index axis, double way) {
    Model there = fitted.model;
    there.rig = rig_at(fitted.model, Eigen::VectorXd(at + way * axes.eigenvectors().col(axis)).data());
    changes.push_back({[rig = there.rig](Loaded& h) { h.rig = rig; }, 1.0});
    return scaled_values(there);
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    const double way = std::min(by.along_axes / std::sqrt(axes.eigenvalues()[i]), by.most_along_axes);
    moved.col(i) = go(i, way);
    moved.col(i) -= go(i, -way);  // less at a bound
  }
  auto sides = experiment.slopes(fitted.model.rig, changes, runs);
  Eigen::MatrixXd differences(sides.columns.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i)
    differences.col(i) = sides.columns.col(2 * i) - sides.columns.col(2 * i + 1);
  fitted.columns = differences * moved.inverse();
  fitted.residuals = std::move(sides.residuals);
  fitted.cost = cost_of(fitted, inflation);
}

/// Goes on from where a descent ended, as long as slopes along the axes promise something and it comes true.
void follow_axes(const Experiment& experiment, Fitted& fitted, const Runs& runs, double inflation) {
  const auto& by = thresholds.fit;
  for (int round = 0; round <= by.axes_rounds; ++round) {
    take_slopes_along_axes(experiment, fitted, runs, inflation);
    const Lines lines(fitted, inflation, held_at_bounds(fitted, inflation));
    if (round == by.axes_rounds || fitted.cost - lines.least < by.worth_axes) return;
    Fitted next = fitted;
    for (double share = 1.0; !(next.cost < fitted.cost); share *= 0.5) {
      if (share < by.least_share) return;
      const Eigen::VectorXd aim = scaled_values(fitted.model) + share * lines.step;
      next.model.rig = rig_at(fitted.model, aim.data());
      next.residuals = experiment.residuals(next.model.rig, runs);
      next.cost = cost_of(next, inflation);
    }
    fitted = std::move(next);
  }
}

}  // namespace

Eigen::VectorXd scaled_values(const Model& model) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(model.free.size()));
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const Parameter& p = model.free[static_cast<std::size_t>(j)];
    values[j] = p.scaled(value_of(model.rig, p.path));
  }
  return values;
}

Rig rig_at(const Model& model, const double* scaled) {
  Rig rig = model.rig;
  for (std::size_t j = 0; j < model.free.size(); ++j) {
    const Parameter& p = model.free[j];
    p.put(rig, std::clamp(p.unscaled(scaled[j]), p.lowest, p.highest));
  }
  return rig;
}

double least_by_lines(const Fitted& fitted, double inflation) {
  return Lines(fitted, inflation).least;
}

bool out_of_reach(double aim, const Fitted& fitted, double inflation) {
  const double missing = std::max(0.0, fitted.cost - aim);
  return least_by_lines(fitted, inflation) > aim + thresholds.near.clear + thresholds.fit.hopeless * missing;
}

KnownSlopes slopes_of_nominal(const Fitted& fitted) {
  KnownSlopes list;
  for (std::size_t j = 0; j < fitted.model.free.size(); ++j)
    if (fitted.model.free[j].has_prior && !fitted.model.free[j].of_effect())
      list.emplace_back(fitted.model.free[j].path, fitted.columns.col(static_cast<Eigen::Index>(j)));
  return list;
}

Fitted fit(const Experiment& experiment, Model start, const Runs& runs, const FitSettings& settings) {
  Fitted result;
  result.model = std::move(start);
  // Whether the rig can be simulated, a little changed too.
  const auto look = [&](const KnownSlopes& known) {
    try {
      auto at = Misfit(experiment, result.model, runs, settings, known).slopes(result.model.rig);
      result.residuals = std::move(at.residuals);
      result.columns = std::move(at.columns);
      result.cost = cost_of(result, settings.inflation);
    } catch (const engine::NumericalFailure& failure) {
      result.failure = failure.what();
    }
    return result.failure.empty();
  };
  const bool rough = settings.known != nullptr;
  const KnownSlopes none;
  if (!rough) {
    if (!look(none)) return result;
    refuse_without_influence(result);
  }
  const int rounds = rough ? 1 : settings.thorough ? thresholds.fit.thorough_rounds : thresholds.fit.rounds;
  const double coarseness = settings.thorough ? 0.0 : thresholds.fit.coarseness;
  const auto enough = [&] { return thresholds.fit.least_descent * (1.0 + coarseness * result.cost); };
  // Costs of many runs differ by more than that from one simulation to the next: slopes are heard first.
  const auto has_arrived = [&] {
    return settings.thorough && result.cost - least_by_lines(result, settings.inflation) < enough();
  };
  // One that still falls fast has far to go: its numbers are far from where it began.
  bool falls = false;
  const auto goes_on = [&](int round) {
    return round < rounds || (falls && round < thresholds.fit.thorough_rounds);
  };
  for (int round = 0; goes_on(round) && !result.model.free.empty() && !has_arrived(); ++round) {
    const KnownSlopes known = rough ? *settings.known : slopes_of_nominal(result);
    const double before = result.cost;
    Misfit misfit(experiment, result.model, runs, settings, known);
    result.failure = descend(misfit, result, settings.inflation, settings.thorough);
    if (!result.failure.empty() || !look(rough ? known : none)) return result;
    if (before - result.cost < enough()) break;
    falls = !rough && before - result.cost > thresholds.fit.falls * before;
  }
  if (settings.thorough && result.failure.empty() && !result.model.free.empty()) {
    try {
      follow_axes(experiment, result, runs, settings.inflation);
    } catch (const engine::NumericalFailure&) {  // too far along an axis: the fit stays where it is
    }
  }
  return result;
}

}  // namespace mckibben::diagnose
