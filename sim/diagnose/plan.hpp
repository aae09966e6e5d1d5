// The next experiment: which current and which load would tell two explanations of the data apart
// (T-optimality: Atkinson & Fedorov, Biometrika 62 (1975) 57-70; here over a menu instead of a design space,
// the rival fitted again to each).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>

namespace mckibben::diagnose {

/// Probability that a measurement ends a doubt: a run with a current and a load, nothing read.
using Power = std::function<double(const domain::Run& run)>;

/// The measurement of a menu of currents, under loads of the data set, of which that is highest, looked for
/// among those in which two rigs differ most; none if even that is below 10 %. Throws run::Interrupted.
std::optional<NextExperiment> plan(const domain::Dataset& data, unsigned threads, const Rig& one,
                                   const Rig& other, std::vector<std::string> names, const Power& power);

/// From a menu of currents of 10 s, under the data set's loads and half and 1.3 times these as far as the rig
/// lifts them, the experiment that most probably ends the doubt between two fits to the same runs.
///
/// Whichever of the two is right, the other is fitted again to old and new readings: what its free parameters
/// imitate of the difference, as far as priors and old readings let them, is projected out (straight lines
/// from the fit). What is left, a sum of squares over `inflation` as in fits, is by how much its misfit
/// grows; it scatters as noise of `long_variance` (in floors^2) makes it. The power is the probability that
/// it grows by more than what still counts as doing as well, for the one of the two of which that is less
/// probable. This is reckoned for those items of the menu in which the two differ most, but for an offset and
/// a gain.
///
/// Experiments that cannot be simulated are passed over. None if not even the best has a power of 10 %.
/// Throws run::Interrupted.
std::optional<NextExperiment> plan(const Experiment& experiment, const Fitted& one, const Fitted& other,
                                   std::vector<std::string> names, double inflation, double long_variance);

}  // namespace mckibben::diagnose
