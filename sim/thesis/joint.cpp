// See the header. A cell's samples enter only through the triangle of their QR decomposition, six rows that
// hold all that least squares can see of them.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <nlopt.hpp>

#include <sim/thesis/pressure.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr Index rows_of_cell = 6;  // four parts, the slope against the exponent, the data
constexpr Index slope_column = 4, data_column = 5;

class Joint {
 public:
  Joint(const Shape& shape, const std::vector<Cell>& cells) : shape_(shape), cells_(cells) {
    lightest_ = std::min_element(cells.begin(), cells.end(), by_load)->load_kg;
    heaviest_ = std::max_element(cells.begin(), cells.end(), by_load)->load_kg;
    for (const Curve& curve : shape.curves)
      if (curve.part == exponent)
        exponent_order_ = curve.load_order;
      else
        columns_ += curve.load_order + 1;
    for (const Cell& cell : cells) samples_ += static_cast<Index>(cell.samples.size());
  }

  /// Logarithms of the exponent at the lightest and, where it follows the load, at the heaviest load.
  double cost(const std::vector<double>& logarithms) {
    set(logarithms);
    return fit_linear(basis(), data()).residuals.squaredNorm();
  }

  JointFit solve(const std::vector<double>& logarithms) {
    set(logarithms);
    const MatrixXd parts = basis();
    const LinearFit fit = fit_linear(parts, data());
    MatrixXd all(parts.rows(), columns_ + exponent_order_ + 1);
    all << parts, exponent_slopes(fit.values);
    const Geometry shape = geometry(all);
    const double spare = static_cast<double>(samples_ - all.cols());
    const double variance = fit.residuals.squaredNorm() / spare;
    const VectorXd errors = (variance * shape.inverse.diagonal()).cwiseSqrt();

    JointFit result;
    result.model.shape = shape_;
    Index next = 0;
    for (const Curve& curve : shape_.curves) {
      const bool is_exponent = curve.part == exponent;
      const Index first = is_exponent ? columns_ : next, n = curve.load_order + 1;
      const VectorXd values = is_exponent ? line_ : VectorXd(fit.values.segment(first, n));
      result.model.polynomials.push_back(values);
      std::vector<Estimate>& estimates = result.estimates.emplace_back();
      for (Index i = 0; i < n; ++i) {
        estimates.push_back({values(i), errors(first + i), shape.condition, {}});
        judge(estimates.back());
      }
      if (!is_exponent) next += n;
    }
    return result;
  }

  std::size_t searched() const { return exponent_order_ == 0 ? 1 : 2; }

 private:
  static bool by_load(const Cell& a, const Cell& b) { return a.load_kg < b.load_kg; }

  void set(const std::vector<double>& logarithms) {
    line_.resize(exponent_order_ + 1);
    if (exponent_order_ == 0) {
      line_ << std::exp(logarithms[0]);
    } else {
      const double low = std::exp(logarithms[0]), high = std::exp(logarithms[1]);
      const double slope = (high - low) / (heaviest_ - lightest_);
      line_ << slope, low - slope * lightest_;
    }
    triangles_.clear();
    for (const Cell& cell : cells_) {
      const VectorXd e = vector(cell.samples.contraction_ratio);
      MatrixXd columns(e.size(), rows_of_cell);
      columns.leftCols(linear_parts) = pressure_basis(e, polynomial(line_, cell.load_kg));
      columns.col(slope_column) = e.cwiseProduct(columns.col(exponential));
      columns.col(data_column) = vector(cell.samples.pressure_Pa);
      const Eigen::HouseholderQR<MatrixXd> qr(columns);
      triangles_.emplace_back(qr.matrixQR().topRows(rows_of_cell).triangularView<Eigen::Upper>());
    }
  }

  MatrixXd basis() const {
    MatrixXd all(rows_of_cell * static_cast<Index>(cells_.size()), columns_);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      Index column = 0;
      for (const Curve& curve : shape_.curves) {
        if (curve.part == exponent) continue;
        for (int power = curve.load_order; power >= 0; --power)
          rows(all, c).col(column++) = triangles_[c].col(static_cast<Index>(curve.part)) *
                                       std::pow(cells_[c].speed_mA_per_s, curve.power) *
                                       std::pow(cells_[c].load_kg, power);
      }
    }
    return all;
  }

  VectorXd data() const {
    MatrixXd all(rows_of_cell * static_cast<Index>(cells_.size()), 1);
    for (std::size_t c = 0; c < cells_.size(); ++c) rows(all, c) = triangles_[c].col(data_column);
    return all;
  }

  /// Against each coefficient of the exponent's polynomial in load.
  MatrixXd exponent_slopes(const VectorXd& values) const {
    MatrixXd all(rows_of_cell * static_cast<Index>(cells_.size()), exponent_order_ + 1);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      double amplitude = 0.0;
      Index column = 0;
      for (const Curve& curve : shape_.curves) {
        if (curve.part == exponent) continue;
        const VectorXd polynomial_in_load = values.segment(column, curve.load_order + 1);
        column += curve.load_order + 1;
        if (curve.part == exponential)
          amplitude += polynomial(polynomial_in_load, cells_[c].load_kg) *
                       std::pow(cells_[c].speed_mA_per_s, curve.power);
      }
      for (int power = exponent_order_; power >= 0; --power)
        rows(all, c).col(exponent_order_ - power) =
            triangles_[c].col(slope_column) * amplitude * std::pow(cells_[c].load_kg, power);
    }
    return all;
  }

  static Eigen::Block<MatrixXd> rows(MatrixXd& all, std::size_t cell) {
    return all.block(rows_of_cell * static_cast<Index>(cell), 0, rows_of_cell, all.cols());
  }

  const Shape& shape_;
  const std::vector<Cell>& cells_;
  double lightest_ = 0.0, heaviest_ = 0.0;
  int exponent_order_ = 0;
  Index columns_ = 0, samples_ = 0;
  VectorXd line_;
  std::vector<MatrixXd> triangles_;
};

double objective(const std::vector<double>& logarithms, std::vector<double>&, void* joint) {
  return static_cast<Joint*>(joint)->cost(logarithms);
}

}  // namespace

JointFit fit_jointly(const Shape& shape, const std::vector<Cell>& cells) {
  constexpr int scanned = 8;
  Joint joint(shape, cells);
  const double low = std::log(lowest_exponent), step = (std::log(highest_exponent) - low) / scanned;
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::vector<double>& point) {
    if (const double value = joint.cost(point); value < least) {
      least = value;
      best = point;
    }
  };
  for (int i = 0; i <= scanned; ++i)
    for (int j = 0; j <= scanned; ++j)
      if (joint.searched() == 2)
        look({low + i * step, low + j * step});
      else if (j == 0)
        look({low + i * step});

  nlopt::opt simplex(nlopt::LN_NELDERMEAD, static_cast<unsigned>(best.size()));
  simplex.set_min_objective(objective, &joint);
  simplex.set_lower_bounds(low);
  simplex.set_upper_bounds(std::log(highest_exponent));
  simplex.set_initial_step(0.5 * step);
  simplex.set_xtol_abs(1e-5);
  simplex.set_maxeval(400);
  try {
    simplex.optimize(best, least);
  } catch (const nlopt::roundoff_limited&) {
    // The best point met is in `best` all the same.
  }
  return joint.solve(best);
}

}  // namespace mckibben::thesis
