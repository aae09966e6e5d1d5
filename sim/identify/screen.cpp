// See the header.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>

#include <sim/identify/decisive.hpp>
#include <sim/identify/screen.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

constexpr std::array sizes{1.0, 0.1, 3.0};  // a slope, and secants for what has a kink
constexpr double coarse = 1e-4;             // tolerance: directions need no digits
constexpr std::size_t beam = 60;
constexpr double size_variance = 4.0;  // of a size, while sets are compared

bool is_clock(const Entry& entry) {
  return entry.bench != nullptr && entry.bench->name == "reading_clock";
}

}  // namespace

std::vector<Probe> probes(const Dictionary& dictionary, const Point& beside) {
  std::vector<Probe> list;
  for (std::size_t k = 0; k < dictionary.entries.size(); ++k) {
    const Entry& entry = dictionary.entries[k];
    if (beside.has(k)) continue;
    if (is_clock(entry)) {
      list.push_back({k, 1.0});
      continue;
    }
    for (const auto& shapes : entry.begin) {
      const bool first = &shapes == &entry.begin.front();
      for (const double size : sizes)
        if (first || size == 1.0) list.push_back({k, size, shapes});
      if (entry.either_sign && first) list.push_back({k, -1.0, shapes});
    }
  }
  return list;
}

namespace {

/// The change by a recorder's clock: readings at other times, which needs no simulation.
Eigen::VectorXd column_of_clock(const Model& model, const BenchNumber& clock, const Probe& probe) {
  const double size = probe.size * clock.typical, row_s = model.problem->rows.row_s;
  Eigen::VectorXd column(model.read.size());
  for (const Block& block : model.problem->rows.blocks) {
    const Eigen::VectorXd read = model.read.segment(block.begin, block.rows);
    column.segment(block.begin, block.rows) =
        ((clock.of == &Bench::clock ? clocked(read, size) : clocked(read, 0.0, size / row_s)) - read) /
        probe.size;
  }
  return column;
}

/// Of a pair, where in the list muscle 1's and muscle 2's part of what both have are; empty: one is not.
std::vector<std::size_t> sides_of(const Dictionary& dictionary, const std::vector<Probe>& list,
                                  const Probe& probe) {
  using diagnose::Side;
  const auto& both = dictionary.entries[probe.entry].effect;
  std::vector<std::size_t> places;
  if (!both || both->side != Side::both) return places;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& one = dictionary.entries[list[i].entry].effect;
    if (one && one->side != Side::both && one->effect == both->effect && one->variant == both->variant &&
        list[i].size == probe.size && list[i].shapes == probe.shapes)
      places.push_back(i);
  }
  if (places.size() < 2) places.clear();
  return places;
}

}  // namespace

Eigen::MatrixXd columns_of(const Model& model, std::vector<Probe>& list) {
  const Dictionary& dictionary = model.problem->dictionary;
  // Rigs of one structure share lanes with the model's own.
  std::vector<Setting> settings;
  Eigen::MatrixXd columns(model.problem->rows.size(), std::ssize(list));
  for (std::size_t first = 0; first < list.size();) {
    std::size_t last = first;
    if (const Entry& entry = dictionary.entries[list[first].entry]; is_clock(entry)) {
      columns.col(static_cast<Index>(first)) = column_of_clock(model, *entry.bench, list[first]);
      ++first;
      continue;
    }
    if (!sides_of(dictionary, list, list[first]).empty()) {  // their sum, below
      ++first;
      continue;
    }
    settings.assign(1, dictionary.setting(model.point));
    while (last < list.size() && list[last].entry == list[first].entry) {
      settings.push_back(
          dictionary.setting(model.point.with({list[last].entry, list[last].size, list[last].shapes})));
      ++last;
    }
    const Eigen::MatrixXd changes = model.problem->simulator.differences(settings, coarse);
    for (std::size_t i = first; i < last; ++i)
      columns.col(static_cast<Index>(i)) = changes.col(static_cast<Index>(i - first + 1)) / list[i].size;
    first = last;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::vector<std::size_t> sides = sides_of(dictionary, list, list[i]);
    if (sides.empty()) continue;
    columns.col(static_cast<Index>(i)).setZero();
    for (const std::size_t side : sides)
      columns.col(static_cast<Index>(i)) += columns.col(static_cast<Index>(side));
  }
  std::vector<Index> kept;
  std::vector<Probe> good;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto column = columns.col(static_cast<Index>(i));
    if (!column.allFinite() || !(column.cwiseAbs().maxCoeff() > 1e-4 * model.problem->rows.unit)) continue;
    kept.push_back(static_cast<Index>(i));
    good.push_back(list[i]);
  }
  list = std::move(good);
  return columns(Eigen::all, kept);
}

