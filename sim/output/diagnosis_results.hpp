// A diagnosis as text for a terminal, as JSON, and as files to go on with: the corrected rig, a law, the
// measurement that would tell more.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::output {

/// Warnings, verdict, effects with parameters and intervals, what was recalibrated by more than a prior
/// deviation, the gap, names that cannot be told apart, and what to measure next.
std::string table_of(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// The text of diagnosis.json: everything that a diagnosis found but the recordings; SI throughout. Numbers
/// that are not known (an interval without an end) are null. `data.rig` is the nominal rig.
std::string json_of(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// A rig file that reads back to the same numbers. It holds what differs from the shipped rig where the
/// nominal one (`data.rig`) is that; otherwise every field. Effects that are off are left out. A comment
/// says where it comes from and gives the interval of each fitted number.
std::string rig_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// The law of force that was found outside the catalogue, as a hypothesis (docs/hypotheses.md) that says the
/// same: to be read, changed and put to the test. There must be one.
std::string law_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// How a file that plan_yaml made begins.
inline constexpr const char* plan_heading = "# The measurement that a diagnosis proposes";

/// A campaign file on the corrected rig with the current and load
/// of the next experiment, which there must be.
std::string plan_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
