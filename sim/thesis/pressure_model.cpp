// See the header.
#include <algorithm>
#include <cmath>

#include <sim/thesis/least_squares.hpp>
#include <sim/thesis/pressure_model.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::VectorXd;

struct Law {
  Part part;
  int power;
  int load_order;
  const char *name, *equation, *figure;
};

constexpr Law contraction_laws[] = {
    {constant, 0, 1, "a0", "4.14", "4.35"},      {line, 1, 3, "a1_0", "4.15", "4.36"},
    {line, 0, 2, "a1_1", "4.16", "4.37"},        {exponential, 1, 2, "a2_0", "4.17", "4.38"},
    {exponential, 0, 2, "a2_1", "4.18", "4.39"}, {exponent, 0, 1, "a3", "4.19", "4.40"},
    {logarithm, 0, 1, "a4", "4.20", "4.41"}};
constexpr Law relaxation_laws[] = {
    {constant, 1, 1, "b0_0", "4.21", "4.42"},  {constant, 0, 1, "b0_1", "4.22", "4.43"},
    {line, 0, 1, "b1", "4.23", "4.44"},        {exponential, 0, 1, "b2", "4.24", "4.45"},
    {exponent, 0, 1, "b3", "4.25", "4.46"},    {logarithm, 2, 1, "b4_0", "4.26", "4.47"},
    {logarithm, 1, 1, "b4_1", "4.27", "4.48"}, {logarithm, 0, 1, "b4_2", "4.28", "4.49"}};

}  // namespace

Shape shape_of(Direction direction, const Orders& orders) {
  Shape shape;
  const auto add = [&](const Law& law) {
    if (law.power > orders.speed) return;
    shape.curves.push_back(
        {law.name, law.equation, law.figure, law.part, law.power, std::min(law.load_order, orders.load)});
    if (law.part != exponent) shape.speed_order[law.part] = std::max(shape.speed_order[law.part], law.power);
  };
  if (direction == Direction::contraction)
    std::for_each(std::begin(contraction_laws), std::end(contraction_laws), add);
  else
    std::for_each(std::begin(relaxation_laws), std::end(relaxation_laws), add);
  return shape;
}

Eigen::MatrixXd pressure_basis(const VectorXd& e, double exponent) {
  Eigen::MatrixXd basis(e.size(), linear_parts);
  basis << VectorXd::Ones(e.size()), e, (exponent * e).array().exp().matrix(), e.array().log().matrix();
  return basis;
}

Eigen::Vector4d PressureModel::coefficients(double load_kg, double speed_mA_per_s) const {
  Eigen::Vector4d values = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < polynomials.size(); ++i)
    if (const Curve& curve = shape.curves[i]; curve.part != exponent)
      values(static_cast<Eigen::Index>(curve.part)) +=
          polynomial(polynomials[i], load_kg) * std::pow(speed_mA_per_s, curve.power);
  return values;
}

double PressureModel::exponent_at(double load_kg) const {
  for (std::size_t i = 0; i < polynomials.size(); ++i)
    if (shape.curves[i].part == exponent) return polynomial(polynomials[i], load_kg);
  return 0.0;
}

VectorXd PressureModel::pressure_Pa(const VectorXd& contraction_ratio, double load_kg,
                                    double speed_mA_per_s) const {
  return pressure_basis(contraction_ratio, exponent_at(load_kg)) * coefficients(load_kg, speed_mA_per_s);
}

controllers::InLoad PressureModel::in_load(const std::string& name) const {
  for (std::size_t i = 0; i < polynomials.size(); ++i)
    if (shape.curves[i].name == name) return {polynomials[i].begin(), polynomials[i].end()};
  return {0.0};
}

controllers::ContractionModel contraction_model(const PressureModel& model) {
  return {model.in_load("a0"),   model.in_load("a1_0"), model.in_load("a1_1"), model.in_load("a2_0"),
          model.in_load("a2_1"), model.in_load("a3"),   model.in_load("a4")};
}

controllers::RelaxationModel relaxation_model(const PressureModel& model) {
  return {model.in_load("b0_0"), model.in_load("b0_1"), model.in_load("b1"),   model.in_load("b2"),
          model.in_load("b3"),   model.in_load("b4_0"), model.in_load("b4_1"), model.in_load("b4_2")};
}

}  // namespace mckibben::thesis
