// See the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/identify/decisive.hpp>
#include <sim/identify/estimates.hpp>
#include <sim/identify/held_out.hpp>
#include <sim/identify/identify.hpp>
#include <sim/identify/screen.hpp>
#include <sim/identify/usable.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

// How far the search goes.
constexpr int rounds = 4;
constexpr int first_rounds = 4;       // of the parameters, before effects are looked for
constexpr std::size_t tries = 6;      // that are begun, of a look
const double worth = std::log(20.0);  // nats, of another try (Kass & Raftery 1995: strong)
constexpr double clear = 20.0;        // nats behind: hopeless
constexpr double far_off = 3.0;       // deviations of a parameter: something may stand in its place
constexpr double alike = 0.9;         // squared cosine of what both change

constexpr std::array families{Terms::smooth, Terms::waves, Terms::rubs};

using Names = std::vector<std::string>;

class Search {
 public:
  explicit Search(const Problem& problem)
      : problem_(problem), dictionary_(problem.dictionary), rows_(problem.rows) {}

  Identified operator()();

 private:
  using Key = std::pair<bool, Names>;  // described; names

  void say(const std::string& what) const {
    if (problem_.say) problem_.say(what);
  }
  double enter(Model& model, bool described = false);
  double best_score() const;
  Model begun(Point point) const;
  Model refined(Model begun);
  Model refined(Point point);
  /// By more than chance; where all is explained, a parameter by itself.
  static bool bent(const Model& model) {
    const Eigen::VectorXd& z = model.point.z;
    return z.size() > 0 &&
           (z.cwiseAbs().maxCoeff() > far_off ||
            (!model.error.explains() &&
             z.squaredNorm() > chi_square(decisive.bent, static_cast<std::size_t>(z.size()))));
  }
  std::vector<Start> starts_from(const Model& base, const Eigen::MatrixXd& columns,
                                 const std::vector<Probe>& probes, const Point& point,
                                 const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes, bool far,
                                 bool single) const;
  std::vector<Start> twins(const Model& base, const Eigen::MatrixXd& columns,
                           const std::vector<Probe>& probes, double own) const;
  bool look_from(Model base, bool far, bool first);
  void prune();
  double gain_of_terms(const Model& base) const;
  void try_terms();

  const Problem& problem_;
  const Dictionary& dictionary_;
  const Rows& rows_;
  std::map<Key, Model> table_;
  std::optional<Model> here_, at_;
  std::set<std::pair<Names, std::vector<double>>> begun_;
  std::set<Names> hills_;
  bool explained_ = false;  ///< all, by what was begun last
  bool outside_ = false;    ///< general terms explain more than any set of the catalogue
};

double Search::enter(Model& model, bool described) {
  const Names names = dictionary_.names(model.point);
  model.score = model.log_evidence + log_prior_of_set(names.size(), dictionary_.all_names) +
                (names.empty() ? std::log(0.5) : 0.0);
  for (const Added& added : model.point.effects)
    model.score -= std::log(static_cast<double>(dictionary_.laws_of(dictionary_.entries[added.entry].name)));
  const Key key{described, names};
  const auto known = table_.find(key);
  if (known == table_.end())
    table_.emplace(key, model);
  else if (known->second.hopeless || (!model.hopeless && model.score > known->second.score))
    known->second = model;
  if (problem_.say) {
    say(fmt::format(
        "  {}: {:.1f}  model error {:.3f} of {:.3f}, {:.2f} s; wander {:.4f}; left {:.3f}; z'z {:.1f}; {} "
        "passes",
        described       ? "as described"
        : names.empty() ? "parameters"
                        : fmt::format("{}", fmt::join(names, " + ")),
        model.score, model.error.of_model() / rows_.unit, model.error.white() / rows_.unit,
        model.error.length_s(), model.error.wander_units(), model.left(), model.point.z.squaredNorm(),
        problem_.simulator.passes()));
  }
  return model.score;
}

