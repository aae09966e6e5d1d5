// What speaks for a model and what competes with it, from the table of models alone: nothing is simulated.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/identify.hpp>

namespace mckibben::identify {

/// Of the chosen model's effects: what supports each and what it may be confused with, the most important
/// first.
void support(const Identified& found, std::vector<diagnose::NamedEffect>& effects);

/// The most probable model that has a name which the chosen one has not, and does as well; none if there is
/// none.
const Model* doubt(const Identified& found);

/// The models, the most probable first. `left[i]`: rms that model i leaves of the judged reading of runs that
/// it predicts from the others.
std::vector<diagnose::Explanation> explanations(const Identified& found, const std::vector<double>& left);

/// Each name that was looked at: what came of it.
std::vector<diagnose::Ranked> ranking(const Identified& found, const std::vector<double>& left);

}  // namespace mckibben::identify
