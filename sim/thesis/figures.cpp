// The friction figures are those of contraction, as the thesis's captions of 4.20 to 4.25 say, except 4.26.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/thesis/figures.hpp>
#include <sim/thesis/pressure_figures.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::Index, Eigen::VectorXd;

constexpr double shown_speeds_mA_per_s[] = {5.6, 6.7, 8.3, 11.1, 16.7};  // T figures 4.2 to 4.25
constexpr const char* coefficient = "friction_coefficient";

const FrictionAtSpeed& nearest(const FrictionFit& fit, double wanted) {
  return *std::min_element(fit.speeds.begin(), fit.speeds.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.speed_mA_per_s - wanted) < std::abs(b.speed_mA_per_s - wanted);
  });
}

VectorXd superposed(const FrictionFit& fit, const VectorXd& e, double nu) {
  return (fit.f0.value + fit.f1.value * nu * nu + fit.f2.value * e.array() + fit.f3.value * e.array().log())
      .matrix();
}

/// Data as dots, the model as a line through the same contraction ratios.
Figure against_ratio(std::string number, const std::string& name, const FrictionAtSpeed& at,
                     const auto& model) {
  const Samples shown = thinned(at.samples);
  Figure figure{std::move(number), fmt::format("{}, contraction, {:.1f} mA/s", name, at.speed_mA_per_s),
                "contraction ratio", "coefficient of friction"};
  figure.columns = {{ratio_column, shown.contraction_ratio},
                    {coefficient, shown.coefficient},
                    {"model", list(model(vector(shown.contraction_ratio)))}};
  figure.curves = {{"data", 0, 1, true}, {"model", 0, 2}};
  return figure;
}

void per_speed(const FrictionFit& fit, std::vector<Figure>& all) {
  int number = 2;
  const auto next = [&number] { return fmt::format("4.{}", number++); };
  for (const double wanted : shown_speeds_mA_per_s) {
    const FrictionAtSpeed& at = nearest(fit, wanted);
    all.push_back(against_ratio(next(), "Chi-square (T 4.4)", at, [&](const VectorXd& e) {
      return VectorXd(at.chi_square.linear.values(0) * chi_square(e, at.chi_square.parameter));
    }));
  }
  for (const double wanted : shown_speeds_mA_per_s) {
    const FrictionAtSpeed& at = nearest(fit, wanted);
    all.push_back(against_ratio(next(), "Fifth-order polynomial (T 4.5)", at,
                                [&](const VectorXd& e) { return fifth_order(e, at.fifth_order.values); }));
  }
  for (Index i = 0; i < 6; ++i) {
    Figure figure{next(), fmt::format("Coefficient p{} of the fifth-order polynomial (T 4.5)", i),
                  "current speed [mA/s]", fmt::format("p{}", i)};
    figure.columns = {{speed_column, {}}, {fmt::format("p{}", i), {}}, {"standard_error", {}}};
    for (const auto& at : fit.speeds)
      figure.add_row({at.speed_mA_per_s, at.fifth_order.values(i), at.fifth_order.standard_errors(i)});
    figure.curves = {{"", 0, 1, true}};
    all.push_back(std::move(figure));
  }
}

Figure parts(const FrictionFit& fit) {
  const FrictionAtSpeed& at = fit.speeds[fit.speeds.size() / 2];
  const auto e = vector(at.samples.contraction_ratio);
  const VectorXd grid = VectorXd::LinSpaced(100, e.minCoeff(), e.maxCoeff());
  const double nu = at.speed_mA_per_s;
  Figure figure{"4.18", fmt::format("Superposition (T 4.6) at {:.1f} mA/s", nu), "contraction ratio",
                "coefficient of friction"};
  const double constant_part = fit.f0.value + fit.f1.value * nu * nu;
  figure.columns = {{ratio_column, list(grid)},
                    {"constant", std::vector<double>(100, constant_part)},
                    {"linear", list(fit.f2.value * grid)},
                    {"logarithmic", list((fit.f3.value * grid.array().log()).matrix())},
                    {"sum", list(superposed(fit, grid, nu))}};
  figure.curves = {{"constant", 0, 1}, {"linear", 0, 2}, {"logarithmic", 0, 3}, {"sum", 0, 4}};
  return figure;
}

Figure on_speed(const FrictionFit& fit) {
  Figure figure{"4.19", "f1(nu2) of the superposition (T 4.6)", "current speed [mA/s]", "f1(nu2)"};
  figure.columns = {{speed_column, {}}, {"data", {}}, {"linear_in_square", {}}};
  figure.curves = {{"data", 0, 1, true}, {"linear in nu2", 0, 2}};
  const bool has_quadratic = fit.quadratic.values.size() > 0;
  if (has_quadratic) {
    figure.columns.push_back({"quadratic_in_square", {}});
    figure.curves.push_back({"quadratic in nu2", 0, 3});
  }
  for (std::size_t i = 0; i < fit.speeds.size(); ++i) {
    const double nu = fit.speeds[i].speed_mA_per_s;
    figure.columns[0].values.push_back(nu);
    figure.columns[1].values.push_back(fit.common.values(static_cast<Index>(i)) - fit.f0.value);
    figure.columns[2].values.push_back(fit.f1.value * nu * nu);
    if (has_quadratic)
      figure.columns[3].values.push_back(polynomial(fit.quadratic.values, nu * nu) - fit.f0.value);
  }
  return figure;
}