double Search::best_score() const {
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& [key, model] : table_) best = std::max(best, model.score);
  return best;
}

/// One round of the descent to the most probable numbers. No descent depends on those before it.
Model Search::begun(Point point) const {
  Model m(problem_, std::move(point), at_->error.begun());
  m.look();
  m.descend({.rounds = 1});
  return m;
}

Model Search::refined(Model m) {
  m.settle({.beat = best_score() - clear});
  if (m.hopeless)
    m.log_evidence = m.here().evidence;
  else
    m.evidence();
  enter(m);
  return m;
}

Model Search::refined(Point point) {
  Model m(problem_, std::move(point), at_->error.begun());
  m.look();
  return refined(std::move(m));
}

std::vector<Start> Search::starts_from(const Model& base, const Eigen::MatrixXd& columns,
                                       const std::vector<Probe>& list, const Point& point,
                                       const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                                       bool far, bool single) const {
  std::vector<std::vector<int>> extras{{}};
  for (int g = 0; g < static_cast<int>(differing.size()); ++g)
    if (!point.lets_differ(g)) extras.push_back({g});
  const std::size_t singles = extras.size();
  for (std::size_t i = 1; i < singles; ++i)
    for (std::size_t j = i + 1; j < singles; ++j) extras.push_back({extras[i][0], extras[j][0]});
  std::vector<Start> all;
  const std::size_t taken = dictionary_.names(point).size();
  for (const auto& extra : extras) {
    if (taken + extra.size() > static_cast<std::size_t>(decisive.most_together) ||
        (single && extra.size() > 1))
      continue;
    Point q = point;
    q.differ.insert(q.differ.end(), extra.begin(), extra.end());
    std::ranges::sort(q.differ);
    Error error = base.error.with(q.differ);
    if (extra.size() == 1) {  // its scale, and the rest beside it, by evidence
      const Model probe(problem_, point, base.error, base.term_N);
      error = error.fitted(residual, slopes, probe.variance(), {1.0}).first;
    }
    auto more = sets(problem_, error, q, base.term_N, residual, slopes, columns, list, far);
    std::ranges::move(more, std::back_inserter(all));
  }
  return all;
}

/// A parameter far off its sheet and an effect or fault that changes the readings alike are two hills of one
/// ridge, with nothing to be seen between them: the other one is looked at as well.
std::vector<Start> Search::twins(const Model& base, const Eigen::MatrixXd& columns,
                                 const std::vector<Probe>& list, double own) const {
  std::vector<Start> starts;
  if (dictionary_.names(base.point).size() == static_cast<std::size_t>(decisive.most_together)) return starts;
  for (Index j = 0; j < base.point.z.size(); ++j) {
    const double z = base.point.z[j];
    if (std::abs(z) < far_off) continue;
    const Eigen::MatrixXd gram = base.error.grams(z * base.slopes.col(j), columns).sum();
    for (Index c = 0; c < columns.cols(); ++c) {
      const Probe& probe = list[static_cast<std::size_t>(c)];
      const double along = gram(0, c + 1), square = gram(c + 1, c + 1);
      if (along * along < alike * gram(0, 0) * square) continue;
      const Added added = dictionary_.clipped({probe.entry, along / square, probe.shape});
      Point q = base.point;
      q.z[j] = 0.0;
      q.effects.push_back(added);
      std::ranges::sort(q.effects, {}, &Added::entry);
      starts.push_back({own + log_t(0.0) - log_t(z) + log_t(added.size) +
                            log_prior_of_set(dictionary_.names(q).size(), dictionary_.all_names) -
                            log_prior_of_set(dictionary_.names(base.point).size(), dictionary_.all_names),
                        std::move(q)});
    }
  }
  return starts;
}

