// An FMU as the bytes of its file: a ZIP archive (libzip) of the description, the rig, the program and its
// sources. The same rig gives the same bytes.
#pragma once

#include <string>

#include <sim/fmu/description.hpp>

namespace mckibben::fmu {

/// `name`: of the model.
std::string fmu_of(const std::string& name, const plant::Rig& rig, Version version, bool true_states);

}  // namespace mckibben::fmu