Figure all_speeds(const FrictionFit& fit) {
  Figure figure{"4.20", "Superposition (T 4.6), contraction, all current speeds", "contraction ratio",
                "coefficient of friction"};
  figure.columns = {{speed_column, {}}, {ratio_column, {}}, {coefficient, {}}, {"model", {}}};
  for (const auto& at : fit.speeds) {
    const Samples shown = thinned(at.samples, std::max<std::size_t>(1, most_dots / fit.speeds.size()));
    const VectorXd model = superposed(fit, vector(shown.contraction_ratio), at.speed_mA_per_s);
    for (std::size_t i = 0; i < shown.size(); ++i)
      figure.add_row({at.speed_mA_per_s, shown.contraction_ratio[i], shown.coefficient[i],
                      model(static_cast<Index>(i))});
  }
  figure.curves = {{"data", 1, 2, true}, {"model", 1, 3, true}};
  return figure;
}

Figure deviations(const FrictionFit& contraction, const FrictionFit& relaxation) {
  Figure figure{"4.26", "Standard deviation of the coefficient of friction from the model",
                "current speed [mA/s]", "standard deviation"};
  figure.columns = {{speed_column, {}}};
  for (const auto& at : contraction.speeds) figure.columns[0].values.push_back(at.speed_mA_per_s);
  const auto add = [&](const char* direction, const FrictionFit& fit) {
    const std::size_t first = figure.columns.size();
    for (const char* model : {"superposition", "superposition_of_each_speed", "polynomial", "chi_square"})
      figure.columns.push_back({fmt::format("{}_{}", direction, model), {}});
    for (const auto& at : fit.speeds) {
      figure.columns[first].values.push_back(at.common_deviation);
      figure.columns[first + 1].values.push_back(at.superposition.standard_deviation);
      figure.columns[first + 2].values.push_back(at.fifth_order.standard_deviation);
      figure.columns[first + 3].values.push_back(at.chi_square.linear.standard_deviation);
    }
    figure.curves.push_back({direction, 0, first, true});
  };
  add("contraction", contraction);
  add("relaxation", relaxation);
  return figure;
}

}  // namespace

std::string Figure::file_name() const {
  const auto point = number.find('.');
  return fmt::format("figure_{}_{:0>2}", number.substr(0, point), number.substr(point + 1));
}

void Figure::add_row(std::initializer_list<double> values) {
  auto column = columns.begin();
  for (const double value : values) (column++)->values.push_back(value);
}

std::vector<double> list(const VectorXd& values) {
  return {values.begin(), values.end()};
}

Samples thinned(const Samples& samples, std::size_t most) {
  const std::size_t stride = (samples.size() + most - 1) / most;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < samples.size(); i += std::max<std::size_t>(stride, 1)) kept.push_back(i);
  std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) {
    return samples.contraction_ratio[a] < samples.contraction_ratio[b];
  });
  Samples result;
  for (const std::size_t i : kept) {
    result.contraction_ratio.push_back(samples.contraction_ratio[i]);
    result.pressure_Pa.push_back(samples.pressure_Pa[i]);
    result.coefficient.push_back(samples.coefficient[i]);
  }
  return result;
}

std::vector<Figure> figures(const CalibrationResult& result, bool kgf) {
  std::vector<Figure> all;
  const FrictionFit& fit = result.friction_of(Direction::contraction);
  per_speed(fit, all);
  all.push_back(parts(fit));
  all.push_back(on_speed(fit));
  all.push_back(all_speeds(fit));
  int number = 21;
  for (const double wanted : shown_speeds_mA_per_s) {
    const FrictionAtSpeed& at = nearest(fit, wanted);
    all.push_back(against_ratio(fmt::format("4.{}", number++), "Superposition (T 4.6)", at,
                                [&](const VectorXd& e) { return superposed(fit, e, at.speed_mA_per_s); }));
  }
  all.push_back(deviations(fit, result.friction_of(Direction::relaxation)));
  add_pressure_figures(result, kgf, all);
  const auto say = [&](std::string& text) { text = in_unit(result.command_unit(), text); };
  for (Figure& figure : all) {
    for (std::string* text : {&figure.title, &figure.x_label, &figure.y_label}) say(*text);
    for (Column& column : figure.columns) say(column.name);
    for (Curved& curve : figure.curves) say(curve.label);
  }
  return all;
}

}  // namespace mckibben::thesis
