// The field's terms for what has another name here; docs/your_words.md lists them all. Suggestions of error
// messages know them, and the verb `effects` takes them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mckibben::input {

struct Synonym {
  std::string_view term;  ///< as `spelled_alike` makes it
  std::string_view here;  ///< a name of an effect or a kind of controller
};

/// All of them; a term with several meanings has several.
std::span<const Synonym> synonyms();

/// Small letters, and _ for blanks and hyphens: `Dead-Band` is `dead_band`.
std::string spelled_alike(std::string_view word);

/// What the term is called here; empty if it is none of the table.
std::vector<std::string_view> names_here(std::string_view term);

}  // namespace mckibben::input
