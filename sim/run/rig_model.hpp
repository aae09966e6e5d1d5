// What controllers that plan with a model are given: a ride of the rig that they believe in, on its own.
#pragma once

#include <controllers/rig_model.hpp>
#include <plant/rig.hpp>
#include <plant/solver.hpp>
#include <sim/domain/rig_file.hpp>

namespace mckibben::run {

/// Models of `rig` that are stepped in ticks of `tick_s`, which are those of the rig that is controlled.
controllers::ModelMaker model_of(const plant::Rig& rig, const solver::Settings& engine, double tick_s);
/// The same of a pair that holds its load in a hand so far from the axis [m].
controllers::ModelMaker model_of_pair(const domain::RigFile& rig, double hand_m, double tick_s);

}  // namespace mckibben::run
