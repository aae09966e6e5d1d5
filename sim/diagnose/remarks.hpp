// Warnings in words: of the data, what counts in the noise floor, what was made of stamps, what is ignored;
// and the remarks of the decision.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/noise.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Where more than counts makes the noise floor.
std::vector<std::string> noise_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// What data sheets add to the noise floor.
std::vector<std::string> sheets_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// What was made of stamps, and what data with a clock of their own cannot show.
std::vector<std::string> rows_in_words(const domain::Dataset& data, const NoiseFloor& floor);

}  // namespace mckibben::diagnose
