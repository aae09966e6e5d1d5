// A diagnosis for programs: diagnosis.json, and what --json prints.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::output {

/// The text of diagnosis.json: everything that a diagnosis found but the recordings; SI throughout. Numbers
/// that are not known (an interval without an end) are null. `data.rig` is the nominal rig.
std::string json_of(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
