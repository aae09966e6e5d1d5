// The field's terms for what has another name here: the tables of docs/your_words.md, which is built into the
// program. Suggestions of error messages know them, and the verb `effects` takes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mckibben::input {

extern const std::string_view your_words;  ///< the page, by cmake/embed.cmake

struct Synonym {
  std::string term;                ///< as `spelled_alike` makes it
  std::string here;                ///< what the page says of it, without its links
  std::vector<std::string> names;  ///< what stands in `here` between backticks; of `key: value` the value
};

/// A row of a table for each of its terms.
const std::vector<Synonym>& synonyms();

/// Small letters, and _ for blanks and hyphens: `Dead-Band` is `dead_band`.
std::string spelled_alike(std::string_view word);

/// What the page says of the term; null if it is none of its terms.
const Synonym* synonym(std::string_view term);

}  // namespace mckibben::input