/// Sets from a model: with more, and of its own with one less. `far`: of a rig as described. `first`: nothing
/// has been tried yet. Whether one of them became the best.
bool Search::look_from(Model base, bool far, bool first) {
  std::vector<Probe> list = probes(dictionary_, base.point);
  const Eigen::MatrixXd columns = columns_of(base, list);
  const Eigen::VectorXd left = base.residual();
  if (far) {  // what candidates explain is not the error's
    std::vector<Index> thin;
    for (std::size_t j = 0; j < list.size(); ++j)
      if (list[j].size == 1.0) thin.push_back(static_cast<Index>(j));
    Eigen::MatrixXd both(left.size(), base.slopes.cols() + std::ssize(thin));
    both << base.slopes, columns(Eigen::all, thin);
    Eigen::VectorXd variance(both.cols());
    variance << base.variance(), Eigen::VectorXd::Constant(std::ssize(thin), 4.0);
    base.error = base.error.fitted(left, both, variance, {1.0, 0.5}).first;
  }
  std::vector<Start> starts =
      starts_from(base, columns, list, base.point, left, base.slopes, far, far || first);
  const double own = starts.front().value;
  const auto add = [&](std::vector<Start> more) { std::ranges::move(more, std::back_inserter(starts)); };
  std::vector<Start> other_hills;
  if (!far) {
    other_hills = twins(base, columns, list, own);
    for (const int g : base.point.differ) {
      Point q = base.point;
      std::erase(q.differ, g);
      if (g == loads) continue;  // these are in the simulation
      add(starts_from(base, columns, list, q, left, base.slopes, false, false));
    }
    const auto coordinates = dictionary_.coordinates(base.point);
    for (std::size_t i = 0; i < base.point.effects.size(); ++i) {
      Point q = base.point;
      q.effects.erase(q.effects.begin() + static_cast<std::ptrdiff_t>(i));
      const Eigen::VectorXd without = problem_.simulator.read(dictionary_.setting(q));
      if (!without.allFinite()) continue;
      std::vector<Index> kept;
      for (std::size_t j = 0; j < coordinates.size(); ++j)
        if (coordinates[j].kind == Kind::parameter || coordinates[j].of != i)
          kept.push_back(static_cast<Index>(j));
      add(starts_from(base, columns, list, q, left + base.read - without, base.slopes(Eigen::all, kept),
                      false, false));
    }
  }
  std::ranges::stable_sort(starts, std::greater{}, &Start::value);
  if (!first && !outside_ && !here_->error.explains()) {
    const double terms = gain_of_terms(base), sets = starts.front().value - own;
    say(fmt::format("   general terms promise {:.1f}, sets {:.1f}", terms, sets));
    outside_ = terms > sets;
  }
  if (outside_) return false;
  const std::size_t size_of_base = dictionary_.names(base.point).size();
  std::vector<Start> chosen;
  std::set<Names> seen;
  // The best of other hills first: straight lines say nothing of it.
  if (!other_hills.empty()) {
    const Start& best = *std::ranges::max_element(other_hills, {}, &Start::value);
    const Names names = dictionary_.names(best.point);
    if (best.value > own - worth && hills_.insert(names).second) {
      chosen.push_back(best);
      seen.insert(names);
    }
  }
  for (const Start& start : starts) {
    const Names names = dictionary_.names(start.point);
    if (seen.contains(names) || ((far || first) && names.size() > size_of_base + 1)) continue;
    const auto known = table_.find({false, names});
    if (known != table_.end() && (far || known->second.score > base.score + start.value - own - worth))
      continue;
    seen.insert(names);
    if (far || start.value > own + (names.size() >= size_of_base ? worth : -worth)) chosen.push_back(start);
    if (chosen.size() == tries) break;
  }
  say(fmt::format(" from {}{}: {} tries", fmt::join(dictionary_.names(base.point), " + "),
                  far ? " on the rig as described" : "", chosen.size()));
  // The one that is best after a round; the first that explains all.
  std::optional<Model> best;
  double of_best = -std::numeric_limits<double>::infinity();
  for (const Start& start : chosen) {
    Model m = begun(start.point);
    const auto [evidence, explains] = m.read.allFinite() ? m.here() : Model::Here{of_best, false};
    say(fmt::format("   a round of {}, promised {:.1f}: {:.1f}{}",
                    fmt::join(dictionary_.names(start.point), " + "), start.value - own, evidence,
                    explains ? " explains" : ""));
    if (evidence > of_best) {
      of_best = evidence;
      best = std::move(m);
    }
    explained_ = explains && evidence > here_->score;
    if (explained_) break;
  }
  if (!best) return false;
  best = refined(std::move(*best));
  if (!(best->score > here_->score)) return false;
  here_ = std::move(best);
  prune();
  return true;
}

