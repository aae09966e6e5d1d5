// See the header.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <sim/diagnose/left_open.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/domain/number.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/estimates.hpp>
#include <sim/identify/quadratic.hpp>

namespace mckibben::identify {

using diagnose::FittedNumber, Eigen::Index;

namespace {

constexpr double half_95 = diagnose::thresholds.tell.normal;
constexpr double unknown = 0.8;  // of the prior's variance: the data have hardly narrowed it
constexpr double fine = 0.2;     // of what a number alone may be off by: a digit that is worth writing

/// What a term stands for: "P e", "sin(2 pi x / 12.000 mm + 0.40 rad)".
std::string in_words(const plant::ForceTerm& term) {
  if (term.of != plant::Basis::sine) return std::string(plant::name_of(term.of));
  const bool shifted = std::abs(term.phase_rad) >= diagnose::thresholds.tell.told_phase;
  return fmt::format(
      "sin(2 pi x / {:.3f} mm{})", 1e3 * term.wavelength_m,
      shifted ? fmt::format(" {} {:.2f} rad", term.phase_rad < 0.0 ? "-" : "+", std::abs(term.phase_rad))
              : "");
}

Eigen::VectorXd step_to_most_probable(const Model& model) {
  const Eigen::VectorXd v = model.problem->dictionary.vector(model.point);
  const Eigen::VectorXd pull =
      model.grams.sum().col(0).tail(v.size()) - model.variance().cwiseInverse().cwiseProduct(v);
  return model.covariance * pull;
}

/// The nearest that has only the digits that a deviation of so much leaves.
double with_digits(double value, double deviation) {
  if (value == 0.0 || !(deviation > 0.0) || !std::isfinite(deviation)) return value;
  const double digits =
      std::floor(std::log10(std::abs(value))) - std::floor(std::log10(fine * deviation)) + 1.0;
  return digits > 9.0 ? value : domain::significant(value, static_cast<int>(std::max(digits, 1.0)));
}

/// Gathers what is reported of one model.
class Estimating {
 public:
  explicit Estimating(const Model& model)
      : model_(model),
        dictionary_(model.problem->dictionary),
        point_(most_probable(model)),
        v_(dictionary_.vector(point_)),
        variance_(model.variance()),
        curvature_(curvature(model.grams.sum(), variance_.cwiseInverse())),
        list_(dictionary_.coordinates(point_)) {}

  Estimates operator()() {
    result_.rig = dictionary_.setting(point_).rig;
    round_parameters();
    for (std::size_t i = 0; i < point_.effects.size(); ++i) add(i);
    for (Index j = 0; j < std::ssize(list_); ++j)
      if (list_[static_cast<std::size_t>(j)].kind == Kind::parameter) move(j);
    find_law();
    find_left_open();
    return std::move(result_);
  }

 private:
  double deviation(Index j) const { return std::sqrt(model_.covariance(j, j)); }
  /// Where all others stand.
  double alone(Index j) const { return 1.0 / std::sqrt(curvature_(j, j)); }
  bool determined(Index j) const { return model_.covariance(j, j) < unknown * variance_[j]; }
  const Dictionary::Free& parameter(Index j) const {
    return dictionary_.parameters[list_[static_cast<std::size_t>(j)].of];
  }
  static bool of_bench(const Dictionary::Free& p) { return p.path == "bench.zero"; }

  std::vector<std::string> paths_of(const Dictionary::Free& p) const {
    const std::string other = std::string(diagnose::of_muscle_2) + p.path;
    if (p.difference) return {other};
    return p.both_sides ? std::vector{p.path, other} : std::vector{p.path};
  }

  struct Ends {
    double lowest, highest;
  };
  /// Of what a file may say.
  Ends ends_of(const Dictionary::Free& p) {
    if (!p.difference) return {p.lowest, p.highest};
    const diagnose::Found found = diagnose::find(result_.rig, paths_of(p).front());
    return {found.lowest, found.highest};
  }

  void round_parameters() {
    struct Rounding {
      double off;
      Ends ends;
    };
    std::map<std::string, Rounding> finest;
    for (Index j = 0; j < std::ssize(list_); ++j) {
      if (list_[static_cast<std::size_t>(j)].kind != Kind::parameter || v_[j] == 0.0) continue;
      const auto& p = parameter(j);
      if (of_bench(p)) continue;
      for (const std::string& path : paths_of(p)) {
        const double off = p.unit(diagnose::value_of(result_.rig, path)) * alone(j);
        Rounding& known = finest.emplace(path, Rounding{off, ends_of(p)}).first->second;
        known.off = std::min(known.off, off);
      }
    }
    for (const auto& [path, rounding] : finest) {
      double& value = *diagnose::find(result_.rig, path).value;
      value = std::clamp(with_digits(value, rounding.off), rounding.ends.lowest, rounding.ends.highest);
    }
  }

