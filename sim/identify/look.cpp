// Where a search looks, what it begins there, and what of it is needed; see search.hpp.
#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/identify/each_run.hpp>
#include <sim/identify/search.hpp>

namespace mckibben::identify {

using Eigen::Index;

std::vector<Start> Search::starts_from(const Model& base, const Eigen::MatrixXd& columns,
                                       const std::vector<Probe>& list, const Point& point,
                                       const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                                       bool far) const {
  std::vector<Start> all =
      sets(problem_, base.error.with(point.differ), point, base.term_N, residual, slopes, columns, list, far);
  if (dictionary_.names(point).size() >= static_cast<std::size_t>(decisive.most_together)) return all;
  if (problem_.rows.data().parts_of_a_run) return all;  // one sensor read them all
  const Eigen::VectorXd variance = Model(problem_, point, base.error, base.term_N).variance();
  for (int g = 0; g < static_cast<int>(differing.size()); ++g) {
    const int label = label_of(problem_.rows.data());
    if (point.lets_differ(g) || ((g == loads || g == held_lengths) && g != label) ||
        (unlike_ && (g == zeros || g == gains || g == loads)) ||
        ((g == delays || g == drifts) && data::are_settled_points(problem_.rows.data())))
      continue;
    Point q = point;
    q.differ.push_back(g);
    std::ranges::sort(q.differ);
    // Its scale, and the rest with it, by evidence.
    const Error error = base.error.with(q.differ).fitted_anew(residual, slopes, variance);
    if (unlike_ && g == held_lengths && !most_are_right(error.grams(residual, slopes), q, g)) continue;
    std::ranges::move(sets(problem_, error, q, base.term_N, residual, slopes, columns, list, far),
                      std::back_inserter(all));
  }
  return all;
}

namespace {

/// Whether two changes have nearly one direction, of their products.
bool are_alike(double along, double square, double other_square, double least = alike) {
  return along * along >= least * square * other_square;
}

}  // namespace

/// What changes the readings like a part of a model does, in its place. Straight lines say nothing of whether
/// it is better: `value` is for comparison among these.
std::vector<Start> Search::alike_to(const Model& base, const Part& part, const Eigen::MatrixXd& columns,
                                    const std::vector<Probe>& list, double least) const {
  std::vector<Start> starts;
  const Names names = dictionary_.names(part.rest);
  if (names.size() == static_cast<std::size_t>(decisive.most_together)) return starts;
  const Eigen::MatrixXd gram = base.error.with(part.rest.differ).grams(part.change, columns).sum();
  for (Index c = 0; c < columns.cols(); ++c) {
    const Probe& probe = list[static_cast<std::size_t>(c)];
    const double along = gram(0, c + 1), square = gram(c + 1, c + 1);
    if (!are_alike(along, gram(0, 0), square, least) || part.rest.has(probe.entry)) continue;
    const Added added = dictionary_.clipped({probe.entry, along / square, probe.shapes});
    if (!(along * added.size > 0.0)) continue;  // the other way, which it cannot be
    Start start{log_t(added.size) - part.log_prior, part.rest.with(added)};
    start.value += log_prior_of_set(dictionary_.names(start.point).size(), dictionary_.all_names) -
                   log_prior_of_set(dictionary_.names(base.point).size(), dictionary_.all_names);
    if (!(start.value > -worth)) continue;
    start.value -= 0.5 * (gram(0, 0) - along * along / square);
    starts.push_back(std::move(start));
  }
  std::ranges::stable_sort(starts, std::greater{}, &Start::value);
  return starts;
}

/// With the size of what the rest has not that changes the readings least from the base's, and by how much
/// (square, whitened): far from there a straight line does not tell it.
std::pair<Point, double> Search::resized(const Model& base, Point point, const Point& rest) const {
  const auto added =
      std::ranges::find_if(point.effects, [&](const Added& one) { return !rest.has(one.entry); });
  if (added == point.effects.end()) return {std::move(point), 0.0};
  const auto at = [&](double size) {
    added->size = size;
    *added = dictionary_.clipped(*added);
    return dictionary_.setting(point);
  };
  const Error error = base.error.with(rest.differ);
  double middle = added->size, width = 0.5;  // relative
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 3; ++pass, width *= 0.25) {
    std::vector<Setting> settings{dictionary_.setting(base.point)};
    std::vector<double> sizes;
    for (int i = -3; i <= 3; ++i) {
      sizes.push_back(middle * (1.0 + width * i / 3.0));
      settings.push_back(at(sizes.back()));
    }
    const Eigen::MatrixXd off = problem_.simulator.differences(settings);
    least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const Eigen::VectorXd one = off.col(static_cast<Index>(i + 1));
      if (!one.allFinite()) continue;
      const double square = error.grams(one, Eigen::MatrixXd(one.size(), 0)).sum()(0, 0);
      if (square < least) {
        least = square;
        middle = sizes[i];
      }
    }
  }
  at(middle);
  return {std::move(point), least};
}

