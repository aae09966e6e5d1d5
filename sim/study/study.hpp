// The studies: what the thesis could not know about its own numbers, because it never saw the truth.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <sim/study/evidence.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::study {

inline constexpr std::array<std::string_view, 3> names{"lag", "counting", "figures"};

struct Study {
  std::string name;
  std::string page;  ///< Markdown; shows the picture as <name>.svg
  thesis::Figure picture;
  std::string document;  ///< every number of the page, as the text of a JSON file
};

/// One of `names`.
Study make(std::string_view name, const Evidence& evidence);

}  // namespace mckibben::study
