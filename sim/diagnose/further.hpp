// Numbers before names: an effect is missing, or a law is needed, only if no recalibration does as well in
// which numbers of the rig depart further than they are stated to, up to five deviations in place of three. A
// data sheet that is wrong is more common than a law that nobody has thought of.
#pragma once

#include <optional>
#include <vector>

#include <sim/diagnose/name.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// A fit, seen with wider priors and bounds of its nominal numbers; those that are not known at all, and
/// sizes of effects, have none that could be wider.
Fitted with_wider_numbers(Fitted fitted, const Case& c);

/// Fits to begin from, without what is to be spared.
using Bases = std::vector<const Fitted*>;

/// Numbers that do as well as `named` does. None if there are none, or if none of them departs further than
/// it is stated to: that was tried before. Throws run::Interrupted.
std::optional<Contender> numbers_as_good(const Case& c, const Bases& bases, const Contender& named);

/// The same where nothing was named: numbers that close most of the gap that `before` has on the runs held
/// out, and come near every run.
std::optional<Contender> numbers_that_close(const Case& c, const Bases& bases, const Eigen::VectorXd& before);

/// Whether a fit to `few` of these runs takes each of all near the floor.
bool reaches_all(const Experiment& experiment, const Fitted& fitted, const Runs& few, const Runs& all);

/// Whether numbers, fitted to a few of the runs, take each of all near the floor, as they are.
bool numbers_reach_all(const Case& c, const Model& described, const Runs& usable);

/// Gives up each effect that numbers do as well as, others kept. `bases`: of no effect.
void prefer_numbers(const Case& c, const Bases& bases, Naming& result, const Step& step);

}  // namespace mckibben::diagnose
