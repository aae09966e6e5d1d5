// A model, and its data, with the faults of the bench mended.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// The model fitted anew with loads as they are reported: what a model of which loads may differ leaves to
/// all of them is the rig's then, and its rig is that of data so mended.
Model with_reported_loads(const Model& model, const std::vector<diagnose::BenchFault>& faults);

/// The data with these taken out of loads and of the judged reading.
domain::Dataset without_faults(const Model& model);

}  // namespace mckibben::identify
