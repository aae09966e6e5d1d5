// Those parts of a diagnosis's report that are text and tables. Each is empty where there is nothing to say.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/input/dataset.hpp>

namespace mckibben::output {

/// Effects and terms that were added, with laws, parameters and intervals.
std::string added_html(const diagnose::Diagnosis& diagnosis);

/// Nominal parameters before and after.
std::string recalibrated_html(const diagnose::Diagnosis& diagnosis);

/// The map of disagreement: for each factor a strip of cells.
std::string where_html(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig);

/// Candidates of each round, with bars and reasons.
std::string ranking_html(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig);

/// How alike the best candidates are, as a matrix.
std::string confusion_html(const diagnose::Diagnosis& diagnosis);

/// Other names for what was found, and what no data of this kind can tell.
std::string twins_html(const input::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// The measurement that would tell more.
std::string next_html(const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
