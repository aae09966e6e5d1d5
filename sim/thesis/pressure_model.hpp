// The shape of the thesis's pressure models, P = c0 + c1 e + c2 exp(c3 e) + c4 ln e (T 4.7 to 4.28): which
// coefficient follows the current's speed, and with what order each of its parts follows the load.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <controllers/calibration.hpp>
#include <sim/thesis/processing.hpp>

namespace mckibben::thesis {

/// The four parts that are linear in their coefficient, and the exponent.
enum Part : std::size_t { constant, line, exponential, logarithm, exponent };
inline constexpr std::size_t linear_parts = 4;

/// One polynomial in load: the factor of nu^power in the coefficient of one part.
struct Curve {
  std::string name;  ///< "a1_0" for the thesis's a_1^0
  std::string equation;
  std::string figure;  ///< where the thesis draws it
  Part part = constant;
  int power = 0;  ///< of the current's speed
  int load_order = 0;
};

/// Highest orders that are asked for; the thesis's own by default.
struct Orders {
  int speed = 2, load = 3;
};

struct Shape {
  std::array<int, linear_parts> speed_order{};
  std::vector<Curve> curves;  ///< in the order of the thesis's equations

  bool follows_speed(std::size_t part) const { return speed_order[part] > 0; }
};

Shape shape_of(Direction direction, const Orders& orders);

/// Columns 1, e, exp(c3 e), ln e.
Eigen::MatrixXd pressure_basis(const Eigen::VectorXd& contraction_ratio, double exponent);

/// A whole model: the polynomial of each curve, highest power of the load first.
struct PressureModel {
  Shape shape;
  std::vector<Eigen::VectorXd> polynomials;

  /// c0, c1, c2, c4.
  Eigen::Vector4d coefficients(double load_kg, double speed_mA_per_s) const;
  double exponent_at(double load_kg) const;
  Eigen::VectorXd pressure_Pa(const Eigen::VectorXd& contraction_ratio, double load_kg,
                              double speed_mA_per_s) const;
  /// The polynomial of that name; a zero if its order in speed was not asked for.
  controllers::InLoad in_load(const std::string& name) const;
};

controllers::ContractionModel contraction_model(const PressureModel& model);
controllers::RelaxationModel relaxation_model(const PressureModel& model);

}  // namespace mckibben::thesis
