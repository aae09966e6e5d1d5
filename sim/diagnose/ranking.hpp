// What became of each candidate, in numbers and words that agree with the verdict: whatever is called taken
// is named in the end, and has made the misfit fall by more than chance.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// The candidates of a round as its trials leave them, best score first; those without any influence are
/// left out. `base`: what the fall of the misfit is counted from; `chosen`: one of `trials`, or null.
std::vector<Ranked> ranked(const Case& c, int round, const std::vector<Screening>& screenings,
                           const std::vector<Trial>& trials, const Trial* chosen, const Contender& base);

/// In the last round of `ranking` this candidate was taken, for the reason `why`. `trial`: the fit with it;
/// `fall`: of the misfit, by that fit.
void take(const Case& c, std::vector<Ranked>& ranking, const Candidate& candidate, const Trial& trial,
          double fall, const std::string& why);

/// What was taken is no more: says why.
void give_up(std::vector<Ranked>& ranking, const Candidate& candidate, const std::string& why);

/// An effect that was taken stands in for something else.
void disown(std::vector<Ranked>& ranking, const NamedEffect& stand_in);

/// No effect is named after all: what had been taken came nearest.
void disown(std::vector<Ranked>& ranking);

}  // namespace mckibben::diagnose
