// "Did you mean": the known word nearest to a misspelt one, by the Damerau-Levenshtein distance (insertions,
// deletions, replacements and swaps of neighbours; optimal string alignment form).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mckibben::input {

std::size_t edit_distance(std::string_view left, std::string_view right);

/// The nearest of `known`, if near enough to be worth saying: up to one edit for each three characters,
/// whatever the case.
std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known);

/// `; did you mean WORD?` or nothing, to hang on a message: the known words that the field calls so
/// (synonyms.hpp), else those of which it is a part, else the nearest one. Of a field's word that is none of
/// them `; that is ...`, what it is here.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

/// The words separated by commas.
std::string join(std::span<const std::string_view> words);

/// The same of what a file holds: the first twenty, each shortened.
std::string join_few(std::span<const std::string_view> words);

}  // namespace mckibben::input
