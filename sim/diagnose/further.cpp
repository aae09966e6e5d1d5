// See the header.
#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/further.hpp>
#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/revise.hpp>
#include <sim/diagnose/starts.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const FurtherThresholds& of_further = thresholds.further;

bool may_widen(const Parameter& p, const RigFile& nominal) {
  const auto stated = nominal.spreads.find(p.path);
  const bool unknown = stated != nominal.spreads.end() && !std::isfinite(stated->second);
  return p.has_prior && !p.of_effect() && p.widened == 1.0 && !unknown;
}

/// Bounds that stand where the deviation puts them move with it, as far as the number's range goes.
void widen(Parameter& p, RigFile rig) {
  const Found found = find(rig, p.path);
  const double most = thresholds.parameter.most_deviations * p.scale;
  const double near = of_further.same_bound * most;
  if (std::abs(p.origin - most - p.lowest) < near)
    p.lowest = std::max(found.lowest, p.origin - of_further.wider * most);
  if (std::abs(p.origin + most - p.highest) < near)
    p.highest = std::min(found.highest, p.origin + of_further.wider * most);
  p.scale *= of_further.wider;
  p.widened = of_further.wider;
}

/// Numbers further off than they are stated to be.
std::vector<std::string> exceeding(const Model& model) {
  std::vector<std::string> list;
  for (const Parameter& p : model.free) {
    if (!p.has_prior || p.of_effect()) continue;
    const double deviations = p.deviations(value_of(model.rig, p.path));
    if (std::abs(deviations) > thresholds.parameter.most_deviations)
      list.push_back(fmt::format("{} {:+.1f} deviations off", p.path, deviations));
  }
  return list;
}

/// A model as it stands, on the training runs; none if it cannot be simulated.
std::optional<Fitted> as_it_stands(const Case& c, Model model) {
  try {
    auto at = c.experiment.slopes(model.rig, model.free, c.split.training);
    Fitted fitted{
        .model = std::move(model), .residuals = std::move(at.residuals), .columns = std::move(at.columns)};
    fitted.cost = fitted.residuals.squaredNorm() / c.inflation;
    return fitted;
  } catch (const engine::NumericalFailure&) {
    return std::nullopt;
  }
}

}  // namespace

Fitted with_wider_numbers(Fitted fitted, const Case& c) {
  for (std::size_t j = 0; j < fitted.model.free.size(); ++j) {
    Parameter& p = fitted.model.free[j];
    if (!may_widen(p, c.nominal)) continue;
    widen(p, fitted.model.rig);
    if (fitted.columns.size() > 0) fitted.columns.col(static_cast<Eigen::Index>(j)) *= of_further.wider;
  }
  return fitted;
}

double least_by_numbers(const Fitted& fitted, double inflation) {
  const auto& free = fitted.model.free;
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(count),
                  priors = Eigen::VectorXd::Constant(count, thresholds.screen.ridge);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Parameter& p = free[static_cast<std::size_t>(j)];
    if (!p.has_prior) continue;
    priors[j] = 1.0;
    moved[j] = p.scaled(value_of(fitted.model.rig, p.path));
  }
  Eigen::MatrixXd normal = fitted.columns.transpose() * fitted.columns / inflation;
  normal.diagonal() += priors;
  const Eigen::VectorXd step = normal.ldlt().solve(fitted.columns.transpose() * fitted.residuals / inflation -
                                                   priors.cwiseProduct(moved));
  const Eigen::VectorXd left = fitted.residuals - fitted.columns * step;
  return left.squaredNorm() / inflation + (moved + step).cwiseAbs2().dot(priors);
}

namespace {

/// The best fit of wider numbers from these bases; without those from which straight lines miss too much of
/// what is to be gained down to `cost`. None if no number departs further than it is stated to.
std::optional<Contender> best_numbers(const Case& c, const Bases& bases, double cost) {
  std::optional<Contender> best;
  const auto begin = [&](Model model) {
    Contender numbers = contend(c, std::move(model));
    if (!numbers.fitted.failure.empty() || (best && best->fitted.cost <= numbers.fitted.cost)) return;
    best = std::move(numbers);
  };
  for (const Fitted* base : bases) {
    const Fitted wider = with_wider_numbers(*base, c);
    const double gain = std::max(0.0, base->cost - cost);
    if (least_by_numbers(wider, c.inflation) > cost + thresholds.near.clear + of_further.hopeless * gain)
      continue;
    begin(wider.model);
    if (best && meets(*best)) break;
    for (Model& place : one_number_far_off(c, wider.model)) begin(std::move(place));
    if (best && meets(*best)) break;
  }
  if (best && exceeding(best->fitted.model).empty()) best.reset();
  return best;
}

}  // namespace

std::optional<Contender> numbers_as_good(const Case& c, const Bases& bases, const Contender& named) {
  auto numbers = best_numbers(c, bases, named.fitted.cost);
  if (numbers && !as_good(c, named, *numbers)) numbers.reset();
  return numbers;
}

std::optional<Contender> numbers_that_close(const Case& c, const Bases& bases,
                                            const Eigen::VectorXd& before) {
  auto numbers = best_numbers(c, bases, 0.0);
  if (!numbers) return numbers;
  const auto gain = compare(c.experiment, before, numbers->held_out, c.split.held_out);
  const bool near = all_near_floor(c.experiment, numbers->fitted.residuals, c.split.training) &&
                    all_near_floor(c.experiment, numbers->held_out, c.split.held_out);
  if (!near || !convinces(gain) || gain.share < thresholds.improvement.clear_share) numbers.reset();
  return numbers;
}

bool numbers_reach_all(const Case& c, const Model& described, const Runs& usable) {
  const Case of_all{c.experiment, c.nominal, {usable, {}}, c.inflation, c.learned};
  const auto from = as_it_stands(of_all, described);
  if (!from) return false;
  const Fitted wider = with_wider_numbers(*from, of_all);
  if (least_by_numbers(wider, c.inflation) > of_further.hopeless * from->cost) return false;
  const Fitted fitted = fit(c.experiment, wider.model, usable, {.inflation = c.inflation});
  return fitted.failure.empty() && all_near_floor(c.experiment, fitted.residuals, usable);
}

namespace {

void replace(Naming& result, const Candidate& effect, const Contender& numbers) {
  give_up(result.ranking, effect,
          fmt::format("other numbers do as well: {}", fmt::join(exceeding(numbers.fitted.model), ", ")));
  forget(result, effect);
}

}  // namespace

void prefer_numbers(const Case& c, const Bases& bases, Naming& result, const Step& step) {
  step("trying other numbers instead of what was named");
  if (auto numbers = numbers_as_good(c, bases, result.best)) {
    for (const Candidate& effect : result.best.fitted.model.effects) replace(result, effect, *numbers);
    result.best = std::move(*numbers);
    return;
  }
  const auto& effects = result.best.fitted.model.effects;
  if (effects.size() < 2) return;
  for (std::size_t i = 0; i < effects.size();) {
    step("trying other numbers instead of " + title(effects[i]));
    std::optional<Contender> numbers;
    if (const auto from = as_it_stands(c, without(result.best.fitted.model, i)))
      numbers = numbers_as_good(c, {&*from}, result.best);
    if (!numbers) {
      ++i;
      continue;
    }
    replace(result, effects[i], *numbers);
    result.best = std::move(*numbers);
  }
}

}  // namespace mckibben::diagnose
