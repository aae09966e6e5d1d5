// A diagnosis as text for a terminal.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::output {

/// Warnings, verdict, effects with parameters and intervals, what was recalibrated by more than a prior
/// deviation, the gap, names that cannot be told apart, and what to measure next.
std::string table_of(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
