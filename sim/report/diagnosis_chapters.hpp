// The story of a diagnosis in order: where model and data disagree, what explains it, what was added, how far
// the gap shrank; what else it could be, what to measure next. A chapter without anything to say is empty.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/report/contents.hpp>

namespace mckibben::report {

/// The error that is left in a run: of the corrected rig, or where nothing was changed the recalibrated one.
double left_of(const diagnose::RunGap& run, bool changed);

/// The result as two tables: what was found, and the errors on the runs held out.
std::string result_table(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// Up to the gap. `runs`: those of the page, in its order.
std::vector<Chapter> story(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis,
                           const std::vector<const diagnose::RunGap*>& runs);

std::vector<Chapter> doubts_and_plan(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis);

/// Whether some run has a muscle pressure.
bool gauged(const domain::Dataset& data);

}  // namespace mckibben::report