/// A parameter far off its sheet and an effect or fault that changes the readings alike are two hills of one
/// ridge, with nothing to be seen between them: the other one is looked at as well.
std::vector<Start> Search::twins(const Model& base, const Eigen::MatrixXd& columns,
                                 const std::vector<Probe>& list) const {
  std::vector<Start> starts;
  for (Index j = 0; j < base.point.z.size(); ++j) {
    const double z = base.point.z[j];
    if (std::abs(z) < far_off) continue;
    Part part{base.point, z * base.slopes.col(j), log_t(z) - log_t(0.0), std::nullopt};
    part.rest.z[j] = 0.0;
    std::vector<Start> more = alike_to(base, part, columns, list);
    if (!more.empty()) more.front().point = resized(base, std::move(more.front().point), part.rest).first;
    std::ranges::move(more, std::back_inserter(starts));
  }
  return starts;
}

/// What each of its own changes.
std::vector<Search::Part> Search::parts_of(const Model& base) const {
  std::vector<Part> parts;
  const auto add = [&](Part part) {
    const Eigen::VectorXd without = problem_.simulator.read(dictionary_.setting(part.rest));
    if (!without.allFinite()) return;
    part.change = base.read - without;
    parts.push_back(std::move(part));
  };
  for (std::size_t i = 0; i < base.point.effects.size(); ++i)
    add({base.point.without(i), {}, log_t(base.point.effects[i].size), i});
  for (const int g : base.point.differ)
    if (is_simulated(g))  // a number of each run, in whose place one may stand
      add({base.point.alike_in(g), {}, -worth * static_cast<double>(rows_.runs.size()), std::nullopt});
  return parts;
}

/// Sets from a model: with more, the first of them its own, and of its own with one less. `far`: of a rig as
/// described.
std::vector<Start> Search::around(const Model& base, const Eigen::MatrixXd& columns,
                                  const std::vector<Probe>& list, const std::vector<Part>& parts,
                                  bool far) const {
  const Eigen::VectorXd left = base.residual();
  std::vector<Start> starts = starts_from(base, columns, list, base.point, left, base.slopes, far);
  if (far) return starts;
  const auto add = [&](std::vector<Start> more) { std::ranges::move(more, std::back_inserter(starts)); };
  for (const int g : base.point.differ) {
    if (is_simulated(g)) continue;  // a part
    add(starts_from(base, columns, list, base.point.alike_in(g), left, base.slopes, false));
  }
  const auto coordinates = dictionary_.coordinates(base.point);
  for (const Part& part : parts) {
    std::vector<Index> kept;
    for (std::size_t j = 0; j < coordinates.size(); ++j)
      if (coordinates[j].kind == Kind::parameter ||
          coordinates[j].of != part.place.value_or(coordinates.size()))
        kept.push_back(static_cast<Index>(j));
    Model rest(problem_, part.rest, base.error);
    rest.read = base.read - part.change;
    add(starts_from(base, columns, list, part.rest, rest.residual(), base.slopes(Eigen::all, kept), false));
  }
  return starts;
}

