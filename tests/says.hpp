// What a text says, for assertions: EXPECT_TRUE(holds(said.err, "no such file")). A text that does not is
// shown.
#pragma once

#include <initializer_list>
#include <string_view>

#include <gtest/gtest.h>

namespace mckibben {

inline testing::AssertionResult looked_for(std::string_view text,
                                           std::initializer_list<std::string_view> parts, bool there) {
  for (const std::string_view part : parts)
    if ((text.find(part) != std::string_view::npos) != there)
      return testing::AssertionFailure()
             << '"' << part << (there ? "\" is not in:\n" : "\" is in:\n") << text;
  return testing::AssertionSuccess();
}

/// All of these parts.
template <class... Parts>
testing::AssertionResult holds(std::string_view text, const Parts&... parts) {
  return looked_for(text, {std::string_view(parts)...}, true);
}

/// None of them.
template <class... Parts>
testing::AssertionResult lacks(std::string_view text, const Parts&... parts) {
  return looked_for(text, {std::string_view(parts)...}, false);
}

}  // namespace mckibben
