// Warnings in words: of the data, what counts in the noise floor, what was made of stamps, what is ignored;
// and the remarks of the decision.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/decide.hpp>
#include <sim/diagnose/name.hpp>
#include <sim/diagnose/noise.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Where more than counts makes the noise floor.
std::vector<std::string> noise_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// What data sheets add to the noise floor.
std::vector<std::string> sheets_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// What was made of stamps, and what data with a clock of their own cannot show.
std::vector<std::string> rows_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// The columns that were read beside: "muscle_pressure_bar", "muscle_pressure_1_bar and force_N".
std::string besides_in_words(const domain::Dataset& data);

/// That these are ignored, and what to look for, as a warning.
std::string ignored_in_words(const domain::Dataset& data);

/// A remark of the decision, as a warning. `left`: mean square above the floor's. `besides`: in words.
std::string remark_in_words(Remark remark, const Naming& naming, double left, const std::string& besides);

/// "r02 by 5, r07 by 12": runs that no model comes near, with the noise floors that are left.
std::string far_runs_in_words(const std::vector<FarRun>& runs);

}  // namespace mckibben::diagnose
