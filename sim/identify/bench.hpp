// Faults of the bench as they are reported, each with the line that mends it.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/estimates.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// Those that a model has, after its evidence. `estimates`: of the same.
std::vector<diagnose::BenchFault> bench_faults(const Model& model, const Estimates& estimates);

}  // namespace mckibben::identify
