// The map of disagreement: where, among all that a rig can do, measured and predicted readings part. Each row
// falls into one cell of each factor (direction, speed, load and so on) by the state that the model is in.
#pragma once

#include <cstdint>
#include <vector>

#include <plant/rig.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// All cells, factor by factor, also those never visited (rows 0).
///
/// What is tested: where a factor has several visited cells, that the cell's mean differs from the factor's
/// mean, for a disagreement common to all cells says nothing about the factor; where it has one, that the
/// mean is not zero. The sign of each segment's contribution is flipped at random (segments,
/// because neighbouring rows are not independent; what lasts longer than a segment, such as one run's own
/// offset, still looks more certain than it is). `significant` holds the false-discovery rate over all
/// visited cells (Benjamini & Hochberg, J. R. Stat. Soc. B 57 (1995) 289-300).
///
/// Time since reversal counts from the last turn that was followed by more than one count of movement; rows
/// before a run's first turn have none. The same for the same seed. Throws engine::NumericalFailure,
/// run::Interrupted.
std::vector<Cell> where(const Experiment& experiment, const Rig& recalibrated, const Runs& runs,
                        std::uint64_t seed);

}  // namespace mckibben::diagnose
