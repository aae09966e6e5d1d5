// See the header. Where the thesis shows one load, it is its lightest.
#include <cmath>

#include <fmt/format.h>

#include <sim/thesis/pressure_figures.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::Index, Eigen::VectorXd;

class PressureFigures {
 public:
  PressureFigures(const CalibrationResult& result, bool kgf, std::vector<Figure>& all)
      : result_(result),
        all_(all),
        unit_(kgf ? "kgf_per_m2" : "Pa"),
        label_(kgf ? "kgf/m2" : "Pa"),
        factor_(kgf ? 1.0 / kgf_per_m2_Pa : 1.0) {}

  void add() {
    parts();
    shift();
    against_speed("4.29", Direction::contraction, line, "a1");
    against_speed("4.30", Direction::contraction, exponential, "a2");
    against_speed("4.31", Direction::relaxation, constant, "b0");
    against_speed("4.32", Direction::relaxation, logarithm, "b4");
    deviations("4.33", Direction::contraction);
    deviations("4.34", Direction::relaxation);
    for (const Direction direction : directions) against_load(direction);
  }

 private:
  std::vector<double> scaled(const VectorXd& pressures) const { return list(factor_ * pressures); }

  std::vector<const Cell*> lightest(Direction direction) const {
    std::vector<const Cell*> cells;
    for (const Cell& cell : result_.grid.of(direction))
      if (cell.load_kg == result_.grid.loads_kg.front()) cells.push_back(&cell);
    return cells;
  }

  void parts() {
    const auto cells = lightest(Direction::contraction);
    const std::size_t middle = cells.size() / 2;  // cells of the lightest load come first
    const Samples shown = thinned(cells[middle]->samples);
    const auto e = vector(shown.contraction_ratio);
    const ProjectedFit& own = result_.pressure_of(Direction::contraction).cells[middle].own;
    const Eigen::MatrixXd basis = pressure_basis(e, own.parameter);
    const VectorXd& c = own.linear.values;
    Figure f{"4.27",
             fmt::format("Superposition (T 4.7): contraction, {:g} kg, {:.1f} mA/s", cells[middle]->load_kg,
                         cells[middle]->speed_mA_per_s),
             "contraction ratio", fmt::format("pressure [{}]", label_)};
    f.columns = {{ratio_column, shown.contraction_ratio},
                 {"pressure_" + unit_, scaled(vector(shown.pressure_Pa))},
                 {"constant_" + unit_, scaled(c(0) * basis.col(0))},
                 {"linear_" + unit_, scaled(c(1) * basis.col(1))},
                 {"exponential_" + unit_, scaled(c(2) * basis.col(2))},
                 {"logarithmic_" + unit_, scaled(c(3) * basis.col(3))},
                 {"sum_" + unit_, scaled(basis * c)}};
    f.curves = {{"data", 0, 1, true},  {"constant", 0, 2},    {"linear", 0, 3},
                {"exponential", 0, 4}, {"logarithmic", 0, 5}, {"sum", 0, 6}};
    all_.push_back(std::move(f));
  }