/// Is each needed? Without it, from these parameters and, where they are bent, from the rig as described.
void Search::prune() {
  for (bool pruned = true; pruned && dictionary_.names(here_->point).size() > 1;) {
    pruned = false;
    std::vector<Point> smaller;
    for (std::size_t i = 0; i < here_->point.effects.size(); ++i) {
      Point q = here_->point;
      q.effects.erase(q.effects.begin() + static_cast<std::ptrdiff_t>(i));
      smaller.push_back(q);
    }
    for (const int g : here_->point.differ) {
      Point q = here_->point;
      std::erase(q.differ, g);
      if (g == loads) q.run_loads_kg.clear();
      smaller.push_back(q);
    }
    for (const Point& q : smaller) {
      for (const bool described : {false, true}) {
        if (described && !bent(*here_)) continue;
        Point from = q;
        if (described) from.z.setZero();
        std::vector<double> z(from.z.begin(), from.z.end());
        if (!begun_.emplace(dictionary_.names(from), z).second) continue;
        Model m = refined(from);
        if (m.score > here_->score) {
          here_ = std::move(m);
          pruned = true;
          break;
        }
      }
      if (pruned) break;
    }
  }
}

/// By straight lines from a model, its error as it is: as sets are compared.
double Search::gain_of_terms(const Model& base) const {
  const Eigen::VectorXd left = base.residual(), of_rig = base.variance();
  double best = 0.0;
  for (const Terms terms : families) {
    const Eigen::MatrixXd columns = columns_of(base, terms);
    Eigen::MatrixXd both(left.size(), base.slopes.cols() + columns.cols());
    both << base.slopes, columns;
    const Grams grams = base.error.grams(left, both);
    const Eigen::MatrixXd gram = grams.sum();
    const Index n = base.slopes.cols();
    const double without =
        log_evidence(gram.topLeftCorner(n + 1, n + 1), grams.log_det(), left.size(), of_rig);
    for (const double scale_N : decisive.terms_N) {
      Eigen::VectorXd variance(gram.rows() - 1);
      variance << of_rig, Eigen::VectorXd::Constant(columns.cols(), scale_N * scale_N);
      best = std::max(best, log_evidence(gram, grams.log_det(), left.size(), variance) - without);
    }
  }
  return best;
}

/// Is it a law outside the catalogue?
void Search::try_terms() {
  std::vector<Model> bases{table_.at({false, {}})};
  if (!dictionary_.names(here_->point).empty()) bases.push_back(*here_);
  for (const Model& base : bases)
    for (const Terms terms : families) {
      const Eigen::MatrixXd columns = columns_of(base, terms);
      for (const double scale_N : decisive.terms_N) {
        Model m = base.with_terms(terms, columns, scale_N);
        enter(m);
      }
    }
}

