// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/starts.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const StartsThresholds& of_starts = thresholds.starts;

/// A number of 0 is none of another order of magnitude.
bool wide(const Parameter& p) {
  return p.has_prior && !p.of_effect() && p.origin != 0.0 && p.scale > of_starts.wide * std::abs(p.origin);
}

/// The k-th number of van der Corput's sequence to a base: its digits, mirrored at the point.
double mirrored(std::size_t k, std::size_t base) {
  double value = 0.0, digit = 1.0;
  for (; k > 0; k /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(k % base);
  }
  return value;
}

std::vector<std::size_t> primes(std::size_t count) {
  std::vector<std::size_t> list;
  for (std::size_t n = 2; list.size() < count; ++n)
    if (std::none_of(list.begin(), list.end(), [&](std::size_t prime) { return n % prime == 0; }))
      list.push_back(n);
  return list;
}

/// A place in the range that a prior makes likely.
double at(const Parameter& p, double share) {
  const double reach = of_starts.reach * p.scale;
  return std::lerp(std::max(p.lowest, p.origin - reach), std::min(p.highest, p.origin + reach), share);
}

/// So many of the places, by their misfit in a few of the training runs and what the priors say of them.
std::vector<Model> best_of(const Case& c, const Model& described, std::vector<Model> places,
                           std::size_t most) {
  std::vector<Experiment::Change> changes;
  changes.reserve(places.size());
  for (const Model& place : places)
    changes.push_back({[&place](Loaded& h) { h.rig = place.rig; }, 1.0, true});
  const auto flown = c.experiment.slopes(described.rig, changes,
                                         a_few(c.experiment.data(), c.split.training, of_starts.runs));
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto column = flown.columns.col(static_cast<Eigen::Index>(k));
    if (column.isZero(0.0)) continue;  // no rig can be simulated there, or nothing is moved
    double cost = (flown.residuals - column).squaredNorm() / c.inflation;
    for (const Parameter& p : described.free)
      if (p.has_prior) cost += std::pow(p.scaled(value_of(places[k].rig, p.path)), 2);
    order.emplace_back(cost, k);
  }
  std::sort(order.begin(), order.end());
  std::vector<Model> best;
  for (std::size_t i = 0; i < std::min(most, order.size()); ++i)
    best.push_back(std::move(places[order[i].second]));
  return best;
}

}  // namespace

std::vector<Model> places_to_begin(const Case& c, const Model& described) {
  std::vector<Parameter> numbers;
  std::copy_if(described.free.begin(), described.free.end(), std::back_inserter(numbers), wide);
  if (numbers.empty()) return {};
  const auto bases = primes(numbers.size());
  std::vector<Model> places(of_starts.places, described);
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t j = 0; j < numbers.size(); ++j)
      numbers[j].put(places[k].rig, at(numbers[j], mirrored(k + 1, bases[j])));
  return best_of(c, described, std::move(places), of_starts.begun);
}

std::vector<Model> one_number_far_off(const Case& c, const Model& described) {
  std::vector<Model> places;
  for (const Parameter& p : described.free) {
    if (!p.has_prior || p.of_effect()) continue;
    for (const double way : {-of_starts.far, of_starts.far}) {
      places.push_back(described);
      p.put(places.back().rig, std::clamp(p.origin + way * p.scale / p.widened, p.lowest, p.highest));
    }
  }
  return best_of(c, described, std::move(places), 1);
}

Model begun_at(Model model, const Rig& other) {
  for (const Parameter& p : model.free)
    if (p.has_prior && !p.of_effect()) p.put(model.rig, value_of(other, p.path));
  return model;
}

std::vector<Model> in_other_shapes(const Model& model, std::vector<const Rig*> rigs) {
  rigs.push_back(&model.rig);
  std::vector<Model> places;
  for (const Rig* rig : rigs) {
    const Model there = begun_at(model, *rig);
    for (const Candidate& effect : model.effects)
      for (const double shape : effect.shapes) {
        places.push_back(there);
        effect.put(places.back().rig, value_of(there.rig, effect.amplitude), shape);
      }
  }
  return places;
}

void deepen(const Case& c, Contender& end, const std::vector<const Rig*>& others, const Step& step) {
  const auto arrived = [&] { return near_floor(end.fitted.residuals) && !bent(end.fitted, c.inflation); };
  if (!is_doubtful(c, end) || arrived()) return;
  const Model model = end.fitted.model;
  std::vector<std::string> names;
  for (const Candidate& effect : model.effects) names.push_back(title(effect));
  step(fmt::format("trying {} from other numbers", fmt::join(names, " with ")));
  const auto begin = [&](Model place) {
    if (arrived()) return;
    Contender other = contend(c, std::move(place));
    if (other.fitted.failure.empty() && other.fitted.cost < end.fitted.cost &&
        other.held_out.squaredNorm() <= end.held_out.squaredNorm())
      end = std::move(other);
  };
  for (const Rig* rig : others) begin(begun_at(model, *rig));
  if (arrived()) return;
  for (Model& place : best_of(c, model, in_other_shapes(model, others), of_starts.begun))
    begin(std::move(place));
  if (arrived()) return;
  for (Model& place : one_number_far_off(c, begun_at(model, *others.front()))) begin(std::move(place));
}

void deepen_best(const Case& c, std::vector<Trial>& trials, const std::vector<const Rig*>& others,
                 const Step& step) {
  Trial* best = nullptr;
  for (Trial& trial : trials)
    if (has_size(trial.contender.fitted.model, trial.score.candidate) &&
        (best == nullptr || trial.contender.fitted.cost < best->contender.fitted.cost))
      best = &trial;
  if (best != nullptr) deepen(c, best->contender, others, step);
}

void catch_up(const Case& c, std::vector<Trial>& trials, const Step& step) {
  const auto cost = [](const Trial& trial) { return trial.contender.fitted.cost; };
  // Once one that caught up is ahead, others may catch up with it.
  for (const Trial* last = nullptr; !trials.empty();) {
    const Trial& best = *std::ranges::min_element(trials, {}, cost);
    if (&best == last || !near_floor(best.contender.fitted.residuals)) return;
    last = &best;
    for (Trial& rival : trials) {
      Contender& end = rival.contender;
      if (likeness(rival.score, best.score) < of_starts.likeness_of_arrived ||
          as_good(c, best.contender, end))
        continue;
      step(fmt::format("trying {} from other numbers", title(rival.score.candidate)));
      begin_too(c, end, begun_at(end.fitted.model, best.contender.fitted.model.rig));
    }
  }
}

bool disagree(const std::vector<double>& costs) {
  if (costs.empty()) return false;
  const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
  return *most > *least + thresholds.near.clear + of_starts.same_cost * *least;
}

}  // namespace mckibben::diagnose
