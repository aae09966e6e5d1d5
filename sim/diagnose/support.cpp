// See the header.
#include <algorithm>

#include <sim/diagnose/support.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// The runs in which the misfit differs by more than chance.
void sort_runs(const Case& c, const Runs& runs, const Eigen::VectorXd& without, const Eigen::VectorXd& with,
               Support& support) {
  Eigen::Index begin = 0;
  for (const std::size_t run : runs) {
    const auto rows = static_cast<Eigen::Index>(c.experiment.rows(run));
    const double fall =
        (without.segment(begin, rows).squaredNorm() - with.segment(begin, rows).squaredNorm()) / c.inflation;
    begin += rows;
    const std::string& id = c.experiment.data().runs[run].id;
    if (fall > thresholds.near.chance) support.by.push_back(id);
    if (fall < -thresholds.near.chance) support.against.push_back(id);
  }
}

}  // namespace

void tell_support(const Case& c, const Contender& recalibrated, Naming& naming, const Step& step) {
  const Contender& best = naming.best;
  const auto& effects = best.fitted.model.effects;
  const KnownSlopes known = slopes_of_nominal(best.fitted);
  for (NamedEffect& effect : naming.effects) {
    const auto place = std::ranges::find(effects, effect.who(), &Candidate::who);
    if (place == effects.end()) continue;
    step("without " + full_name(effect));
    const auto index = static_cast<std::size_t>(place - effects.begin());
    const Contender without_it =
        effects.size() == 1 ? recalibrated : contend(c, without(best.fitted.model, index), {.known = &known});
    if (!without_it.fitted.failure.empty()) continue;
    Support& support = effect.support;
    support.fall = without_it.fitted.cost - best.fitted.cost;
    support.runs = c.split.training.size() + c.split.held_out.size();
    sort_runs(c, c.split.training, without_it.fitted.residuals, best.fitted.residuals, support);
    sort_runs(c, c.split.held_out, without_it.held_out, best.held_out, support);
    std::ranges::sort(support.by);
    std::ranges::sort(support.against);
  }
}

}  // namespace mckibben::diagnose