Identified Search::operator()() {
  // rows
  say(fmt::format(" {} rows, {:.4g} s apart, of {} runs; unit {:.3g}, count {:.3g}, noise {:.3g}",
                  rows_.size(), rows_.row_s, rows_.runs.size(), rows_.unit, rows_.count,
                  fmt::join(rows_.noise, " ")));
  const Wander wander = problem_.simulator.wander(dictionary_.setting(dictionary_.described()));
  at_.emplace(problem_, dictionary_.nominal(), Error(rows_, wander));
  at_->look();
  // fit
  Model described(problem_, dictionary_.described(), at_->error);
  described.read = at_->read;
  described.slopes = Eigen::MatrixXd(rows_.size(), 0);
  described.fit_error({1.0, 0.5, 0.25});
  described.evidence();
  enter(described, true);
  at_->error = described.error;
  Model parameters = *at_;
  parameters.settle({.rounds = first_rounds});
  parameters.evidence();
  enter(parameters);
  here_ = parameters;
  // screen and descend: as seen from the rig as described, whose parameters have not bent to imitate what is
  // missing (unless these explain all), and from where they were fitted; then from wherever the best stands,
  // and from its effects with the parameters as described where these had to bend.
  std::set<Names> looked{{}};
  if (!parameters.arrived || bent(parameters) || !parameters.error.explains()) look_from(*at_, true, true);
  if (!parameters.arrived) {
    parameters.settle({.beat = best_score() - clear});
    parameters.hopeless = false;  // it is told whatever it is
    parameters.evidence();
    if (enter(parameters) > here_->score) here_ = parameters;
  }
  const bool contends = bent(parameters) && parameters.score > here_->score - clear;
  if ((contends || !explained_) && !dictionary_.names(here_->point).empty())
    look_from(table_.at({false, {}}), false, true);
  for (int round = 0; round < rounds && !outside_; ++round) {
    const Names names = dictionary_.names(here_->point);
    if (bent(*here_) && looked.insert(names).second) {
      Point q = here_->point;
      q.z.setZero();
      Model base(problem_, q, here_->error);
      base.look();
      if (!base.read.allFinite()) continue;
      if (here_->error.explains()) {  // the same, on this side of the valley
        Model m = refined(std::move(q));
        if (m.score > here_->score) here_ = std::move(m);
      }
      look_from(base, true, false);
    } else if (!look_from(*here_, false, names.empty())) {
      break;
    }
  }
  if (!here_->arrived) {  // to the end, for intervals
    Model last(problem_, here_->point, here_->error);
    last.look();
    last.settle({});
    last.evidence();
    enter(last);
    if (last.score > here_->score) here_ = std::move(last);
  }
  if (!here_->error.explains()) try_terms();
  // decide
  const auto groups = groups_of(rows_);
  std::vector<Judged> table;
  std::vector<const Model*> models;
  for (const auto& [key, m] : table_) {
    if (!std::isfinite(m.score) || m.hopeless) continue;
    table.push_back({.names = key.second,
                     .described = key.first,
                     .general = m.point.terms != Terms::none,
                     .score = m.score,
                     .held_out = held_out(m, groups),
                     .off_sheet = m.point.z.size() > 0 ? m.point.z.cwiseAbs().maxCoeff() : 0.0});
    models.push_back(&m);
  }
  const Decision decision = decide(table);
  const Model& chosen = *models[decision.chosen];
  return {.decision = decision,
          .table = std::move(table),
          .sizes = sizes_of(chosen),
          .parameters = parameters_of(chosen),
          .left = chosen.left(),
          .white = chosen.error.white() / rows_.unit,
          .model_error = chosen.error.of_model() / rows_.unit,
          .passes = problem_.simulator.passes()};
}

}  // namespace

Identified identify(domain::Dataset data, const Settings& settings) {
  const Usable counts = usable(data, settings.threads);
  const Rows rows(data, counts.masked, counts.runs);
  const Dictionary dictionary(data, rows.count > rows.sensor_count ? rows.count : 0.0);
  const Simulator simulator(rows, settings.threads);
  const Problem problem{rows, dictionary, simulator, settings.say};
  return Search(problem)();
}

}  // namespace mckibben::identify
