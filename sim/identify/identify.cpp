// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/identify/decisive.hpp>
#include <sim/identify/held_out.hpp>
#include <sim/identify/identify.hpp>
#include <sim/identify/screen.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

// How far the search goes.
constexpr int rounds = 4;
constexpr int first_rounds = 4;       // of the parameters, before effects are looked for
constexpr std::size_t tries = 2;      // a look
const double worth = std::log(20.0);  // nats, of another try (Kass & Raftery 1995: strong)
constexpr double clear = 20.0;        // nats behind: hopeless
constexpr double far_off = 3.0;       // deviations of a parameter: something may stand in its place
constexpr double alike = 0.9;         // squared cosine of what both change

using Names = std::vector<std::string>;

/// The budget is used up.
struct OutOfWork : run::Interrupted {};

/// What a search does one after the other, as it is told where it was ended.
constexpr std::array stages{"the rig's parameters", "effects and bench faults",
                            "general terms, for what is outside the catalogue"};

class Search {
 public:
  Search(const Problem& problem, const Settings& settings)
      : problem_(problem), settings_(settings), dictionary_(problem.dictionary), rows_(problem.rows) {}

  /// The rig as described: there is a result from here on.
  void begin();
  /// Until nothing gains any more. Throws run::Interrupted; what was found by then stands.
  void go_on();

  bool is_out_of_work() const { return problem_.simulator.passes() > settings_.most_passes; }
  /// What `go_on` has not done to its end.
  std::vector<std::string> not_done() const;
  /// Decides on the table.
  Identified found() &&;

 private:
  using Key = std::pair<bool, Names>;  // described; names

  void say(const std::string& what) const {
    if (problem_.say) problem_.say(what);
  }
  /// Begins something that takes a while.
  void step(const std::string& what) const {
    if (settings_.trying) settings_.trying(what);
    if (is_out_of_work()) throw OutOfWork();
  }
  double enter(Model& model, bool described = false);
  double best_score() const;
  Model refined(Point point);
  /// By more than chance.
  static bool bent(const Model& model) {
    const Eigen::VectorXd& z = model.point.z;
    return z.size() > 0 && (z.cwiseAbs().maxCoeff() > far_off ||
                            z.squaredNorm() > chi_square(decisive.bent, static_cast<std::size_t>(z.size())));
  }
  std::vector<Start> starts_from(const Model& base, const Eigen::MatrixXd& columns,
                                 const std::vector<Probe>& probes, const Point& point,
                                 const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes, bool far,
                                 bool single) const;
  std::vector<Start> twins(const Model& base, const Eigen::MatrixXd& columns,
                           const std::vector<Probe>& probes, double own) const;
  bool look_from(Model base, bool far, bool first);
  void prune();
  void try_terms();

