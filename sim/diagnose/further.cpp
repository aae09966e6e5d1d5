// See the header.
#include <algorithm>
#include <cmath>

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

bool may_widen(const Parameter& p, const Rig& nominal) {
  const auto stated = nominal.spreads.find(p.path);
  const bool unknown = stated != nominal.spreads.end() && !std::isfinite(stated->second);
  return p.has_prior && !p.of_effect() && p.widened == 1.0 && !unknown;
}

/// Bounds that stand where the deviation puts them move with it, as far as the number's range goes.
void widen(Parameter& p, Rig rig) {
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

namespace {

/// Of a fit that leaves noise alone.
double cost_at_the_floor(const Eigen::VectorXd& residuals, double inflation) {
  return static_cast<double>(residuals.size()) / inflation;
}

/// The best fit of wider numbers from these bases; without those from which `cost` is out of reach. None if
/// no number departs further than it is stated to.
std::optional<Contender> best_numbers(const Case& c, const Bases& bases, double cost) {
  std::optional<Contender> best;
  const auto begin = [&](Model model) {
    Contender numbers = contend(c, std::move(model));
    if (!numbers.fitted.failure.empty() || (best && best->fitted.cost <= numbers.fitted.cost)) return;
    best = std::move(numbers);
  };
  for (const Fitted* base : bases) {
    const Fitted wider = with_wider_numbers(*base, c);
    if (out_of_reach(cost, wider, c.inflation)) continue;
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
  auto numbers = best_numbers(c, bases, cost_at_the_floor(bases.front()->residuals, c.inflation));
  if (!numbers) return numbers;
  const auto gain = compare(c.experiment, before, numbers->held_out, c.split.held_out);
  const bool near = all_near_floor(c.experiment, numbers->fitted.residuals, c.split.training) &&
                    all_near_floor(c.experiment, numbers->held_out, c.split.held_out);
  if (!near || !convinces(gain) || gain.share < thresholds.improvement.clear_share) numbers.reset();
  return numbers;
}

bool reaches_all(const Experiment& experiment, const Fitted& fitted, const Runs& few, const Runs& all) {
  return fitted.failure.empty() && all_near_floor(experiment, fitted.residuals, few) &&
         (few.size() == all.size() ||
          all_near_floor(experiment, experiment.residuals(fitted.model.rig, all), all));
}

bool numbers_reach_all(const Case& c, const Model& described, const Runs& usable) {
  const Runs few = asked(c.experiment.data(), usable);
  const Case of_all{c.experiment, c.nominal, {few, {}}, c.inflation, c.learned};
  const auto from = as_it_stands(of_all, described);
  if (!from) return false;
  const Fitted wider = with_wider_numbers(*from, of_all);
  const double aim = cost_at_the_floor(wider.residuals, c.inflation);
  if (out_of_reach(aim, wider, c.inflation)) return false;
  const Fitted fitted = fit(c.experiment, wider.model, few, {.inflation = c.inflation});
  return reaches_all(c.experiment, fitted, few, usable);
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
    for (const Candidate& effect : result.best.fitted.model.effects) {
      replace(result, effect, *numbers);
      result.doubts.push_back({std::nullopt, effect.who(), numbers->fitted, result.best.fitted});
    }
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
