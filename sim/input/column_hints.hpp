// A heading that is not there, with the line of `columns` that says where its column stands.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <sim/input/column_units.hpp>

namespace mckibben::input {

using Words = std::vector<std::string>;
/// Where a word begins in the middle of one: timeSec.
bool is_hump(std::string_view text, std::size_t at);
/// Words of a heading, in lower case; bytes of UTF-8 stay as they are.
Words words_of(std::string_view text);
/// By which a heading says that its column is a clock.
extern const Words time_words;
bool names_time(std::string_view heading);
/// By which a heading says that its column is a duty, and that German begins or ends such a word with.
extern const Words duty_words, duty_stems;
bool names_duty(std::string_view heading);

/// To hang on the message that a column is not among the headings `found`: which line says where it stands.
std::string hint_of_missing(const WantedColumn& column, std::span<const std::string_view> found);

}  // namespace mckibben::input
