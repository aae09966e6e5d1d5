// See the header. Far from the rig that is described straight lines mislead: what they suspect is looked at
// again from a fit.
#include <algorithm>
#include <utility>

#include <sim/diagnose/first_look.hpp>

namespace mckibben::diagnose {
namespace {

/// Effects that are tried beside faults of a few runs.
constexpr std::size_t most_suspected = 3;

/// How little a list explains: runs of another rig count most, then runs at fault.
std::pair<std::ptrdiff_t, std::size_t> shortfall(const std::vector<Fault>& faults) {
  return {std::count_if(faults.begin(), faults.end(),
                        [](const Fault& fault) { return fault.kind == FaultKind::another_rig; }),
          faults.size()};
}

// An effect fitted to all runs would be bent by those at fault: each that is suspected is fitted to the
// others, and the faults are looked up from there.
std::vector<Fault> beside_an_effect(const Case& c, const Model& described, const Runs& usable,
                                    const std::vector<Suspicion>& suspicions, const Step& step) {
  std::vector<Fault> best;
  for (std::size_t i = 0; i < std::min(suspicions.size(), most_suspected); ++i) {
    const Suspicion& suspicion = suspicions[i];
    step("trying " + title(suspicion.effect.candidate) + " beside faults of runs");
    Case of_sound = c;
    of_sound.split.training = suspicion.sound;
    const auto contender = contend(of_sound, with(of_sound, described, suspicion.effect));
    if (!contender.fitted.failure.empty()) continue;
    auto faults = examine(c.experiment, contender.fitted.model, usable, {}).faults;
    if (!faults.empty() && (best.empty() || shortfall(faults) < shortfall(best))) best = std::move(faults);
  }
  return best;
}

}  // namespace

std::vector<Fault> first_look(const Case& c, const Model& described, const Runs& usable, const Step& step) {
  const auto [faults, suspicions] = examine(c.experiment, described, usable, catalogue());
  if (faults.empty()) return beside_an_effect(c, described, usable, suspicions, step);
  Runs others;
  for (const std::size_t run : usable)
    if (std::none_of(faults.begin(), faults.end(), [&](const Fault& fault) { return fault.run == run; }))
      others.push_back(run);
  if (others.empty()) return faults;
  const auto fitted = fit(c.experiment, described, others, {.temperature = first_temperature});
  return fitted.failure.empty() ? examine(c.experiment, fitted.model, usable, catalogue()).faults : faults;
}

}  // namespace mckibben::diagnose
