// See the header. Far from the rig that is described straight lines mislead: what they suspect is looked at
// again from a fit.
#include <algorithm>
#include <utility>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/first_look.hpp>
#include <sim/diagnose/further.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// Runs of another rig, then faults; one of all runs counts once.
std::pair<std::ptrdiff_t, std::size_t> shortfall(const std::vector<Fault>& faults) {
  return {std::count_if(faults.begin(), faults.end(),
                        [](const Fault& fault) { return fault.kind == FaultKind::another_rig; }),
          faults.front().common ? 1 : faults.size()};
}

/// Whether a model that is fitted to a few of all runs as they are takes each of all there.
bool leads_to_all(const Case& c, const Model& model, const Runs& few, const Runs& usable) {
  const auto fitted = fit(c.experiment, model, few, {.inflation = thresholds.scatter.first_inflation});
  return reaches_all(c.experiment, fitted, few, usable);
}

/// The same of a suspected effect: from where it went without the runs at fault, or as it would have begun
/// without a suspicion. A fit to few runs may end where no way leads on.
bool explains_all(const Case& c, const Model& described, const Suspicion& suspicion, const Model& from,
                  const Runs& usable) {
  const Runs few = asked(c.experiment.data(), usable);
  if (leads_to_all(c, from, few, usable)) return true;
  const Case of_all{c.experiment, c.nominal, {few, c.split.held_out}, c.inflation, c.learned};
  return leads_to_all(c, with(of_all, described, suspicion.effect), few, usable);
}

/// The suspected effect fitted to the runs that may be sound, the fault that all have taken out.
Contender with_suspect(const Case& c, const Checked& checked, const Model& described, const Runs& usable,
                       const Suspicion& suspicion) {
  const auto fitted = [&](const Experiment& experiment) {
    const Runs few = asked(experiment.data(), suspicion.sound);
    const Case of_sound{experiment, c.nominal, {few, c.split.held_out}, c.inflation, c.learned};
    return contend(of_sound, with(of_sound, described, suspicion.effect));
  };
  if (suspicion.common.empty()) return fitted(c.experiment);
  domain::Dataset data = c.experiment.data();
  Checked mended = checked;
  mend(data, mended, suspicion.common);
  return fitted(Experiment(data, mended.masked, c.experiment.threads(), usable));
}

// An effect fitted to all runs as they are would be bent by those at fault: each that is suspected is fitted
// to the others, or to all with their common fault taken out, and the faults are looked up from there. A
// common fault must then do better than a second effect.
std::vector<Fault> beside_an_effect(const Case& c, const Checked& checked, const Model& described,
                                    const Runs& usable, const std::vector<Suspicion>& suspicions,
                                    const Step& step) {
  const std::pair<std::ptrdiff_t, std::size_t> one_fault{0, 1};
  std::vector<Fault> best;
  step(stage("looking for faults of runs", suspicions.size()));
  for (const Suspicion& suspicion : suspicions) {
    const bool common = !suspicion.common.empty();
    step("trying " + title(suspicion.effect.candidate) + " beside them");
    const auto contender = with_suspect(c, checked, described, usable, suspicion);
    if (!contender.fitted.failure.empty()) continue;
    auto faults = examine(c.experiment, contender.fitted.model, usable,
                          common ? catalogue(c.experiment.data()) : std::vector<Candidate>{})
                      .faults;
    if (faults.empty() && !common &&
        all_near_floor(c.experiment, c.experiment.residuals(contender.fitted.model.rig, usable), usable))
      return {};  // no fault is needed
    if (!faults.empty() && !common && explains_all(c, described, suspicion, contender.fitted.model, usable))
      return {};
    if (!faults.empty() && (best.empty() || explains_more(faults, best))) best = std::move(faults);
    if (!best.empty() && shortfall(best) == one_fault) break;
  }
  return best;
}

}  // namespace

bool explains_more(const std::vector<Fault>& faults, const std::vector<Fault>& others) {
  return shortfall(faults) < shortfall(others);
}

std::vector<Fault> first_look(const Case& c, const Checked& checked, const Model& described,
                              const Runs& usable, const Step& step) {
  const auto [faults, suspicions] = examine(c.experiment, described, usable, catalogue(c.experiment.data()));
  if (faults.empty() && suspicions.empty()) return {};
  if (numbers_reach_all(c, described, usable)) return {};  // the rig is further off than it is said to be
  if (faults.empty()) return beside_an_effect(c, checked, described, usable, suspicions, step);
  Runs others;
  for (const std::size_t run : usable)
    if (std::none_of(faults.begin(), faults.end(), [&](const Fault& fault) { return fault.run == run; }))
      others.push_back(run);
  if (others.empty()) return faults;
  const auto fitted = fit(c.experiment, described, asked(c.experiment.data(), others),
                          {.inflation = thresholds.scatter.first_inflation});
  if (!fitted.failure.empty()) return faults;
  const auto again = examine(c.experiment, fitted.model, usable, catalogue(c.experiment.data())).faults;
  return !again.empty() && explains_more(faults, again) ? faults : again;
}

}  // namespace mckibben::diagnose
