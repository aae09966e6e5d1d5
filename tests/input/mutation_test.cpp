// A property: whatever happens to a good scenario, to its lines or its characters, it is either read or
// refused with problems that point into it. Seeded, so that a failure can be repeated.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "good_scenario.hpp"

namespace mckibben::input {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start);
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return lines;
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : chance_(seed) {}

  std::string mutated(const std::string& text) {
    const std::string result = pick(2) == 0 ? mutated_line(text) : mutated_character(text);
    return pick(3) == 0 ? mutated(result) : result;
  }

 private:
  std::size_t pick(std::size_t count) { return chance_() % count; }

  std::string mutated_line(const std::string& text) {
    std::vector<std::string> lines = lines_of(text);
    if (lines.empty()) return text;
    const std::size_t at = pick(lines.size()), other = pick(lines.size());
    const auto here = lines.begin() + static_cast<std::ptrdiff_t>(at);
    switch (pick(4)) {
      case 0:
        lines.erase(here);
        break;
      case 1:
        lines.insert(here, std::string(lines[other]));
        break;
      case 2:
        lines[at] = lines[other];
        break;
      default:
        lines[at] = "  " + lines[at];
        break;
    }
    std::string result;
    for (const std::string& line : lines) result += line + '\n';
    return result;
  }

  std::string mutated_character(std::string text) {
    static const std::string alphabet = "{}[]:,-#&*!|>'\"%@`\t\n 0e.+~?\\a\xC3\xFF";
    if (text.empty()) return text;
    const std::size_t at = pick(text.size());
    switch (pick(3)) {
      case 0:
        text.erase(at, 1);
        break;
      case 1:
        text.insert(at, 1, alphabet[pick(alphabet.size())]);
        break;
      default:
        text[at] = alphabet[pick(alphabet.size())];
        break;
    }
    return text;
  }

  std::mt19937 chance_;
};

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
