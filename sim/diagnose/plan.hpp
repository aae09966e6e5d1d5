// The next experiment: which current and which load would tell two explanations of the data apart
// (T-optimality: Atkinson & Fedorov, Biometrika 62 (1975) 57-70; here over a menu instead of a design space).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// From a menu of currents of 10 s, under the data set's loads and half and 1.3 times these as far as the rig
/// lifts them, the experiment in which the encoder readings that `named` and `rival` predict differ most.
///
/// What counts is the part of the difference that neither an offset nor a gain of the readings can take away.
/// Over `noise_ratio` (rms that is left with the best model, contraction ratio; never taken below what the
/// encoder cannot see) and with `effective_share` independent samples for each tick, its sum of squares is
/// the noncentrality of the likelihood-ratio test between the two, and the power that of a noncentral
/// chi-square with one degree of freedom at 5 %. It is hopeful: the rival would be fitted again to the new
/// data, with more than an offset and a gain.
///
/// Experiments that cannot be simulated are passed over. None if not even the best has a power of 10 %.
/// Throws std::invalid_argument for a share outside (0, 1]; run::Interrupted.
std::optional<NextExperiment> plan(const Experiment& experiment, const RigFile& named, const RigFile& rival,
                                   std::vector<std::string> names, double noise_ratio,
                                   double effective_share);

}  // namespace mckibben::diagnose
