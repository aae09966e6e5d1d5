// Files that a diagnosis hands on: the corrected rig, and the measurement that would tell more.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::output {

/// A rig file that reads back to the same numbers. It holds what differs from the shipped rig where the
/// nominal one (`data.rig`) is that; otherwise every field. Effects that are off are left out. A comment
/// says where it comes from and gives the interval of each fitted number.
std::string rig_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// The law of force that was found outside the catalogue, as a hypothesis (docs/hypotheses.md) that says the
/// same: to be read, changed and put to the test. There must be one.
std::string law_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// How a file that plan_yaml made begins.
inline constexpr const char* plan_heading = "# The measurement that a diagnosis asks for";

/// A campaign file on the corrected rig with the current and load
/// of the next experiment, which there must be.
std::string plan_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
