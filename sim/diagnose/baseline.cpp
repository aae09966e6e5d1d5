// See the header.
#include <optional>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// The rig with next to nothing of its effects; none if it has none.
std::optional<Model> with_slight_effects(const Case& c, Model model) {
  bool has_effects = false;
  for (const Candidate& effect : catalogue()) {
    if (!effect.carried(c.nominal)) continue;
    effect.put(model.rig, effect.absent + thresholds.parameter.slight_size * effect.typical);
    has_effects = true;
  }
  if (!has_effects) return std::nullopt;
  return model;
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
  Recalibrated result{contend(c, nominal.fitted.model, nullptr, slight.has_value()), {}};
  Contender& best = result.contender;
  if (slight) {
    // They may be there in vain: from next to nothing the way down can be another.
    auto other = contend(c, *slight, nullptr, true);
    if (other.fitted.failure.empty() &&
        (!best.fitted.failure.empty() || other.fitted.cost < best.fitted.cost))
      best = std::move(other);
  }
  if (!best.fitted.failure.empty()) result = {nominal, best.fitted.failure};
  const auto& residuals = best.fitted.residuals;
  if (!near_floor(residuals)) return result;
  c.inflation = variance_inflation(c.experiment, residuals, c.split.training);
  auto again = contend(c, best.fitted.model);
  if (again.fitted.failure.empty()) best = std::move(again);
  return result;
}

}  // namespace mckibben::diagnose
