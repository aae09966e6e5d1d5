// What is left with the corrected rig, and where it lies: with real measurements something always is.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// The cells of a map of disagreement in which much of the gap sits in little of the data, the densest of
/// each factor, densest first.
std::vector<Dense> densest(std::span<const Cell> map);

/// How much the corrected rig leaves on the runs held out; where more than noise is left, where it lies in
/// all runs. Throws engine::NumericalFailure, run::Interrupted.
Remaining remaining(const Experiment& experiment, const Rig& corrected, const Runs& runs, const Gap& gap,
                    std::uint64_t seed);

/// It in a sentence; empty if no more is left than noise.
std::string sentence_of(const Remaining& remaining);

}  // namespace mckibben::diagnose
