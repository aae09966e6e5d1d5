// A property: whatever happens to a good scenario, to its lines or its characters, it is either read or
// refused with problems that point into it. Seeded, so that a failure can be repeated.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "good_scenario.hpp"
#include "mutator.hpp"

namespace mckibben::input {
namespace {

TEST(Mutation, EveryMutantIsReadOrRefusedWithAPlace) {
  std::size_t read = 0, refused = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    const std::string text = Mutator(seed).mutated(good_scenario);
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    try {
      read_text(text);
      ++read;
    } catch (const BadInput& error) {
      ++refused;
      ASSERT_FALSE(error.problems().empty()) << text;
      for (const Problem& problem : error.problems()) {
        EXPECT_GE(problem.place.line, 1u);
        EXPECT_LE(problem.place.line, lines) << text;
        EXPECT_FALSE(problem.message.empty());
      }
    } catch (const MissingInput&) {
      ++refused;
    } catch (const std::exception& error) {
      FAIL() << "seed " << seed << ": " << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 1000u);
}

}  // namespace
}  // namespace mckibben::input