  /// `value`: of z, ascending or descending.
  FittedNumber number(std::string name, std::string unit, Index j, double lowest, double highest,
                      const std::function<double(double)>& value) const {
    const double z = v_[j], half = half_95 * deviation(j);
    const auto [low, high] =
        std::minmax({value(std::max(z - half, lowest)), value(std::min(z + half, highest))});
    return {.name = std::move(name),
            .unit = std::move(unit),
            .value = value(z),
            .low = low,
            .high = high,
            .determined = determined(j)};
  }

  Index place_of(Kind kind, std::size_t of, std::size_t which = 0) const {
    const auto at = std::ranges::find_if(
        list_, [&](const Coordinate& one) { return one.kind == kind && one.of == of && one.which == which; });
    return at - list_.begin();
  }

  void add(std::size_t i) {
    const Added& added = point_.effects[i];
    const Entry& entry = dictionary_.entries[added.entry];
    const Index of_size = place_of(Kind::size, i);
    const auto size = [&](double z) { return entry.absent + entry.typical * z; };
    const double lowest = entry.either_sign ? entry.lowest : 0.0;
    if (entry.bench != nullptr) {
      result_.bench.push_back(number(std::string(entry.bench->variant), std::string(entry.bench->unit),
                                     of_size, lowest, entry.highest, size));
      return;
    }
    const diagnose::Candidate& effect = *entry.effect;
    diagnose::NamedEffect named{.name = effect.effect, .variant = effect.variant, .side = effect.side};
    const auto take = [&](const std::string& path, FittedNumber fitted, double off) {
      const diagnose::Found found = diagnose::find(result_.rig, path);
      fitted.unit = found.unit;
      fitted.value = std::clamp(with_digits(fitted.value, off), found.lowest, found.highest);
      named.parameters.push_back(std::move(fitted));
      return named.parameters.back().value;
    };
    const auto key = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
    const double rounded =
        take(effect.amplitude, number(key(effect.amplitude), "", of_size, lowest, entry.highest, size),
             std::abs(entry.typical) * alone(of_size));
    std::vector<double> with;
    for (std::size_t k = 0; k < entry.shapes.size(); ++k) {
      const Shape& shape = entry.shapes[k];
      const Index of_shape = place_of(Kind::shape, i, k);
      const auto value = [&](double z) { return shape.value(z); };
      with.push_back(
          take(shape.path, number(key(shape.path), "", of_shape, -infinite, infinite, value),
               (shape.logarithmic ? value(added.shapes[k]) : 1.0) * shape.deviation * alone(of_shape)));
    }
    entry.put(result_.rig, rounded, with);
    result_.effects.push_back(std::move(named));
  }

  void move(Index j) {
    const auto& p = parameter(j);
    if (of_bench(p)) return;
    const std::string path = paths_of(p).front();
    double off = deviation(j), z = v_[j];
    const Dictionary::Free* base = &p;
    if (p.difference) {  // as muscle 2's own, of which the shared one is a part
      const auto shared = std::ranges::find_if(list_, [&](const Coordinate& one) {
        return one.kind == Kind::parameter && !dictionary_.parameters[one.of].difference &&
               dictionary_.parameters[one.of].path == p.path;
      });
      const Index i = shared - list_.begin();
      base = &parameter(i);
      z += v_[i];
      off = std::sqrt(
          std::max(model_.covariance(i, i) + model_.covariance(j, j) + 2.0 * model_.covariance(i, j), 0.0));
    }
    const diagnose::Found found = diagnose::find(result_.rig, path);
    const Ends ends = ends_of(p);
    const double value = *found.value, half = half_95 * off;
    diagnose::Moved moved{.fitted = {.name = path,
                                     .unit = std::string(found.unit),
                                     .value = value,
                                     .low = std::max(base->unscaled(z - half), ends.lowest),
                                     .high = std::min(base->unscaled(z + half), ends.highest),
                                     .determined = determined(j)},
                          .nominal = base->origin,
                          .deviations = z,
                          .at_the_edge = value <= ends.lowest || value >= ends.highest,
                          .by_factors = p.logarithmic};
    // As well as these runs tell it, where the file told it; where they hardly do, as the file does.
    if (const auto stated = result_.rig.spreads.find(path);
        stated != result_.rig.spreads.end() && determined(j))
      stated->second = domain::significant(p.scale * off, 2);
    result_.moved.push_back(std::move(moved));
  }