Eigen::MatrixXd columns_of(const Model& model, Terms terms) {
  const Dictionary& dictionary = model.problem->dictionary;
  const std::size_t count = dictionary.count_of_terms(terms);
  const Setting here = dictionary.setting(model.point);
  Eigen::MatrixXd columns;
  if (terms == Terms::rubs) {
    columns = model.problem->simulator.rubs(here, dictionary.reach_m, count);
  } else {
    constexpr double probe_N = 0.3;
    std::vector<Setting> settings{here};
    for (std::size_t j = 0; j < count; ++j) {
      Point q = model.point;
      q.terms = terms;
      q.coefficients = Eigen::VectorXd::Zero(static_cast<Index>(count));
      q.coefficients[static_cast<Index>(j)] = probe_N;
      settings.push_back(dictionary.setting(q));
    }
    columns = model.problem->simulator.differences(settings).rightCols(static_cast<Index>(count)) / probe_N;
  }
  for (Index j = 0; j < columns.cols(); ++j)
    if (!columns.col(j).allFinite()) columns.col(j).setZero();
  return columns;
}

double log_prior_of_set(std::size_t size, std::size_t names) {
  if (size > names) return -std::numeric_limits<double>::infinity();
  const double n = static_cast<double>(names), k = static_cast<double>(size);
  return -std::log(decisive.most_together + 1.0) -
         (std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0));
}

std::vector<Few> few_of(const Model& all, double term_N) {
  const Dictionary& dictionary = all.problem->dictionary;
  const auto step = static_cast<Index>(together(all.point.terms));
  const Index count = all.point.coefficients.size() / step, n = all.slopes.cols() - step * count;
  Eigen::VectorXd variance = all.variance();
  const Eigen::VectorXd v = dictionary.vector(all.point), pull = v.cwiseQuotient(variance);
  Eigen::MatrixXd gram = all.grams.sum();
  gram.col(0).tail(v.size()) -= pull;
  gram.row(0).tail(v.size()) -= pull.transpose();
  const auto value = [&](const std::vector<Index>& kept) {
    std::vector<Index> rows{0};
    for (const Index j : kept) rows.push_back(j + 1);
    return log_evidence(gram(rows, rows), all.grams.log_det(), all.read.size(), variance(kept));
  };
  std::vector<Index> kept(static_cast<std::size_t>(v.size()));
  std::iota(kept.begin(), kept.end(), Index{0});
  const double of_all = value(kept);
  variance.tail(v.size() - n).setConstant(term_N * term_N);
  kept.resize(static_cast<std::size_t>(n));
  std::vector<Few> list;
  for (Index k = 1; k <= count; ++k) {
    std::vector<Index> best;
    double most = -std::numeric_limits<double>::infinity();
    for (Index j = n; j < v.size(); j += step) {
      if (std::ranges::find(kept, j) != kept.end()) continue;
      std::vector<Index> more = kept;
      for (Index i = 0; i < step; ++i) more.push_back(j + i);
      if (const double with = value(more); with > most) {
        most = with;
        best = std::move(more);
      }
    }
    kept = std::move(best);
    const double score = all.score + most - of_all +
                         log_prior_of_set(static_cast<std::size_t>(k), static_cast<std::size_t>(count));
    if (k > 2 && !(score > list.back().value)) break;
    list.resize(std::min<std::size_t>(list.size(), 1));
    Point q = all.point;
    q.coefficients = Eigen::VectorXd::Zero(k * step);
    if (q.terms == Terms::waves) q.stretches = Eigen::VectorXd::Zero(k);
    for (std::size_t i = static_cast<std::size_t>(n); i < kept.size(); ++i)
      q.members.push_back(static_cast<std::size_t>(kept[i] - n));
    Eigen::MatrixXd curvature = gram.bottomRightCorner(v.size(), v.size())(kept, kept);
    curvature.diagonal() += variance(kept).cwiseInverse();
    Eigen::VectorXd there = dictionary.vector(q);
    there.head(std::ssize(kept)) =
        v(kept) + curvature.llt().solve(Eigen::VectorXd(gram.col(0).tail(v.size())(kept)));
    list.push_back({score, term_N, dictionary.moved(q, there)});
  }
  return list;
}

