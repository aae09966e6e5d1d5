// The models of T 4.4 to 4.28, fitted to samples made by the formulas: what was planted comes back.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/thesis/friction.hpp>
#include <sim/thesis/pressure.hpp>

#include "small_campaign.hpp"

namespace mckibben::thesis {
namespace {

const std::vector<double> loads{11.0, 14.0, 16.0, 19.0, 23.0};
const std::vector<double> speeds{5.6, 6.7, 8.3, 11.1, 16.7};

double no_pressure(double, double, double) {
  return 1e5;
}
double no_friction(double, double, double) {
  return 0.01;
}

TEST(FrictionFit, RecoversTheSuperposition) {
  const auto f = [](double e, double, double nu) {
    return 0.047 + 2e-5 * nu * nu - 0.14 * e + 0.0053 * std::log(e) + 1e-5 * std::sin(4e5 * e);
  };
  const FrictionFit fit =
      fit_friction(planted_grid(loads, speeds, no_pressure, f), Direction::contraction, 1);
  EXPECT_NEAR(fit.f0.value, 0.047, 1e-5);
  EXPECT_NEAR(fit.f1.value, 2e-5, 1e-7);
  EXPECT_NEAR(fit.f2.value, -0.14, 1e-4);
  EXPECT_NEAR(fit.f3.value, 0.0053, 1e-5);
  for (const Estimate* each : {&fit.f0, &fit.f1, &fit.f2, &fit.f3}) {
    EXPECT_TRUE(each->determined()) << each->why_not;
    EXPECT_GT(each->standard_error, 0.0);
  }
  EXPECT_LT(fit.spread(), 0.01);
}

TEST(FrictionFit, NoDependenceOnSpeedIsNotDetermined) {
  const auto f = [](double e, double, double nu) {
    return 0.047 - 0.14 * e + 0.0053 * std::log(e) + 1e-3 * std::sin(4e5 * e + nu);
  };
  const FrictionFit fit =
      fit_friction(planted_grid(loads, speeds, no_pressure, f), Direction::contraction, 1);
  EXPECT_FALSE(fit.f1.determined());
  EXPECT_TRUE(fit.f2.determined());
}

TEST(FrictionFit, ChiSquareAndPolynomialRecoverTheirOwn) {
  const auto chi = [](double e, double, double) {
    return 0.3 * chi_square(Eigen::VectorXd::Constant(1, e), 3.0)(0);
  };
  const auto of_chi = fit_friction(planted_grid(loads, speeds, no_pressure, chi), Direction::relaxation, 1);
  EXPECT_NEAR(of_chi.speeds[2].chi_square.parameter, 3.0, 1e-4);
  EXPECT_NEAR(of_chi.speeds[2].chi_square.linear.values(0), 0.3, 1e-4);

  const Eigen::VectorXd p{{0.02, 0.9, -14.0, 80.0, -220.0, 240.0}};
  const auto fifth = [&p](double e, double, double) {
    return fifth_order(Eigen::VectorXd::Constant(1, e), p)(0);
  };
  const auto of_fifth =
      fit_friction(planted_grid(loads, speeds, no_pressure, fifth), Direction::contraction, 1);
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(of_fifth.speeds[0].fifth_order.values(i), p(i), 1e-6 * std::abs(p(i)) + 1e-9);
  EXPECT_GT(of_fifth.speeds[0].fifth_order.condition, 100.0);
}

TEST(ChiSquare, IsTheDensityOfTwoDegreesAsWritten) {
  const Eigen::VectorXd e = Eigen::VectorXd::LinSpaced(5, 0.1, 0.3);
  EXPECT_TRUE(chi_square(e, 2.0).isApprox((0.5 * (-0.5 * e.array()).exp()).matrix(), 1e-12));
}

struct Planted {
  Direction direction;
  PressureModel model;

  explicit Planted(Direction d, std::vector<Eigen::VectorXd> polynomials) : direction(d) {
    model.shape = shape_of(d, {});
    model.polynomials = std::move(polynomials);
  }
  Grid grid(const std::vector<double>& at_loads = loads) const {
    return planted_grid(
        at_loads, speeds,
        [this](double e, double load, double nu) {
          return model.pressure_Pa(Eigen::VectorXd::Constant(1, e), load, nu)(0);
        },
        no_friction);
  }
};

Eigen::VectorXd in_load(std::initializer_list<double> coefficients) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(coefficients.size()));
  std::copy(coefficients.begin(), coefficients.end(), v.begin());
  return v;
}

