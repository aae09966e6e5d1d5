// CVODE BDF, implicit and variable order: for rigs too stiff for explicit steps.
#pragma once

#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

std::unique_ptr<Integrator> make_cvode(const plant::Plant& rig, double tolerance, bool keep_ledger);

}  // namespace mckibben::engine
