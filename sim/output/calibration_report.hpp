// A calibration for people and for programs: the printed report, and calibration.json. Numbers that the data
// do not determine are named, with the reason, and not printed.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/thesis/calibrate.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::output {

/// Spreads, coefficients, what was dropped and why. Pressures in Pa, or in kgf/m2 as the thesis prints them.
std::string report_of(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                      const thesis::Options& options, bool kgf);

/// A spread (standard deviation over mean, 1 for 100 %) with that many decimals and `unit` behind it. Above
/// 100 % a model says nothing, and digits would only look as if it did; the number is in the JSON.
std::string spread_text(double spread, int decimals, const char* unit = "");

/// What the spread of each model of the calibration means, a line each:
/// good as the thesis's own, rough, not usable.
std::vector<std::string> meanings_of(const thesis::CalibrationResult& result, const thesis::Options& options);

/// Fits that cannot be used (spread above 100 %), and what may help.
std::vector<std::string> warnings_of(const thesis::CalibrationResult& result, const thesis::Options& options);

/// The text of calibration.json: every number of every fit with standard error and condition number; SI
/// throughout.
std::string json_of(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                    const thesis::Options& options);

/// A figure of the calibration as a picture: axes with round numbers, dots for data, lines for models.
std::string chart_svg(const thesis::Figure& figure);
/// The same as a table: header on line 1, shortest digits that read back exactly.
std::string csv_of(const thesis::Figure& figure);

}  // namespace mckibben::output