  void find_law() {
    if (point_.terms == Terms::none || point_.terms == Terms::rubs) return;  // no rig file carries rubs
    const auto& in_rig = result_.rig.effects.get<plant::ResidualForce>().terms;
    std::vector<plant::ForceTerm> found(in_rig.end() - point_.coefficients.size(), in_rig.end()), law;
    for (std::size_t i = 0; i < found.size(); i += together(point_.terms))
      law.push_back(point_.terms == Terms::waves ? wave(found[i], i) : term(found[i], i));
    diagnose::each_side(result_.rig, [&](plant::Effects& effects) {
      auto& terms = effects.get<plant::ResidualForce>().terms;
      terms.resize(terms.size() - found.size());
      terms.insert(terms.end(), law.begin(), law.end());
    });
  }

  static FittedNumber around(std::string name, std::string unit, double value, double off, bool determined) {
    const double half = half_95 * off;
    return {std::move(name), std::move(unit), value, value - half, value + half, determined};
  }

  plant::ForceTerm term(plant::ForceTerm found, std::size_t i) {
    const Index j = place_of(Kind::term, i);
    FittedNumber size = around(in_words(found), "N", v_[j], deviation(j), determined(j));
    size.value = found.coefficient_N = with_digits(v_[j], alone(j));
    result_.law.push_back({size.name, size});
    return found;
  }

  /// A sine and a cosine of one wavelength are one sine with a phase.
  plant::ForceTerm wave(plant::ForceTerm found, std::size_t i) {
    const Index j = place_of(Kind::term, i), of_length = place_of(Kind::stretch, i / 2);
    const double N = v_.segment<2>(j).norm(), turn = 2.0 * std::numbers::pi;
    const Eigen::Vector2d along = v_.segment<2>(j) / N, across(-along[1], along[0]);
    const auto variance = [&](const Eigen::Vector2d& way) {
      return way.dot(model_.covariance.block<2, 2>(j, j) * way);
    };
    const auto alone_along = [&](const Eigen::Vector2d& way) {
      return 1.0 / std::sqrt(way.dot(curvature_.block<2, 2>(j, j) * way));
    };
    std::vector<FittedNumber> shape;
    if (of_length < v_.size()) {
      const double length_m = found.wavelength_m;
      shape.push_back(number("wavelength", "m", of_length, -infinite, infinite, [&](double z) {
        return length_m * std::exp(decisive.stretch_sd * (z - v_[of_length]));
      }));
      shape.back().value = found.wavelength_m =
          with_digits(length_m, length_m * decisive.stretch_sd * alone(of_length));
    }
    const double half = half_95 * std::sqrt(variance(across)) / N;
    FittedNumber phase = around("phase", "rad", std::atan2(along[1], along[0]),
                                std::min(half, 0.5 * turn) / half_95, half < 0.5 * turn);
    phase.value = found.phase_rad = with_digits(phase.value, alone_along(across) / N);
    shape.push_back(std::move(phase));
    found.coefficient_N = with_digits(N, alone_along(along));
    FittedNumber size = around(in_words(found), "N", N, std::sqrt(variance(along)),
                               variance(along) < unknown * model_.term_N * model_.term_N);
    size.value = found.coefficient_N;
    result_.law.push_back({size.name, size, std::move(shape)});
    return found;
  }

  void find_left_open() {
    std::vector<diagnose::FittedOne> numbers;
    for (const diagnose::Moved& moved : result_.moved)  // these coordinates come first, in this order
      numbers.push_back({moved.fitted.name, moved.fitted.unit, moved.fitted.value,
                         parameter(std::ssize(numbers)).unit(moved.fitted.value)});
    if (numbers.empty()) return;
    const Index k = std::ssize(numbers), others = v_.size() - k;
    const Eigen::MatrixXd gram = model_.grams.sum().bottomRightCorner(v_.size(), v_.size());
    Eigen::MatrixXd information = gram.topLeftCorner(k, k);
    if (others > 0)
      information -=
          gram.topRightCorner(k, others) * Eigen::MatrixXd(curvature_.bottomRightCorner(others, others))
                                               .llt()
                                               .solve(Eigen::MatrixXd(gram.bottomLeftCorner(others, k)));
    result_.left_open = diagnose::left_open(information, numbers);
  }

  static constexpr double infinite = std::numeric_limits<double>::infinity();

  const Model& model_;
  const Dictionary& dictionary_;
  const Point point_;
  const Eigen::VectorXd v_, variance_;
  const Eigen::MatrixXd curvature_;
  const std::vector<Coordinate> list_;
  Estimates result_;
};

}  // namespace

Point most_probable(const Model& model) {
  if (!model.point.has_lines()) return model.point;
  const Dictionary& dictionary = model.problem->dictionary;
  return dictionary.moved(model.point, dictionary.vector(model.point) + step_to_most_probable(model));
}

Estimates estimates_of(const Model& model) {
  return Estimating(model)();
}

}  // namespace mckibben::identify