namespace {

/// A set of columns, and what it gains over none.
struct Found {
  double value;
  std::vector<Index> columns;
  Eigen::VectorXd sizes;
};

class Lattice {
 public:
  Lattice(const Dictionary& dictionary, const std::vector<Probe>& probes, const std::vector<Index>& free,
          const Eigen::MatrixXd& gram, std::size_t taken)
      : dictionary_(dictionary), probes_(probes), free_(free), taken_(taken) {
    const double s = std::sqrt(size_variance);
    inner_ = s * s * gram.bottomRightCorner(gram.rows() - 1, gram.rows() - 1);
    along_ = s * gram.col(0).tail(gram.rows() - 1);
  }

  /// Best first.
  std::vector<Found> operator()() const {
    std::vector<Found> all;
    std::vector<std::vector<Index>> frontier;
    for (Index j = 0; j < std::ssize(free_); ++j) frontier.push_back({j});
    for (std::size_t k = 1;
         taken_ + k <= static_cast<std::size_t>(decisive.most_together) && !frontier.empty(); ++k) {
      std::vector<Found> level;
      for (auto& columns : frontier) level.push_back(scored(std::move(columns)));
      std::ranges::stable_sort(level, std::greater{}, &Found::value);
      if (k > 1 && level.size() > beam) level.resize(beam);
      std::set<std::vector<Index>> grown;
      for (std::size_t i = 0; i < std::min(beam, level.size()); ++i)
        for (Index j = 0; j < std::ssize(free_); ++j) {
          const auto same = [&](Index other) { return name(other) == name(j); };
          if (std::ranges::any_of(level[i].columns, same)) continue;
          std::vector<Index> more = level[i].columns;
          more.push_back(j);
          std::ranges::sort(more);
          grown.insert(std::move(more));
        }
      frontier.assign(grown.begin(), grown.end());
      std::ranges::move(level, std::back_inserter(all));
    }
    std::ranges::stable_sort(all, std::greater{}, &Found::value);
    return all;
  }

 private:
  const Entry& entry(Index j) const {
    return dictionary_.entries[probes_[static_cast<std::size_t>(free_[static_cast<std::size_t>(j)])].entry];
  }
  const std::string& name(Index j) const { return entry(j).name; }

  Found scored(std::vector<Index> columns) const {
    const Index k = std::ssize(columns);
    Eigen::MatrixXd a = inner_(columns, columns);
    a.diagonal().array() += 1.0;
    const Eigen::VectorXd u = along_(columns);
    const Eigen::LLT<Eigen::MatrixXd> low(a);
    const Eigen::VectorXd mean = low.solve(u);
    const Eigen::MatrixXd inverse = low.solve(Eigen::MatrixXd::Identity(k, k));
    double value = 0.5 * u.dot(mean) - low.matrixLLT().diagonal().array().log().sum();
    const double s = std::sqrt(size_variance);
    for (Index i = 0; i < k; ++i) {
      const Entry& one = entry(columns[static_cast<std::size_t>(i)]);
      value -= std::log(static_cast<double>(dictionary_.laws_of(one.name))) +
               std::log(static_cast<double>(one.begin.size()));
      if (!one.either_sign)
        value += std::numbers::ln2 + log_normal_cdf((mean[i] * s - decisive.least) /
                                                    (s * std::sqrt(std::max(inverse(i, i), 1e-12))));
    }
    value += log_prior_of_set(static_cast<std::size_t>(k) + taken_, dictionary_.all_names) -
             log_prior_of_set(taken_, dictionary_.all_names);
    return {value, std::move(columns), mean * s};
  }

