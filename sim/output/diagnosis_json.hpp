// A diagnosis for programs: diagnosis.json, and what --json prints.
#pragma once

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/input/fields_json.hpp>

namespace mckibben::output {

/// Everything that a diagnosis found but the recordings; SI throughout. Numbers that are not known (an
/// interval without an end) are null. `data.rig` is the nominal rig.
input::Json json_of(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
