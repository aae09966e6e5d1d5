// See the header.
#include <algorithm>
#include <cmath>
#include <numeric>

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

}  // namespace

std::vector<Model> places_to_begin(const Case& c, const Model& described) {
  std::vector<Parameter> numbers;
  std::copy_if(described.free.begin(), described.free.end(), std::back_inserter(numbers), wide);
  if (numbers.empty()) return {};
  const auto bases = primes(numbers.size());
  std::vector<Model> places(of_starts.places, described);
  std::vector<double> costs(places.size(), 0.0);
  std::vector<Experiment::Change> changes;
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t j = 0; j < numbers.size(); ++j) {
      const Parameter& p = numbers[j];
      const double value = at(p, mirrored(k + 1, bases[j]));
      p.put(places[k].rig, value);
      costs[k] += p.scaled(value) * p.scaled(value);
    }
    changes.push_back({[rig = places[k].rig](Hanging& h) { h.rig = rig; }, 1.0, true});
  }
  const Runs few = a_few(c.experiment.data(), c.split.training, of_starts.runs);
  const auto flown = c.experiment.slopes(described.rig, changes, few);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto column = flown.columns.col(static_cast<Eigen::Index>(k));
    if (column.isZero(0.0)) continue;  // no rig can be simulated there
    costs[k] += (flown.residuals - column).squaredNorm() / c.inflation;
    order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  std::vector<Model> best;
  for (std::size_t i = 0; i < std::min(of_starts.begun, order.size()); ++i) best.push_back(places[order[i]]);
  return best;
}

Model begun_at(Model model, const RigFile& other) {
  for (const Parameter& p : model.free)
    if (p.has_prior && !p.of_effect()) p.put(model.rig, value_of(other, p.path));
  return model;
}

bool disagree(const std::vector<double>& costs) {
  if (costs.empty()) return false;
  const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
  return *most > *least + thresholds.near.clear + of_starts.same_cost * *least;
}

}  // namespace mckibben::diagnose