  const Dictionary& dictionary_;
  const std::vector<Probe>& probes_;
  const std::vector<Index>& free_;
  std::size_t taken_;
  Eigen::MatrixXd inner_;
  Eigen::VectorXd along_;
};

}  // namespace

std::vector<Start> sets(const Problem& problem, const Error& error, const Point& base, double term_N,
                        const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                        const Eigen::MatrixXd& columns, const std::vector<Probe>& list, bool far) {
  const Dictionary& dictionary = problem.dictionary;
  Eigen::MatrixXd both(residual.size(), slopes.cols() + columns.cols());
  both << slopes, columns;
  const Grams grams = error.grams(residual, both);
  Eigen::MatrixXd gram = grams.sum();
  const Index n = slopes.cols();
  const Model at(problem, base, error, term_N);
  const Eigen::VectorXd weight = at.variance().cwiseInverse(), v = dictionary.vector(base);
  // The pull of the priors.
  const Eigen::VectorXd pull = weight.cwiseProduct(v);
  gram.col(0).segment(1, n) -= pull;
  gram.row(0).segment(1, n) -= pull.transpose();
  Eigen::MatrixXd curvature = gram.block(1, 1, n, n);
  curvature.diagonal() += weight;
  const Eigen::LLT<Eigen::MatrixXd> low(curvature);
  std::vector<Index> rest{0};
  for (Index j = n + 1; j < gram.rows(); ++j) rest.push_back(j);
  Eigen::MatrixXd left = gram(rest, rest);
  if (n > 0) {
    const Eigen::MatrixXd kept = gram(Eigen::seqN(1, n), rest);
    const Eigen::MatrixXd half = low.matrixL().solve(kept);
    left -= half.transpose() * half;
  }
  const std::vector<std::string> names = dictionary.names(base);
  std::vector<Index> free;
  std::vector<Index> of_left{0};
  for (Index j = 0; j < std::ssize(list); ++j) {
    const std::string& name = dictionary.entries[list[static_cast<std::size_t>(j)].entry].name;
    if (std::ranges::find(names, name) != names.end()) continue;
    free.push_back(j);
    of_left.push_back(j + 1);
  }
  double offset = -0.5 * left(0, 0) - 0.5 * v.dot(pull) + 0.5 * weight.array().log().sum() -
                  0.5 * grams.log_det() + log_prior_of_set(names.size(), dictionary.all_names) -
                  0.5 * static_cast<double>(base.differ.size()) *
                      std::log(1.0 + 2.0 * static_cast<double>(grams.of_runs.size()));
  if (n > 0) offset -= low.matrixLLT().diagonal().array().log().sum();
  std::vector<Start> starts{{offset, base}};
  const Lattice lattice(dictionary, list, free, left(of_left, of_left), names.size());
  for (const Found& found : lattice()) {
    Point q = base;
    if (!far && n > 0) {  // parameters give way to what is added
      Eigen::VectorXd along = gram.col(0).segment(1, n);
      for (std::size_t i = 0; i < found.columns.size(); ++i)
        along -= gram.col(n + 1 + free[static_cast<std::size_t>(found.columns[i])]).segment(1, n) *
                 found.sizes[static_cast<Index>(i)];
      q = dictionary.moved(q, v + low.solve(along));
    }
    for (std::size_t i = 0; i < found.columns.size(); ++i) {
      const Probe& probe = list[static_cast<std::size_t>(free[static_cast<std::size_t>(found.columns[i])])];
      const double size = found.sizes[static_cast<Index>(i)];
      const bool may_be = dictionary.entries[probe.entry].either_sign || size > 0.0;
      q = q.with(dictionary.clipped({probe.entry, may_be ? size : 0.1, probe.shapes}));
    }
    starts.push_back({found.value + offset, std::move(q)});
  }
  return starts;
}

}  // namespace mckibben::identify
