// ARKODE ERKStep, an explicit Runge-Kutta pair of order 5: the default,
// fastest while the bristles are not too stiff.
#pragma once

#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

std::unique_ptr<Integrator> make_erk(const plant::Plant& rig, double tolerance, bool keep_ledger);

}  // namespace mckibben::engine
