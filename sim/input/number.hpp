// Numbers as they may stand in input files: optional sign, digits without leading zeros, decimals, exponent.
// Stricter than YAML 1.1 and C (no 010, .5, 5., 0x1F, 1_000, inf, nan), so that no two readers can differ.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <sim/domain/number.hpp>

namespace mckibben::input {

using domain::write_number;

/// Length of the longest number at the start of `text`; 0 if there is none.
std::size_t number_length(std::string_view text);

/// The value of `text`, all of which must be a number that a double can hold.
std::optional<double> parse_number(std::string_view text);

/// What is wrong with a text that parse_number refuses, in words.
std::string why_no_number(std::string_view text);

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Its letters A to Z in small; other bytes stay.
std::string lower(std::string_view text);

}  // namespace mckibben::input
