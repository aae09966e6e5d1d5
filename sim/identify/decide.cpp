// See the header.
#include <algorithm>
#include <cmath>
#include <functional>

#include <sim/diagnose/thresholds.hpp>
#include <sim/identify/decide.hpp>
#include <sim/identify/decisive.hpp>

namespace mckibben::identify {

Loss loss(const Eigen::VectorXd& of_better, const Eigen::VectorXd& of_worse) {
  const Eigen::VectorXd d = of_better - of_worse;
  const auto n = static_cast<double>(d.size());
  if (d.size() < 2) return {d.sum(), 0.0};
  const double scatter = (d.array() - d.mean()).square().sum() / (n - 1.0);
  return {d.sum(), std::sqrt(n * scatter)};
}

double chi_square(double share, std::size_t degrees) {
  const auto n = static_cast<double>(degrees);
  // The normal quantile, by bisection.
  double low = -8.0, high = 8.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
  }
  const double a = 2.0 / (9.0 * n), root = 1.0 - a + low * std::sqrt(a);
  return n * root * root * root;
}

namespace {

Verdict verdict_of(const Scored& model) {
  if (model.described) return Verdict::nothing_missing;
  if (model.general) return Verdict::unknown_effect;
  return model.names.empty() ? Verdict::recalibrate : Verdict::missing_effect;
}

bool allowed(const Scored& model) {
  return model.off_sheet < decisive.conflict;
}

int size_of(const Scored& model) {
  return static_cast<int>(model.names.size()) - (model.described ? 1 : 0);
}

/// What the bench has wrong in a run says nothing of unseen ones: of its faults the evidence decides.
bool lacks_a_fault_of(const Scored& one, const Scored& reference) {
  return one.score < reference.score - decisive.strong &&
         !std::ranges::includes(one.faults, reference.faults);
}

}  // namespace

bool closes_the_gap_of(const Scored& model, const Scored& other) {
  return model.score > other.score + decisive.strong &&
         model.above_noise <= (1.0 - diagnose::thresholds.tell.closed) * other.above_noise &&
         other.above_noise > 0.0;
}

Decision decide(const std::vector<Scored>& table) {
  Decision decision;
  decision.best =
      static_cast<std::size_t>(std::ranges::max_element(table, {}, &Scored::score) - table.begin());
  double all = 0.0;
  for (const Scored& model : table) {
    decision.mass.push_back(std::exp(model.score - table[decision.best].score));
    all += decision.mass.back();
  }
  for (double& one : decision.mass) one /= all;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (i != decision.best && decision.mass[i] > decisive.mass) decision.rivals.push_back(i);
  std::ranges::sort(decision.rivals, std::greater{}, [&](std::size_t i) { return table[i].score; });
  // A rival that the sheet allows stands for a best one that it does not, and one that predicts better for
  // one that does not, if it names no more: runs that repeat each other repeat a model's error, too.
  // Before that, general terms beat the catalogue by strong evidence or not at all.
  std::size_t named = decision.best;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (!table[i].general && (table[named].general || table[i].score > table[named].score)) named = i;
  std::size_t reference =
      table[named].score > table[decision.best].score - decisive.strong ? named : decision.best;
  for (const std::size_t i : decision.rivals) {
    if (!allowed(table[i]) || (table[i].general && !table[reference].general)) continue;
    const auto [nats, error] = loss(table[i].held_out, table[reference].held_out);
    const bool adds_names = !table[reference].general && size_of(table[i]) > size_of(table[reference]);
    if (!allowed(table[reference]) ||
        (!adds_names && nats > std::max(decisive.errors * error, decisive.strong)))
      reference = i;
  }
  decision.chosen = reference;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto [nats, error] = loss(table[reference].held_out, table[i].held_out);
    if (!std::isfinite(table[i].score) || !(nats <= decisive.errors * error) || !allowed(table[i])) continue;
    if (table[i].general) continue;  // many terms are not simple
    // What leaves the gap is no simpler way to close it.
    if (closes_the_gap_of(table[reference], table[i]) || lacks_a_fault_of(table[i], table[reference]))
      continue;
    const Scored& chosen = table[decision.chosen];
    if (!allowed(chosen) || chosen.general || size_of(table[i]) < size_of(chosen) ||
        (size_of(table[i]) == size_of(chosen) && table[i].score > chosen.score))
      decision.chosen = i;
  }
  decision.verdict = verdict_of(table[decision.chosen]);
  decision.contradicts_sheet = !allowed(table[decision.chosen]);
  return decision;
}

bool does_as_well(const std::vector<Scored>& table, const Decision& decision, std::size_t i, double strong) {
  const Scored &chosen = table[decision.chosen], &other = table[i];
  if (closes_the_gap_of(chosen, other)) return false;
  if (allowed(chosen) && !allowed(other) && decision.mass[i] < decisive.mass) return false;
  const auto [nats, error] = loss(chosen.held_out, other.held_out);
  return std::max(nats, chosen.score - other.score) <=
         std::max(decisive.errors * error, strong * decisive.strong);
}

}  // namespace mckibben::identify