  /// The slowest and the fastest current, under the lightest and the heaviest load.
  void shift() {
    Figure f{"4.28", "Shift of the pressure with load and current speed, contraction", "contraction ratio",
             fmt::format("pressure [{}]", label_)};
    f.columns = {{"load_kg", {}}, {speed_column, {}}, {ratio_column, {}}, {"pressure_" + unit_, {}}};
    const auto& cells = result_.grid.of(Direction::contraction);
    std::vector<std::size_t> corners;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const bool edge_load =
          cells[c].load_kg == cells.front().load_kg || cells[c].load_kg == cells.back().load_kg;
      const bool first = c == 0 || cells[c - 1].load_kg != cells[c].load_kg;
      const bool last = c + 1 == cells.size() || cells[c + 1].load_kg != cells[c].load_kg;
      if (edge_load && (first || last)) corners.push_back(c);
    }
    for (const std::size_t c : corners) {
      const Samples shown = thinned(cells[c].samples, most_dots / 4);
      const std::size_t begin = f.columns[0].values.size();
      for (std::size_t i = 0; i < shown.size(); ++i)
        f.add_row({cells[c].load_kg, cells[c].speed_mA_per_s, shown.contraction_ratio[i],
                   factor_ * shown.pressure_Pa[i]});
      f.curves.push_back({fmt::format("{:g} kg, {:.1f} mA/s", cells[c].load_kg, cells[c].speed_mA_per_s), 2,
                          3, true, begin, f.columns[0].values.size()});
    }
    all_.push_back(std::move(f));
  }

  void against_speed(std::string number, Direction direction, Part part, const std::string& name) {
    const PressureFit& fit = result_.pressure_of(direction);
    Figure f{std::move(number),
             fmt::format("{} against current speed, {}, {:g} kg", name, name_of(direction),
                         result_.grid.loads_kg.front()),
             "current speed [mA/s]", fmt::format("{} [{}]", name, label_)};
    f.columns = {{speed_column, {}}, {fmt::format("{}_{}", name, unit_), {}}, {"model_" + unit_, {}}};
    const std::size_t cells = lightest(direction).size();
    for (std::size_t c = 0; c < cells; ++c) {
      const PressureCell& cell = fit.cells[c];
      double model = 0.0;
      for (std::size_t curve = 0; curve < fit.shape.curves.size(); ++curve)
        if (fit.shape.curves[curve].part == part)
          model += fit.at_load[curve](0) * std::pow(cell.speed_mA_per_s, fit.shape.curves[curve].power);
      f.add_row({cell.speed_mA_per_s, factor_ * cell.refitted(static_cast<Index>(part)), factor_ * model});
    }
    f.curves = {{"data", 0, 1, true}, {"model", 0, 2}};
    all_.push_back(std::move(f));
  }

  void deviations(std::string number, Direction direction) {
    Figure f{std::move(number),
             fmt::format("Standard deviation of the pressure from the model, {}, {:g} kg", name_of(direction),
                         result_.grid.loads_kg.front()),
             "current speed [mA/s]", fmt::format("standard deviation [{}]", label_)};
    f.columns = {{speed_column, {}}};
    const std::pair<const char*, double Stages::*> stages[] = {{"in_speed", &Stages::in_speed},
                                                               {"own_fit", &Stages::own},
                                                               {"in_load", &Stages::in_load},
                                                               {"joint", &Stages::joint}};
    for (const auto& [name, stage] : stages) f.columns.push_back({fmt::format("{}_{}", name, unit_), {}});
    const std::size_t cells = lightest(direction).size();
    for (std::size_t c = 0; c < cells; ++c) {
      const PressureCell& cell = result_.pressure_of(direction).cells[c];
      f.columns[0].values.push_back(cell.speed_mA_per_s);
      for (std::size_t s = 0; s < std::size(stages); ++s)
        f.columns[s + 1].values.push_back(factor_ * cell.deviation.*stages[s].second);
    }
    f.curves = {{"polynomials in speed (T 4.8 to 4.13)", 0, 1, true}, {"all samples at once", 0, 4, true}};
    all_.push_back(std::move(f));
  }

  void against_load(Direction direction) {
    const PressureFit& fit = result_.pressure_of(direction);
    const VectorXd loads = vector(result_.grid.loads_kg);
    for (std::size_t curve = 0; curve < fit.shape.curves.size(); ++curve) {
      const Curve& law = fit.shape.curves[curve];
      const bool is_exponent = law.part == exponent;
      const double factor = is_exponent ? 1.0 : factor_;
      const std::string of_speed = law.power == 0 ? "" : law.power == 1 ? "_s_per_mA" : "_s2_per_mA2";
      const std::string unit = is_exponent ? "" : "_" + unit_ + of_speed;
      const std::string shown = law.power == 0 ? "" : law.power == 1 ? " s/mA" : " (s/mA)2";
      Figure f{law.figure,
               fmt::format("{} against load (T {}), {}", law.name, law.equation, name_of(direction)),
               "load [kg]", is_exponent ? law.name : fmt::format("{} [{}{}]", law.name, label_, shown)};
      const auto along = [&](const VectorXd& coefficients) {
        VectorXd values(loads.size());
        for (Index i = 0; i < loads.size(); ++i) values(i) = factor * polynomial(coefficients, loads(i));
        return list(values);
      };
      f.columns = {{"load_kg", result_.grid.loads_kg},
                   {law.name + unit, list(factor * fit.at_load[curve])},
                   {"model" + unit, along(fit.in_load[curve].values)},
                   {"joint" + unit, along(fit.joint.polynomials[curve])}};
      f.curves = {{"data", 0, 1, true}, {"model", 0, 2}, {"all samples at once", 0, 3}};
      if (law.name == "a4" && loads.size() >= 3) {  // the thesis draws both in 4.41
        f.columns.push_back({"quadratic" + unit, along(fit_polynomial(loads, fit.at_load[curve], 2).values)});
        f.curves.push_back({"quadratic", 0, 4});
      }
      all_.push_back(std::move(f));
    }
  }

  const CalibrationResult& result_;
  std::vector<Figure>& all_;
  std::string unit_, label_;
  double factor_;
};

}  // namespace

void add_pressure_figures(const CalibrationResult& result, bool kgf, std::vector<Figure>& all) {
  PressureFigures(result, kgf, all).add();
}

}  // namespace mckibben::thesis
