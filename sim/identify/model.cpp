// See the header.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <sim/identify/decisive.hpp>
#include <sim/identify/model.hpp>
#include <sim/identify/quadratic.hpp>

namespace mckibben::identify {

using Eigen::Index;

double log_t(double z) {
  const double nu = decisive.tails;
  return std::lgamma(0.5 * (nu + 1.0)) - std::lgamma(0.5 * nu) - 0.5 * std::log(nu * std::numbers::pi) -
         0.5 * (nu + 1.0) * std::log1p(z * z / nu);
}

double log_normal_cdf(double z) {
  if (z > -8.0) return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
  return -0.5 * z * z - std::log(-z) - 0.5 * std::log(2.0 * std::numbers::pi) + std::log1p(-1.0 / (z * z));
}

Model::Model(const Problem& p, Point at, const Error& e, double scale_N)
    : problem(&p), point(std::move(at)), error(e.with(point.differ)), term_N(scale_N) {}

Eigen::VectorXd Model::residual() const {
  Eigen::VectorXd left = problem->rows.read - read;
  // The prior of numbers of runs is round nothing: what they did where they are simulated is given back.
  for (const Block& block : problem->rows.blocks) {
    auto part = left.segment(block.begin, block.rows);
    if (!point.run_loads_kg.empty()) part += point.run_loads_kg[block.run] * error.per_kg(block);
    if (!point.starts.empty()) part += error.started(block, point.starts[block.run]);
  }
  return left;
}

double Model::left() const {
  const Rows& rows = problem->rows;
  const Eigen::VectorXd all = residual();
  double square = 0.0, count = 0.0;
  for (const Block& block : rows.blocks)
    if (rows.is_judged(block))
      for (Index i = block.begin; i < block.begin + block.rows; ++i)
        if (rows.known[static_cast<std::size_t>(i)] != 0) {
          square += all[i] * all[i];
          count += 1.0;
        }
  return std::sqrt(square / count) / rows.unit;
}

namespace {

double log_prior_of(const Dictionary& dictionary, const Point& point, double term_N) {
  const double half_log = 0.5 * std::log(2.0 * std::numbers::pi);
  const Eigen::VectorXd v = dictionary.vector(point);
  double value = 0.0;
  Index j = 0;
  for (const Coordinate& one : dictionary.coordinates(point)) {
    const double z = v[j++];
    if (one.kind == Kind::term) {
      value -= 0.5 * (z / term_N) * (z / term_N) + half_log + std::log(term_N);
    } else if (one.kind == Kind::parameter) {
      value += log_t(z);
    } else if (one.kind == Kind::size) {
      value += log_t(z);
      if (!dictionary.entries[point.effects[one.of].entry].either_sign) value += std::numbers::ln2;
    } else {
      value -= 0.5 * z * z + half_log;
    }
  }
  return value;
}

}  // namespace

double Model::log_prior() const {
  return log_prior_of(problem->dictionary, point, term_N);
}

Eigen::VectorXd Model::variance() const {
  Eigen::VectorXd list = problem->dictionary.vector(point);
  Index j = 0;
  for (const Coordinate& one : problem->dictionary.coordinates(point)) {
    double& value = list[j++];
    if (one.kind == Kind::term)
      value = term_N * term_N;
    else
      value = one.kind == Kind::parameter || one.kind == Kind::size
                  ? (decisive.tails + value * value) / (decisive.tails + 1.0)
                  : 1.0;
  }
  return list;
}

Point Model::perturbed(std::size_t coordinate, double& step, double times) const {
  Eigen::VectorXd v = problem->dictionary.vector(point);
  const auto j = static_cast<Index>(coordinate);
  step = times *
         (deviation_ ? std::clamp((*deviation_)[j], 0.01, 0.1) : 0.1);  // as far as the data leave it open
  const double from = v[j];
  v[j] += step;
  Point there = problem->dictionary.moved(point, v);
  if (problem->dictionary.vector(there)[j] == from) {  // over the edge of its range
    v[j] = from - step;
    step = -step;
    there = problem->dictionary.moved(point, v);
  }
  return there;
}

void Model::look_at_wander() {
  error.take(problem->simulator.wander(problem->dictionary.setting(point)));
}

void Model::look(bool both) {
  std::vector<std::size_t> all(problem->dictionary.coordinates(point).size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  look_again(all, both);
}

/// Readings here, and these slopes anew.
void Model::look_again(const std::vector<std::size_t>& which, bool both) {
  constexpr double wider = 3.0;
  const std::size_t sides = both ? 2 : 1;
  std::vector<Setting> settings{problem->dictionary.setting(point)};
  std::vector<double> steps(sides * which.size());
  for (std::size_t i = 0; i < steps.size(); ++i)
    settings.push_back(problem->dictionary.setting(perturbed(which[i / sides], steps[i],
                                                             !both        ? 1.0
                                                             : i % 2 == 0 ? wider
                                                                          : -wider)));
  const Eigen::MatrixXd seen = problem->simulator.differences(settings);
  if (read.size() == 0) read = seen.col(0);  // else they stay: changes are known better than where they begin
  const auto count = static_cast<Index>(problem->dictionary.coordinates(point).size());
  if (slopes.cols() != count) slopes = Eigen::MatrixXd::Zero(seen.rows(), count);
  for (std::size_t i = 0; i < which.size(); ++i) {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(seen.rows());
    double good = 0.0;
    for (std::size_t side = sides * i; side < sides * (i + 1); ++side)
      if (const auto column = seen.col(static_cast<Index>(side + 1)); column.allFinite()) {
        slope += column / steps[side];
        good += 1.0;
      }
    if (good > 0.0) slopes.col(static_cast<Index>(which[i])) = slope / good;
  }
}

Model::Here Model::here() const {
  const Eigen::VectorXd left = residual(), of_prior = variance();
  const Error fair = error.begun().fitted(left, slopes, of_prior, {1.0, 0.5}).first;
  const Grams at = fair.grams(left, slopes);
  const Eigen::MatrixXd gram = at.sum();
  const double whole =
      log_prior() +
      0.5 * static_cast<double>(slopes.cols() - left.size()) * std::log(2.0 * std::numbers::pi) -
      0.5 * (at.log_det() + gram(0, 0)) -
      curvature(gram, of_prior.cwiseInverse()).llt().matrixLLT().diagonal().array().log().sum();
  return {whole, fair.explains()};
}

void Model::fit_error(std::vector<double> steps, std::vector<std::size_t> only) {
  error = error.fitted(residual(), slopes, variance(), std::move(steps), std::move(only)).first;
}

double Model::cost(const Eigen::VectorXd& would_read, const Point& at) const {
  if (!would_read.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::VectorXd left = residual() + read - would_read;
  const Grams grams_there = error.grams(left, Eigen::MatrixXd(left.size(), 0));
  return 0.5 * grams_there.sum()(0, 0) - log_prior_of(problem->dictionary, at, term_N);
}

namespace {

constexpr std::array lengths{1.0, 0.3, 0.1};  // of steps that are tried, of the longest
constexpr int chords = 3;                     // steps by the same slopes

}  // namespace

void Model::descend(const Effort& effort) {
  const Dictionary& dictionary = problem->dictionary;
  double reach = 3.0;
  bool far = true;
  bool finely = false;
  constexpr double again = 5.0;  // times as much as in the last round
  double evidence_before = -std::numeric_limits<double>::infinity();
  arrived = hopeless = false;
  if (!read.allFinite()) return;
  error = error.forgetting();
  for (int round = 0; round < effort.rounds; ++round) {
    fit_error(round == 0 ? std::vector{1.0, 0.5} : std::vector{0.5},
              far ? std::vector<std::size_t>{Error::model_sd} : std::vector<std::size_t>{});
    const Grams now = error.grams(residual(), slopes);
    Quadratic quadratic(now.sum(), variance().cwiseInverse(), dictionary.vector(point));
    deviation_ = quadratic.deviation();
    const double promised = quadratic.promised(), before = cost(read, point);
    if (far && promised < 1.0) {
      far = false;
      continue;
    }
    if (promised < effort.enough) {
      arrived = true;
      return;
    }
    if (std::isfinite(effort.beat)) {
      const double evidence = here().evidence;
      hopeless = evidence + again * (evidence - evidence_before) < effort.beat;
      if (hopeless) return;
      evidence_before = evidence;
    }
    // Steps by the same slopes, as long as they serve.
    double here = before;
    for (int chord = 0; chord < chords; ++chord) {
      const Eigen::VectorXd v = dictionary.vector(point);
      const double wanted = quadratic.promised();
      reach = std::min(reach, quadratic.longest());
      std::vector<Point> tried;
      std::vector<Setting> settings{dictionary.setting(point)};
      for (const double length : lengths) {
        tried.push_back(dictionary.moved(point, v + quadratic.step(length * reach)));
        settings.push_back(dictionary.setting(tried.back()));
      }
      Eigen::MatrixXd reads = problem->simulator.differences(settings).rightCols(std::ssize(lengths));
      reads.colwise() += read;
      std::size_t best = 0;
      std::array<double, lengths.size()> costs{};
      for (std::size_t i = 0; i < tried.size(); ++i) {
        costs[i] = cost(reads.col(static_cast<Index>(i)), tried[i]);
        if (costs[i] < costs[best]) best = i;
      }
      if (problem->say)
        problem->say(
            fmt::format("    round {}.{}: cost {:.1f} promised {:.1f} -> {:.1f} {:.1f} {:.1f} reach {:.2f} "
                        "error {:.3f}, {:.2f} s",
                        round, chord, here, wanted, costs[0], costs[1], costs[2], reach,
                        error.of_model() / problem->rows.unit, error.length_s()));
      const double gained = here - costs[best];
      if (!(gained > 0.01)) {
        if (chord == 0) reach *= 0.1;
        break;
      }
      const Eigen::VectorXd moved = dictionary.vector(tried[best]) - v;
      const Eigen::VectorXd missed =
          (reads.col(static_cast<Index>(best)) - read - slopes * moved) / moved.squaredNorm();
      point = tried[best];
      read = reads.col(static_cast<Index>(best));
      here = costs[best];
      slopes.noalias() += missed * moved.transpose();  // Broyden
      if (best > 0)
        reach = moved.norm();
      else if (gained > 0.5 * wanted || quadratic.longest() > 1.01 * reach)
        reach = 3.0 * std::max(moved.norm(), 0.3 * reach);
      if (gained < 0.3 * wanted) break;
      const Grams there = error.grams(residual(), slopes);
      quadratic = Quadratic(there.sum(), variance().cwiseInverse(), dictionary.vector(point));
      if (quadratic.promised() < effort.enough) break;
    }
    if (before - here < effort.enough) {  // kinks promise what no step finds
      if (finely) {
        arrived = true;
        return;
      }
      finely = true;
      reach = 0.3;
      look(true);
      continue;
    }
    std::vector<std::size_t> anew;
    const bool all_anew = promised > 10.0 || !(before - here > 0.3 * promised);
    const auto coordinates = dictionary.coordinates(point);
    for (std::size_t j = 0; j < coordinates.size(); ++j)
      if (all_anew || coordinates[j].kind != Kind::parameter) anew.push_back(j);
    if (!anew.empty()) look_again(anew);
  }
}

bool Model::place() {
  const bool has_loads = point.lets_differ(loads);
  if (!(has_loads || error.starts() > 0) || point.terms != Terms::none || !read.allFinite()) return false;
  const auto of_loads =
      static_cast<std::size_t>(std::ranges::find(point.differ, loads) - point.differ.begin());
  bool moved = false;
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<std::size_t> scales{Error::model_sd};
    if (has_loads) scales.push_back(error.scale_of_differing(of_loads));
    fit_error({1.0, 0.5}, scales);
    const Eigen::VectorXd weight = variance().cwiseInverse(), v = problem->dictionary.vector(point);
    const Index k = v.size();
    const Eigen::MatrixXd gram = error.grams(residual(), slopes).sum();
    const Eigen::VectorXd step =
        curvature(gram, weight).llt().solve(Eigen::VectorXd(gram.col(0).tail(k) - weight.cwiseProduct(v)));
    const Grams left = error.grams(residual() - slopes * step, Eigen::MatrixXd(read.size(), 0));
    Point there = point;
    there.run_loads_kg.clear();
    there.starts.clear();
    double furthest = 0.0;  // of what matters: 0.1 kg, a tenth of a deviation
    for (std::size_t run = 0; run < left.means.size(); ++run) {
      const Eigen::VectorXd& mean = left.means[run];
      if (has_loads) {
        there.run_loads_kg.push_back(mean[static_cast<Index>(of_loads)]);
        furthest = std::max(furthest, std::abs(there.run_loads_kg.back() -
                                               (point.run_loads_kg.empty() ? 0.0 : point.run_loads_kg[run])));
      }
      if (error.starts() > 0) {
        there.starts.emplace_back(mean.tail(static_cast<Index>(error.starts())));
        const Eigen::VectorXd before = point.starts.empty()
                                           ? Eigen::VectorXd::Zero(there.starts.back().size()).eval()
                                           : point.starts[run];
        furthest = std::max(furthest, (there.starts.back() - before).cwiseAbs().maxCoeff());
      }
    }
    if (furthest < 0.1) break;
    Eigen::VectorXd would_read = problem->simulator.read(problem->dictionary.setting(there));
    if (!would_read.allFinite()) break;
    point = std::move(there);
    read = std::move(would_read);
    look_at_wander();
    moved = true;
  }
  return moved;
}

void Model::share_common_load() {
  const Dictionary& dictionary = problem->dictionary;
  const auto offset = std::ranges::find(dictionary.parameters, "joint.load_offset", &Dictionary::Free::path);
  if (point.run_loads_kg.empty() || point.z.size() == 0 || offset == dictionary.parameters.end()) return;
  const auto place = static_cast<std::size_t>(std::ranges::find(point.differ, loads) - point.differ.begin());
  const double of_runs = std::pow(error.scale(place), -2.0), unit_kg = offset->scale;
  double& z = point.z[offset - dictionary.parameters.begin()];
  for (int pass = 0; pass < 50; ++pass) {  // normals that touch Student's t
    const double weight = (decisive.tails + 1.0) / (decisive.tails + z * z);
    double sum_kg = 0.0;
    for (const double load_kg : point.run_loads_kg) sum_kg += load_kg;
    const double runs = static_cast<double>(point.run_loads_kg.size());
    const double to_runs_kg =
        (weight * z / unit_kg - of_runs * sum_kg) / (weight / (unit_kg * unit_kg) + runs * of_runs);
    z -= to_runs_kg / unit_kg;
    for (double& load_kg : point.run_loads_kg) load_kg += to_runs_kg;
  }
}

void Model::settle(const Effort& effort) {
  place();
  for (int pass = 0; pass < 3; ++pass) {
    descend(effort);
    share_common_load();
    if (hopeless || !place()) break;
  }
}

double Model::evidence() {
  if (!read.allFinite()) return score = log_evidence = -std::numeric_limits<double>::infinity();
  if (!point.has_lines()) {
    if (const Eigen::VectorXd finely = problem->simulator.read(problem->dictionary.setting(point));
        finely.allFinite())
      read = finely;
    look_at_wander();
  }
  const Eigen::VectorXd prior_variance = variance(), left = residual();
  // The error has several optima.
  auto [one, value_of_one] = error.fitted(left, slopes, prior_variance, {0.5});
  auto [other, value_of_other] = error.begun().fitted(left, slopes, prior_variance, {1.0, 0.5});
  error = value_of_one >= value_of_other ? std::move(one) : std::move(other);
  fit_error({0.25});
  grams = error.grams(left, slopes);
  const Eigen::MatrixXd gram = grams.sum();
  const Eigen::VectorXd v = problem->dictionary.vector(point), weight = prior_variance.cwiseInverse();
  const Index k = v.size();
  const Eigen::LLT<Eigen::MatrixXd> low(curvature(gram, weight));
  covariance = low.solve(Eigen::MatrixXd::Identity(k, k));
  const Eigen::VectorXd pull = gram.col(0).tail(k) - weight.cwiseProduct(v);
  double value = log_prior() + error.log_scales() -
                 0.5 * (static_cast<double>(read.size()) * std::log(2.0 * std::numbers::pi) +
                        grams.log_det() + gram(0, 0)) +
                 0.5 * pull.dot(covariance * pull) +
                 0.5 * static_cast<double>(k) * std::log(2.0 * std::numbers::pi);
  if (k > 0) value -= low.matrixLLT().diagonal().array().log().sum();
  Index j = 0;
  for (const Coordinate& coordinate : problem->dictionary.coordinates(point)) {
    if (coordinate.kind == Kind::size &&
        !problem->dictionary.entries[point.effects[coordinate.of].entry].either_sign)
      value += log_normal_cdf((v[j] - decisive.least) / std::sqrt(covariance(j, j)));
    ++j;
  }
  return log_evidence = value;
}

Model Model::with_terms(Terms terms, const Eigen::MatrixXd& columns, double scale_N) const {
  Model m(*problem, point, error, scale_N);
  m.point.terms = terms;
  m.point.coefficients = Eigen::VectorXd::Zero(columns.cols());
  m.read = read;
  m.slopes.resize(slopes.rows(), slopes.cols() + columns.cols());
  m.slopes << slopes, columns;
  m.fit_error({1.0, 0.5});
  m.evidence();
  return m;
}

}  // namespace mckibben::identify