  const Problem& problem_;
  const Settings& settings_;
  const Dictionary& dictionary_;
  const Rows& rows_;
  std::map<Key, Model> table_;
  std::optional<Model> here_, at_;
  std::set<std::pair<Names, std::vector<double>>> begun_;
  std::set<Names> hills_;
  std::size_t stage_ = 0;
  std::vector<Names> untried_;                ///< of the look that is under way
  std::map<std::string, double> promised_{};  ///< nats that a look saw in a name alone, the most of them
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
  else if (model.score > known->second.score)
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

Model Search::refined(Point point) {
  step(fmt::format("trying {}", fmt::join(dictionary_.names(point), " + ")));
  Model m(problem_, std::move(point), at_->error.begun());  // no descent depends on those before it
  m.look();
  m.settle({.beat = best_score() - clear});
  m.evidence();
  enter(m);
  return m;
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
  step("looking for what would explain more");
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
      const std::vector<Setting> setting{dictionary_.setting(q)};
      const Eigen::VectorXd without = problem_.simulator.read(setting).col(0);
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
  const Names of_base = dictionary_.names(base.point);
  const std::size_t size_of_base = of_base.size();
  for (const Start& start : starts)
    for (const std::string& name : dictionary_.names(start.point))
      if (dictionary_.names(start.point).size() == size_of_base + 1 &&
          !std::ranges::binary_search(of_base, name))
        promised_[name] = std::max(promised_[name], start.value - own);
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
  bool gained = false;
  for (const Start& start : chosen) untried_.push_back(dictionary_.names(start.point));
  for (const Start& start : chosen) {
    say(fmt::format("   try {} promised {:.1f}", fmt::join(dictionary_.names(start.point), " + "),
                    start.value - own));
    Model m = refined(start.point);
    untried_.erase(untried_.begin());
    if (m.score > here_->score) {
      here_ = std::move(m);
      gained = true;
    }
    if (gained && here_->error.explains()) break;
  }
  untried_.clear();
  if (gained) prune();
  return gained;
}

/// Is each needed? Without it, from the rig as described and from these parameters.
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
      for (const bool described : {true, false}) {
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

/// Is it a law outside the catalogue?
void Search::try_terms() {
  std::vector<Model> bases{table_.at({false, {}})};
  if (!dictionary_.names(here_->point).empty()) bases.push_back(*here_);
  for (const Model& base : bases)
    for (const Terms terms : {Terms::smooth, Terms::waves, Terms::rubs}) {
      step("trying general terms");
      const Eigen::MatrixXd columns = columns_of(base, terms);
      for (const double scale_N : decisive.terms_N) {
        Model m = base.with_terms(terms, columns, scale_N);
        enter(m);
      }
    }
}

void Search::begin() {
  // rows
  step("simulating the rig as described");
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
}

void Search::go_on() {
  step("fitting the rig's parameters");
  Model parameters = *at_;
  const bool arrived = parameters.settle({.rounds = first_rounds});
  parameters.evidence();
  enter(parameters);
  here_ = parameters;
  stage_ = 1;
  // screen and descend: as seen from the rig as described, whose parameters have not bent to imitate what is
  // missing (unless these explain all), and from where they were fitted; then from wherever the best stands,
  // and from its effects with the parameters as described where these had to bend.
  std::set<Names> looked{{}};
  if (bent(parameters) || !parameters.error.explains()) look_from(*at_, true, true);
  if (!arrived) {
    parameters.settle({.beat = best_score() - clear});
    parameters.evidence();
    if (enter(parameters) > here_->score) here_ = parameters;
  }
  const bool contends = parameters.score > here_->score - clear;
  if (dictionary_.names(here_->point).empty() || !here_->error.explains() || (bent(parameters) && contends))
    look_from(table_.at({false, {}}), false, true);
  for (int round = 0; round < rounds; ++round) {
    const Names names = dictionary_.names(here_->point);
    if (bent(*here_) && looked.insert(names).second) {
      Point q = here_->point;
      q.z.setZero();
      Model base(problem_, std::move(q), here_->error);
      base.look();
      if (base.read.allFinite()) look_from(base, true, false);
    } else if (!look_from(*here_, false, false)) {
      break;
    }
  }
  step("fitting what was found to the end");
  Model last(problem_, here_->point, here_->error);  // to the end, for intervals
  last.look();
  last.settle({.rounds = 12, .enough = 0.1});
  last.evidence();
  enter(last);
  if (last.score > here_->score) here_ = std::move(last);
  stage_ = 2;
  if (!here_->error.explains()) try_terms();
  stage_ = stages.size();
}

std::vector<std::string> Search::not_done() const {
  std::vector<std::string> list;
  for (std::size_t i = stage_; i < stages.size(); ++i) list.emplace_back(stages.at(i));
  for (const Names& names : untried_) list.push_back(fmt::format("trying {}", fmt::join(names, " + ")));
  return list;
}

Identified Search::found() && {
  Identified result;
  const auto groups = groups_of(rows_);
  for (auto& [key, m] : table_) {
    if (!std::isfinite(m.score)) continue;
    result.table.push_back({.names = key.second,
                            .described = key.first,
                            .general = m.point.terms != Terms::none,
                            .score = m.score,
                            .held_out = held_out(m, groups),
                            .off_sheet = m.point.z.size() > 0 ? m.point.z.cwiseAbs().maxCoeff() : 0.0});
    result.models.push_back(std::move(m));
  }
  result.decision = decide(result.table);
  result.promised = std::move(promised_);
  result.passes = problem_.simulator.passes();
  return result;
}

}  // namespace

Identified identify(domain::Dataset data, const Settings& settings) {
  diagnose::Search limit(settings.time_limit_s);
  auto study = std::make_shared<const Study>(std::move(data), settings);
  Search search(study->problem, settings);
  search.begin();
  limit.part("", [&] { search.go_on(); });
  const bool worked = search.is_out_of_work();
  std::vector<std::string> not_done = search.not_done();
  Identified found = std::move(search).found();
  found.study = std::move(study);
  found.ended = limit.ended();
  if (found.ended != Ended::no) {
    if (found.ended == Ended::by_time && worked) found.ended = Ended::by_work;
    found.not_done = std::move(not_done);
  }
  return found;
}

}  // namespace mckibben::identify
