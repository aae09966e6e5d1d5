// A calibration for people and for programs: the printed report, and calibration.json. Numbers that the data
// do not determine are named, with the reason, and not printed.
#pragma once

#include <string>

#include <sim/input/dataset.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/thesis/calibrate.hpp>

namespace mckibben::output {

/// Spreads, coefficients, what was dropped and why. Pressures in Pa, or in kgf/m2 as the thesis prints them.
std::string report_of(const input::Dataset& dataset, const thesis::CalibrationResult& result,
                      const thesis::Options& options, bool kgf);

/// Every number of every fit with standard error and condition number; SI throughout.
input::Json json_of(const input::Dataset& dataset, const thesis::CalibrationResult& result,
                    const thesis::Options& options);

}  // namespace mckibben::output
