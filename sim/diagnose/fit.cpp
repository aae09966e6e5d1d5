// Ceres runs the trust region; residuals and slopes come from flocks of simulations. See the header.
#include <algorithm>
#include <cmath>
#include <exception>

#include <ceres/ceres.h>

#include <sim/diagnose/fit.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {
namespace {

class Misfit final : public ceres::CostFunction {
 public:
  Misfit(const Experiment& experiment, const Model& model, const Runs& runs, const FitSettings& settings)
      : experiment_(experiment), model_(model), runs_(runs), settings_(settings) {
    for (const std::size_t run : runs) rows_ += static_cast<Eigen::Index>(experiment.rows(run));
    for (const Parameter& p : model.free) priors_ += p.has_prior ? 1 : 0;
    set_num_residuals(static_cast<int>(rows_ + priors_));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.free.size()));
    for (std::size_t j = 0; j < model.free.size(); ++j)
      if (frozen(model.free[j]) == nullptr) fresh_.push_back(model.free[j]);
  }

  plant::Rig rig_at(const double* values) const {
    plant::Rig rig = model_.rig;
    for (std::size_t j = 0; j < model_.free.size(); ++j) {
      const Parameter& p = model_.free[j];
      *find(rig, p.path).value = std::clamp(p.unscaled(values[j]), p.lowest, p.highest);
    }
    return rig;
  }

  Experiment::Slopes slopes(const plant::Rig& rig) const {
    auto fresh = experiment_.slopes(rig, fresh_, runs_);
    Eigen::MatrixXd columns(rows_, static_cast<Eigen::Index>(model_.free.size()));
    Eigen::Index next = 0;
    for (std::size_t j = 0; j < model_.free.size(); ++j) {
      const auto* known = frozen(model_.free[j]);
      if (known != nullptr)
        columns.col(static_cast<Eigen::Index>(j)) = *known;
      else
        columns.col(static_cast<Eigen::Index>(j)) = fresh.columns.col(next++);
    }
    return {std::move(fresh.residuals), std::move(columns)};
  }

  bool Evaluate(double const* const* values, double* residuals, double** jacobians) const override {
    if (thrown_) return false;
    const double weight = 1.0 / std::sqrt(settings_.temperature);
    const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
    try {
      const plant::Rig rig = rig_at(values[0]);
      const auto columns = static_cast<Eigen::Index>(model_.free.size());
      Eigen::Map<Eigen::VectorXd> r(residuals, rows_ + priors_);
      if (wanted) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(
            jacobians[0], rows_ + priors_, columns);
        const auto at = slopes(rig);
        r.head(rows_) = weight * at.residuals;
        j.setZero();
        j.topRows(rows_) = -weight * at.columns;
        Eigen::Index row = rows_;
        for (Eigen::Index c = 0; c < columns; ++c)
          if (model_.free[static_cast<std::size_t>(c)].has_prior) j(row++, c) = 1.0;
      } else {
        r.head(rows_) = weight * experiment_.residuals(rig, runs_);
      }
      Eigen::Index row = rows_;
      for (Eigen::Index c = 0; c < columns; ++c)
        if (model_.free[static_cast<std::size_t>(c)].has_prior) r[row++] = values[0][c];
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
  const Eigen::VectorXd* frozen(const Parameter& p) const {
    if (settings_.frozen == nullptr) return nullptr;
    for (const auto& [path, column] : *settings_.frozen)
      if (path == p.path) return &column;
    return nullptr;
  }

  const Experiment& experiment_;
  const Model& model_;
  const Runs& runs_;
  const FitSettings& settings_;
  Eigen::Index rows_ = 0, priors_ = 0;
  std::vector<Parameter> fresh_;
  mutable std::exception_ptr thrown_;
};

}  // namespace

Fitted fit(const Experiment& experiment, Model start, const Runs& runs, const FitSettings& settings) {
  Fitted result;
  result.model = std::move(start);
  Model& model = result.model;
  Misfit misfit(experiment, model, runs, settings);
  std::vector<double> values;
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  for (const Parameter& p : model.free) values.push_back(p.scaled(value_of(model.rig, p.path)));
  if (!values.empty()) {
    problem.AddResidualBlock(&misfit, nullptr, values.data());
    for (std::size_t j = 0; j < values.size(); ++j) {
      const Parameter& p = model.free[j];
      problem.SetParameterLowerBound(values.data(), static_cast<int>(j), p.scaled(p.lowest));
      problem.SetParameterUpperBound(values.data(), static_cast<int>(j), p.scaled(p.highest));
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = settings.most_iterations;
    options.function_tolerance = 1e-4;
    options.parameter_tolerance = 1e-5;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // the simulations have their own
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    misfit.rethrow();
    if (!summary.IsSolutionUsable()) {
      result.failure = summary.message;
      return result;
    }
    result.converged = summary.termination_type == ceres::CONVERGENCE;
    model.rig = misfit.rig_at(values.data());
  }
  auto at = misfit.slopes(model.rig);
  result.residuals = std::move(at.residuals);
  result.columns = std::move(at.columns);
  result.cost = result.residuals.squaredNorm() / settings.temperature;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (model.free[j].has_prior) result.cost += values[j] * values[j];
    if (result.columns.col(static_cast<Eigen::Index>(j)).squaredNorm() < 1e-12)
      result.without_influence.push_back(model.free[j].path);
  }
  return result;
}

}  // namespace mckibben::diagnose
