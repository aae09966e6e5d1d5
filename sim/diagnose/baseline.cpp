// See the header.
#include <algorithm>
#include <optional>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/diagnose/starts.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// The rig with next to nothing of its effects; none if it has none.
std::optional<Model> with_slight_effects(const Case& c, Model model) {
  bool has_effects = false;
  for (const Candidate& effect : catalogue(c.nominal)) {
    if (!effect.carried(c.nominal)) continue;
    effect.put(model.rig, effect.absent + thresholds.parameter.slight_size * effect.typical);
    has_effects = true;
  }
  if (!has_effects) return std::nullopt;
  return model;
}

/// Begins from other places too; where ends differ, the deepest is kept.
void begin_elsewhere(const Case& c, const Model& described, Recalibrated& result) {
  std::vector<Contender> ends;
  for (Model& place : places_to_begin(c, described)) {
    ends.push_back(contend(c, std::move(place)));
    ++result.begun;
  }
  std::erase_if(ends, [](const Contender& end) { return !end.fitted.failure.empty(); });
  if (ends.empty()) return;
  const bool ended = result.contender.fitted.failure.empty();
  if (ended) ends.push_back(result.contender);
  std::vector<double> costs(ends.size());
  std::ranges::transform(ends, costs.begin(), [](const Contender& end) { return end.fitted.cost; });
  const bool alike = !disagree(costs);
  if (alike && ended) return;
  const auto best = std::min_element(costs.begin(), costs.end()) - costs.begin();
  result.contender = std::move(ends[static_cast<std::size_t>(best)]);
  if (alike) return;
  ends.erase(ends.begin() + best);
  for (const Contender& end : ends) result.other_ends.push_back(end.fitted.model.rig);
}

}  // namespace

Contender replay(const Case& c) {
  Contender nominal;
  nominal.held_out = c.experiment.residuals(c.nominal, c.split.held_out);
  Fitted& fitted = nominal.fitted;
  fitted.model = {c.nominal, nominal_parameters(c.nominal, c.experiment.data().rig.spreads)};
  if (c.experiment.data().pressure_is_given()) std::erase_if(fitted.model.free, out_of_sight);
  auto slopes = c.experiment.slopes(c.nominal, fitted.model.free, c.split.training);
  fitted.residuals = std::move(slopes.residuals);
  fitted.columns = std::move(slopes.columns);
  fitted.cost = fitted.residuals.squaredNorm() / c.inflation;
  return nominal;
}

Recalibrated recalibrate(Case& c, const Contender& nominal) {
  const auto slight = with_slight_effects(c, nominal.fitted.model);
  Recalibrated result{.contender = contend(c, nominal.fitted.model, {.thorough = slight.has_value()})};
  Contender& best = result.contender;
  if (slight) {
    // They may be there in vain: from next to nothing the way down can be another.
    auto other = contend(c, *slight, {.thorough = true});
    if (other.fitted.failure.empty() &&
        (!best.fitted.failure.empty() || other.fitted.cost < best.fitted.cost))
      best = std::move(other);
  }
  begin_elsewhere(c, nominal.fitted.model, result);
  if (!best.fitted.failure.empty()) result = {.contender = nominal, .failure = best.fitted.failure};
  const auto& residuals = best.fitted.residuals;
  if (!near_floor(residuals)) return result;
  c.inflation = variance_inflation(c.experiment, residuals, c.split.training);
  auto again = contend(c, best.fitted.model);
  if (again.fitted.failure.empty()) best = std::move(again);
  // It may have come to the edge along a valley; a descent that looks along it goes another way.
  if (bent(best.fitted, c.inflation)) begin_too(c, best, nominal.fitted.model, {.thorough = true});
  return result;
}

}  // namespace mckibben::diagnose
