// Where a search looks, what it begins there, and what of it is needed; see search.hpp.
#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/identify/search.hpp>

namespace mckibben::identify {

using Eigen::Index;

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
      const Added added = dictionary_.clipped({probe.entry, along / square, probe.shapes});
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
      if (g == loads) continue;  // these are in the simulation
      Point q = base.point;
      std::erase(q.differ, g);
      add(starts_from(base, columns, list, q, left, base.slopes, false, false));
    }
    const auto coordinates = dictionary_.coordinates(base.point);
    for (std::size_t i = 0; i < base.point.effects.size(); ++i) {
      const Point q = base.point.without(i);
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
  // The one that is best after a round; the first that explains all.
  std::optional<Model> best;
  double of_best = -std::numeric_limits<double>::infinity();
  for (const Start& start : chosen) untried_.push_back(dictionary_.names(start.point));
  for (const Start& start : chosen) {
    Model m = begun(start.point);
    untried_.erase(untried_.begin());
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
  untried_.clear();
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
    for (std::size_t i = 0; i < here_->point.effects.size(); ++i) smaller.push_back(here_->point.without(i));
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

}  // namespace mckibben::identify
