// See the header.
#include <cmath>

#include <sim/thesis/pressure.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

ProjectedFit fit_own(const Cell& cell) {
  const VectorXd e = vector(cell.samples.contraction_ratio);
  Separable model;
  model.basis = [&e](double exponent) { return pressure_basis(e, exponent); };
  model.slope = [&e](double exponent) {
    MatrixXd slope = MatrixXd::Zero(e.size(), linear_parts);
    slope.col(exponential) = e.array() * (exponent * e).array().exp();
    return slope;
  };
  model.lowest = lowest_exponent;
  model.highest = highest_exponent;
  return fit_separable(model, vector(cell.samples.pressure_Pa));
}

/// Coefficients with the steady ones as given and the others fitted.
Eigen::Vector4d refit(const Cell& cell, const Shape& shape, double exponent, Eigen::Vector4d values) {
  const MatrixXd basis = pressure_basis(vector(cell.samples.contraction_ratio), exponent);
  VectorXd rest = vector(cell.samples.pressure_Pa);
  MatrixXd open(basis.rows(), 0);
  for (std::size_t part = 0; part < linear_parts; ++part) {
    const auto column = static_cast<Index>(part);
    if (shape.follows_speed(part)) {
      open.conservativeResize(Eigen::NoChange, open.cols() + 1);
      open.rightCols(1) = basis.col(column);
    } else {
      rest -= basis.col(column) * values(column);
    }
  }
  if (open.cols() == 0) return values;
  const VectorXd fitted = fit_linear(open, rest).values;
  Index next = 0;
  for (std::size_t part = 0; part < linear_parts; ++part)
    if (shape.follows_speed(part)) values(static_cast<Index>(part)) = fitted(next++);
  return values;
}

double squares(const Cell& cell, double exponent, const Eigen::Vector4d& values) {
  const VectorXd model = pressure_basis(vector(cell.samples.contraction_ratio), exponent) * values;
  return (vector(cell.samples.pressure_Pa) - model).squaredNorm();
}

class Sequence {
 public:
  Sequence(const Grid& grid, Direction direction, const Orders& orders, PressureFit& fit)
      : cells_(grid.of(direction)), loads_(grid.loads_kg), fit_(fit) {
    fit_.shape = shape_of(direction, orders);
    fit_.at_load.assign(fit_.shape.curves.size(), VectorXd(static_cast<Index>(loads_.size())));
    fit_.speed_estimates.resize(fit_.shape.curves.size());
  }

  void operator()() {
    for (const Cell& cell : cells_) {
      PressureCell& out = fit_.cells.emplace_back();
      out.load_kg = cell.load_kg;
      out.speed_mA_per_s = cell.speed_mA_per_s;
      out.mean_Pa = vector(cell.samples.pressure_Pa).mean();
      out.own = fit_own(cell);
    }
    for (std::size_t load = 0; load < loads_.size(); ++load) at_load(load);
    in_load();
  }

 private:
  /// T 4.7 to 4.13 at one load.
  void at_load(std::size_t load) {
    std::vector<std::size_t> mine;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (cells_[c].load_kg == loads_[load]) mine.push_back(c);
    const auto mean = [&](const auto& value) {
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      for (const std::size_t c : mine) sum += value(c);
      return Eigen::Vector4d(sum / static_cast<double>(mine.size()));
    };
    const double exponent_mean = mean_exponent(mine);
    const Eigen::Vector4d at_once = mean([&](std::size_t c) { return fit_.cells[c].own.linear.values; });
    const Eigen::Vector4d steady = mean([&](std::size_t c) {
      const MatrixXd basis = pressure_basis(vector(cells_[c].samples.contraction_ratio), exponent_mean);
      return fit_linear(basis, vector(cells_[c].samples.pressure_Pa)).values;
    });
    for (const std::size_t c : mine) {
      PressureCell& out = fit_.cells[c];
      const Cell& cell = cells_[c];
      const auto deviation = [&](const Eigen::Vector4d& values, double exponent) {
        return std::sqrt(squares(cell, exponent, values) / static_cast<double>(cell.samples.size()));
      };
      out.deviation.own = deviation(out.own.linear.values, out.own.parameter);
      out.deviation.fixed_at_once = deviation(refit(cell, fit_.shape, exponent_mean, at_once), exponent_mean);
      out.refitted = refit(cell, fit_.shape, exponent_mean, steady);
      out.deviation.fixed = deviation(out.refitted, exponent_mean);
    }
    in_speed(load, mine, exponent_mean, steady);
  }