/// Where all is explained and nothing is bent, the columns of the last look, from elsewhere, say which
/// candidates are worth another simulation: what promises anything, or changes the readings much like a part
/// does.
std::vector<Probe> Search::still_worth(const Model& base, const std::vector<Part>& parts) const {
  std::vector<Index> kept;
  std::vector<Probe> known;
  for (std::size_t j = 0; j < seen_.list.size(); ++j) {
    if (base.point.has(seen_.list[j].entry)) continue;
    kept.push_back(static_cast<Index>(j));
    known.push_back(seen_.list[j]);
  }
  const Eigen::MatrixXd columns = seen_.columns(Eigen::all, kept);
  std::vector<Start> starts = around(base, columns, known, parts, false);
  const double own = starts.front().value;
  std::erase_if(starts, [&](const Start& one) { return !(one.value > own - worth); });
  const auto add = [&](std::vector<Start> more) { std::ranges::move(more, std::back_inserter(starts)); };
  for (Part part : parts) {
    add(alike_to(base, part, columns, known, 0.5 * alike));
    // And what was like it where that look was made.
    for (std::size_t j = 0; j < seen_.list.size(); ++j) {
      if (!part.place || seen_.list[j].entry != base.point.effects[*part.place].entry) continue;
      part.change = seen_.columns.col(static_cast<Index>(j));
      add(alike_to(base, part, columns, known, 0.5 * alike));
    }
  }
  std::set<std::size_t> entries;
  for (const Start& start : starts)
    for (const Added& added : start.point.effects) entries.insert(added.entry);
  std::vector<Probe> list = probes(dictionary_, base.point);
  std::erase_if(list, [&](const Probe& one) { return !entries.contains(one.entry); });
  return list;
}