const Planted planted_contraction(Direction::contraction,
                                  {in_load({2e3, 5e4}), in_load({1.0, -50.0, 800.0, 2e3}),
                                   in_load({-100.0, 3e4, -1e5}), in_load({0.5, -10.0, 100.0}),
                                   in_load({1.0, 20.0, 300.0}), in_load({-0.3, 25.0}),
                                   in_load({500.0, 4e3})});
const Planted planted_relaxation(Direction::relaxation,
                                 {in_load({100.0, 500.0}), in_load({3e3, 4e4}), in_load({1e4, 5e4}),
                                  in_load({20.0, 100.0}), in_load({-0.2, 24.0}), in_load({1.0, 10.0}),
                                  in_load({-20.0, 100.0}), in_load({300.0, 3e3})});

class PlantedPressure : public testing::TestWithParam<const Planted*> {};

TEST_P(PlantedPressure, ComesBackFromTheSequenceAndFromAllSamplesAtOnce) {
  const Planted& planted = *GetParam();
  const PressureFit fit = fit_pressure(planted.grid(), planted.direction, {});
  ASSERT_EQ(fit.joint.polynomials.size(), planted.model.polynomials.size());
  for (std::size_t curve = 0; curve < fit.shape.curves.size(); ++curve) {
    const auto& wanted = planted.model.polynomials[curve];
    for (Eigen::Index i = 0; i < wanted.size(); ++i) {
      const std::string where = fit.shape.curves[curve].name + "[" + std::to_string(i) + "]";
      EXPECT_NEAR(fit.joint.polynomials[curve](i), wanted(i), 1e-2 * std::abs(wanted(i))) << where;
    }
    for (const double load : loads) {  // the sequence's polynomials, where they are used
      const double value = polynomial(wanted, load);
      EXPECT_NEAR(polynomial(fit.sequence.polynomials[curve], load), value, 2e-2 * std::abs(value) + 1e-6)
          << fit.shape.curves[curve].name;
    }
  }
  EXPECT_LT(fit.deviation.joint, 1e-4 * fit.mean_Pa);
  EXPECT_LT(fit.deviation.own, 1e-4 * fit.mean_Pa);
  for (const auto& cell : fit.cells) {
    EXPECT_NEAR(cell.own.parameter, planted.model.exponent_at(cell.load_kg), 1e-2);
    EXPECT_GT(cell.own.linear.condition, 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, PlantedPressure, testing::Values(&planted_contraction, &planted_relaxation),
                         [](const auto& p) { return std::string(name_of(p.param->direction)); });

TEST(PressureFit, OrdersThatAreCappedLeaveSmallerPolynomials) {
  const PressureFit fit =
      fit_pressure(planted_contraction.grid({11.0, 23.0}), Direction::contraction, {.speed = 0, .load = 1});
  for (const Curve& curve : fit.shape.curves) {
    EXPECT_EQ(curve.power, 0);
    EXPECT_LE(curve.load_order, 1);
  }
  EXPECT_EQ(contraction_model(fit.joint).a1_0, controllers::InLoad{0.0});
  EXPECT_EQ(contraction_model(fit.joint).a1_1.size(), 2u);
}

TEST(PressureFit, OneLoadNeedsNoPolynomialInLoad) {
  const PressureFit fit =
      fit_pressure(planted_relaxation.grid({16.0}), Direction::relaxation, {.speed = 2, .load = 0});
  EXPECT_LT(fit.deviation.joint, 1e-4 * fit.mean_Pa);
  EXPECT_NEAR(fit.joint.exponent_at(16.0), planted_relaxation.model.exponent_at(16.0), 0.01);
}

TEST(PressureModel, IsTheSumThatTheThesisPrints) {
  const double e = 0.1, nu = 8.0, m = 15.0;
  const auto c = contraction_model(planted_contraction.model);
  const auto at = [m](const controllers::InLoad& p) {
    double value = 0.0;
    for (const double each : p) value = value * m + each;
    return value;
  };
  const double a1 = at(c.a1_0) * nu + at(c.a1_1), a2 = at(c.a2_0) * nu + at(c.a2_1);
  const double printed = at(c.a0) + a1 * e + a2 * std::exp(at(c.a3) * e) + at(c.a4) * std::log(e);
  EXPECT_NEAR(planted_contraction.model.pressure_Pa(Eigen::VectorXd::Constant(1, e), m, nu)(0), printed,
              1e-6);
}

}  // namespace
}  // namespace mckibben::thesis