  /// Fits that ended at the end of the search range say nothing about the exponent and are left out.
  double mean_exponent(const std::vector<std::size_t>& mine) const {
    double sum = 0.0, count = 0.0, any = 0.0;
    for (const std::size_t c : mine) {
      const ProjectedFit& own = fit_.cells[c].own;
      any += own.parameter;
      if (own.at_bound) continue;
      sum += own.parameter;
      count += 1.0;
    }
    return count > 0.0 ? sum / count : any / static_cast<double>(mine.size());
  }

  void in_speed(std::size_t load, const std::vector<std::size_t>& mine, double exponent_mean,
                const Eigen::Vector4d& steady) {
    const auto at = static_cast<Index>(load), n = static_cast<Index>(mine.size());
    VectorXd speeds(n);
    for (Index i = 0; i < n; ++i) speeds(i) = cells_[mine[static_cast<std::size_t>(i)]].speed_mA_per_s;
    for (std::size_t curve = 0; curve < fit_.shape.curves.size(); ++curve) {
      const Curve& law = fit_.shape.curves[curve];
      double& value = fit_.at_load[curve](at);
      Estimate estimate;
      if (law.part == exponent) {
        value = exponent_mean;
      } else if (!fit_.shape.follows_speed(law.part)) {
        value = steady(static_cast<Index>(law.part));
      } else {
        VectorXd values(n);
        for (Index i = 0; i < n; ++i)
          values(i) = fit_.cells[mine[static_cast<std::size_t>(i)]].refitted(static_cast<Index>(law.part));
        const int order = fit_.shape.speed_order[law.part];
        estimate = fit_polynomial(speeds, values, order).estimate(order - law.power);
        value = estimate.value;
      }
      fit_.speed_estimates[curve].push_back(estimate);
    }
    for (const std::size_t c : mine) {
      Eigen::Vector4d values = Eigen::Vector4d::Zero();
      for (std::size_t curve = 0; curve < fit_.shape.curves.size(); ++curve)
        if (const Curve& law = fit_.shape.curves[curve]; law.part != exponent)
          values(static_cast<Index>(law.part)) +=
              fit_.at_load[curve](at) * std::pow(cells_[c].speed_mA_per_s, law.power);
      fit_.cells[c].deviation.in_speed = std::sqrt(squares(cells_[c], exponent_mean, values) /
                                                   static_cast<double>(cells_[c].samples.size()));
    }
  }

  /// T 4.14 to 4.28.
  void in_load() {
    fit_.sequence.shape = fit_.shape;
    for (std::size_t curve = 0; curve < fit_.shape.curves.size(); ++curve) {
      fit_.in_load.push_back(
          fit_polynomial(vector(loads_), fit_.at_load[curve], fit_.shape.curves[curve].load_order));
      fit_.sequence.polynomials.push_back(fit_.in_load.back().values);
    }
  }

  const std::vector<Cell>& cells_;
  const std::vector<double>& loads_;
  PressureFit& fit_;
};

double deviation_Pa(const Cell& cell, const PressureModel& model) {
  const VectorXd off =
      vector(cell.samples.pressure_Pa) -
      model.pressure_Pa(vector(cell.samples.contraction_ratio), cell.load_kg, cell.speed_mA_per_s);
  return std::sqrt(off.squaredNorm() / static_cast<double>(cell.samples.size()));
}

}  // namespace

PressureFit fit_pressure(const Grid& grid, Direction direction, const Orders& orders) {
  const std::vector<Cell>& cells = grid.of(direction);
  PressureFit fit;
  Sequence(grid, direction, orders, fit)();
  JointFit joint = fit_jointly(fit.shape, cells);
  fit.joint = std::move(joint.model);
  fit.joint_estimates = std::move(joint.estimates);

  double samples = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Stages& deviation = fit.cells[c].deviation;
    deviation.in_load = deviation_Pa(cells[c], fit.sequence);
    deviation.joint = deviation_Pa(cells[c], fit.joint);
    const auto n = static_cast<double>(cells[c].samples.size());
    samples += n;
    fit.mean_Pa += n * fit.cells[c].mean_Pa;
    for (const auto stage : {&Stages::own, &Stages::fixed_at_once, &Stages::fixed, &Stages::in_speed,
                             &Stages::in_load, &Stages::joint})
      fit.deviation.*stage += n * deviation.*stage * (deviation.*stage);
  }
  fit.mean_Pa /= samples;
  for (const auto stage : {&Stages::own, &Stages::fixed_at_once, &Stages::fixed, &Stages::in_speed,
                           &Stages::in_load, &Stages::joint})
    fit.deviation.*stage = std::sqrt(fit.deviation.*stage / samples);
  return fit;
}

}  // namespace mckibben::thesis
