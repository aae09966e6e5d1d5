// The pictures of a diagnosis's report, as SVG inside the page: colours are those of the page's style sheet
// (classes nominal, recalibrated, corrected, measured), so they follow light and dark.
#pragma once

#include <string>
#include <string_view>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/input/dataset.hpp>

namespace mckibben::output {

/// `text` as it may stand in a page.
std::string escaped(std::string_view text);

/// Errors on the runs held out, of all three models, against the noise floor.
std::string gap_svg(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig);

/// The same run by run, first those held out.
std::string runs_svg(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig);

/// One run: measured, nominal and corrected over time, and what is left of the difference.
std::string run_svg(const diagnose::RunGap& run, double noise_floor, const plant::Rig& rig);

/// Nominal parameters moved without and with the effects, in prior deviations.
std::string absorbed_svg(const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