/// `first`: nothing has been tried yet. Whether a set became the best.
bool Search::look_from(Model base, bool far, bool first) {
  step("looking for what would explain more");
  const std::vector<Part> parts = far ? std::vector<Part>{} : parts_of(base);
  const bool again = !far && base.error.explains() && !bent(base) && !seen_.list.empty();
  std::vector<Probe> list = again ? still_worth(base, parts) : probes(dictionary_, base.point);
  const Eigen::MatrixXd columns = columns_of(base, list);
  if (!again) seen_ = {list, columns};
  if (far || !base.error.explains()) {  // what candidates explain is not the error's
    const Eigen::VectorXd left = base.residual();
    std::vector<Index> thin;
    for (std::size_t j = 0; j < list.size(); ++j)
      if (list[j].size == 1.0) thin.push_back(static_cast<Index>(j));
    Eigen::MatrixXd both(left.size(), base.slopes.cols() + std::ssize(thin));
    both << base.slopes, columns(Eigen::all, thin);
    Eigen::VectorXd variance(both.cols());
    variance << base.variance(), Eigen::VectorXd::Constant(std::ssize(thin), 4.0);
    base.error = base.error.fitted(left, both, variance, {1.0, 0.5}).first;
  }
  std::vector<Start> starts = around(base, columns, list, parts, far);
  const double own = starts.front().value;
  const std::vector<Start> other_hills = far ? std::vector<Start>{} : twins(base, columns, list);
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
  // The best of other hills first: straight lines say nothing of whether it is higher.
  if (!other_hills.empty()) {
    const Start& best = *std::ranges::max_element(other_hills, {}, &Start::value);
    const Names names = dictionary_.names(best.point);
    if (hills_.insert(names).second) {
      seen.insert(names);
      if (take(refined(best.point))) {
        prune();
        return true;
      }
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
  // A round of each, or of the first ones if one of them explains all; then of the most promising one, until
  // none promises more than the best one is.
  struct Try {
    Model model;
    Model::Here here;
  };
  std::vector<Try> begun_ones;
  const auto tell = [&](const Try& one) {
    say(fmt::format("   a round of {}: {:.1f}, {:.1f} hoped for{}",
                    fmt::join(dictionary_.names(one.model.point), " + "), one.here.evidence, one.here.hoped,
                    one.here.explains ? " explains" : ""));
  };
  for (const Start& start : chosen) untried_.push_back(dictionary_.names(start.point));
  for (const Start& start : chosen) {
    Model m = begun(start.point);
    untried_.erase(untried_.begin());
    if (!m.read.allFinite()) continue;
    const Model::Here now = m.here();
    begun_ones.push_back({std::move(m), now});
    tell(begun_ones.back());
    explained_ = now.explains && now.evidence > here_->score;
    if (explained_) break;
  }
  untried_.clear();
  const auto best_by = [&](double Model::Here::*value) {
    return std::ranges::max_element(begun_ones, {}, [&](const Try& one) { return one.here.*value; });
  };
  for (std::size_t more = 0; more < begun_ones.size(); ++more) {
    const auto next = best_by(&Model::Here::hoped), best = best_by(&Model::Here::evidence);
    if (next == best || next->model.arrived) break;
    step("trying what promises most");
    next->model.far = false;
    next->model.settle({.rounds = 1});
    const Model::Here before = std::exchange(next->here, next->model.here());
    if (next->here.evidence < before.evidence + worth) next->here.hoped = next->here.evidence;  // in vain
    tell(*next);
  }
  if (!begun_ones.empty() && take(refined(std::move(best_by(&Model::Here::evidence)->model)))) {
    prune();
    return true;
  }
  for (const Part& part : parts) {
    std::vector<Start> rivals = of_other_sides(base, part);
    std::ranges::move(alike_to(base, part, columns, list, 0.5 * alike), std::back_inserter(rivals));
    try_rivals(base, rivals, part);
  }
  return false;
}

/// Of a pair, the same law as an effect at work, of another muscle or of both, where that changes the
/// readings alike; sizes add up.
std::vector<Start> Search::of_other_sides(const Model& base, const Part& part) const {
  using diagnose::Side;
  std::vector<Start> starts;
  if (!part.place) return starts;
  const Added& added = base.point.effects[*part.place];
  const auto& of = dictionary_.entries[added.entry].effect;
  for (std::size_t k = 0; of && k < dictionary_.entries.size(); ++k) {
    const auto& other = dictionary_.entries[k].effect;
    if (!other || other->effect != of->effect || other->variant != of->variant || other->side == of->side)
      continue;
    const double share = of->side == Side::both ? 2.0 : other->side == Side::both ? 0.5 : 1.0;
    Start start{0.0, part.rest.with(dictionary_.clipped({k, share * added.size, added.shapes}))};
    const Eigen::VectorXd read = problem_.simulator.read(dictionary_.setting(start.point));
    if (!read.allFinite()) continue;
    const Eigen::MatrixXd change = read - (base.read - part.change);
    const Eigen::MatrixXd gram = base.error.grams(part.change, change).sum();
    if (gram(0, 1) > 0.0 && are_alike(gram(0, 1), gram(0, 0), gram(1, 1))) starts.push_back(std::move(start));
  }
  return starts;
}

/// What may stand for one of the names as well: told beside it, or better after all.
void Search::try_rivals(const Model& base, const std::vector<Start>& starts, const Part& part) {
  const Error error = base.error.with(part.rest.differ);
  const double square = error.grams(part.change, Eigen::MatrixXd(part.change.size(), 0)).sum()(0, 0);
  std::set<Names> tried;
  for (const Start& start : starts) {
    const Names names = dictionary_.names(start.point);
    if (tried.size() == most_rivals) break;
    const auto known = table_.find({false, names});
    if (known != table_.end() && known->second.score > here_->score - clear) continue;
    if (!tried.insert(names).second) continue;
    auto [point, missed] = resized(base, start.point, part.rest);
    if (missed > (1.0 - alike) * square) continue;
    take(refined(std::move(point)));
  }
}

/// What may be of no size goes if the rest does as well from where it stands: any other beginning may be in
/// another valley.
void Search::drop_what_may_be_nothing() {
  for (bool dropped = true; std::exchange(dropped, false);)
    for (const std::size_t i : here_->may_be_nothing()) {
      Model without(problem_, here_->point.without(i), here_->error, here_->term_N);
      without.far = false;
      without.look();
      if ((dropped = take(refined(std::move(without))))) break;
    }
}

/// Is each needed? Without it, from these parameters and, where they are bent, from the rig as described.
void Search::prune() {
  for (bool pruned = true; pruned && dictionary_.names(here_->point).size() > 1;) {
    pruned = false;
    std::vector<Point> smaller;
    for (std::size_t i = 0; i < here_->point.effects.size(); ++i) smaller.push_back(here_->point.without(i));
    for (const int g : here_->point.differ) smaller.push_back(here_->point.alike_in(g));
    for (const Point& q : smaller) {
      for (const bool described : {false, true}) {
        if (described && !bent(*here_)) continue;
        Point from = q;
        if (described) from.z.setZero();
        std::vector<double> z(from.z.begin(), from.z.end());
        if (!begun_.emplace(dictionary_.names(from), z).second) continue;
        pruned = take(refined(from, here_->term_N));
        if (pruned) break;
      }
      if (pruned) break;
    }
  }
}

}  // namespace mckibben::identify
