// Intervals by profile: how the misfit rises as one number leaves its fit and all others are fitted anew
// (Venzon & Moolgavkar, Appl. Statist. 37 (1988) 87-94; Raue et al., Bioinformatics 25 (2009) 1923-1929).
// They take the place of those from slopes at the fit where the valley is no parabola: near a bound, or along
// a time constant that is badly determined. They end where the misfit has risen by what the parabola rises by
// up to the quadratic ends, so noise that is neither white nor normal counts as much (Chandler & Bate,
// Biometrika 94 (2007) 167-183).
#pragma once

#include <cstddef>
#include <vector>

#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {

/// The free parameters whose intervals are read first: those of effects that were added, and numbers further
/// off than a data sheet promises.
std::vector<std::size_t> worth_a_profile(const Model& model);

/// Looks at the quadratic ends of these free parameters, or at the bound where that is nearer: by how much
/// the cost rises more than the parabola promises. Neither in the mean of both ends (how wide the interval
/// is) nor in half their difference (where its middle lies) may that be more than a share
/// (thresholds.interval) of the rise at the ends. Where it is more, both ends become those of the profile;
/// `quadratic` keeps what they were. The interval stays where the number stands at a bound, or the runs do
/// not keep what slopes promise. `fitted`: to `runs`. Throws run::Interrupted.
void trust_or_profile(const Experiment& experiment, const Fitted& fitted, const Runs& runs, double inflation,
                      const std::vector<std::size_t>& which, std::vector<Bounds>& bounds);

}  // namespace mckibben::diagnose
