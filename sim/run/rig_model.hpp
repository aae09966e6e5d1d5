// What controllers that plan with a model are given: a ride of the rig that they believe in, on its own.
#pragma once

#include <controllers/rig_model.hpp>
#include <plant/rig.hpp>

namespace mckibben::run {

/// Models of `rig` that are stepped in ticks of `tick_s`, which are those of the rig that is controlled. A
/// pair holds its load in a hand so far from the axis.
controllers::ModelMaker model_of(const plant::Rig& rig, double tick_s, double hand_m = 0.0);

}  // namespace mckibben::run
