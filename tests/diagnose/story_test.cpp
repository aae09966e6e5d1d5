// The verdict in words.
#include <gtest/gtest.h>

#include <sim/diagnose/story.hpp>

namespace mckibben::diagnose {
namespace {

/// A leak for which these runs speak, of nine.
std::string because_of(std::vector<std::string> by, std::vector<std::string> against) {
  Diagnosis d;
  d.verdict = Verdict::missing_effect;
  NamedEffect leak{.name = "muscle_leak", .variant = ""};
  leak.support.runs = 9;
  leak.support.by = std::move(by);
  leak.support.against = std::move(against);
  d.effects = {leak};
  return because(d);
}

TEST(Story, NamesTheRunsThatSpeakForANameAndAgainstIt) {
  const auto says = [](const std::string& text, const std::string& words) {
    return text.find("atmosphere). " + words + " On runs that") != std::string::npos;
  };
  const auto all = because_of({"a", "b", "c", "d", "e", "f", "g", "h", "i"}, {});
  EXPECT_TRUE(says(all, "All 9 runs speak for muscle_leak.")) << all;
  const auto most = because_of({"a", "b", "c", "d", "e", "f", "g"}, {"h"});
  EXPECT_TRUE(says(most, "7 of 9 runs speak for muscle_leak, run h against it.")) << most;
  const auto few = because_of({"a", "b"}, {"c", "d"});
  EXPECT_TRUE(says(few, "Runs a, b speak for muscle_leak, runs c, d against it.")) << few;
  const auto one = because_of({"a"}, {});
  EXPECT_TRUE(says(one, "Run a speaks for muscle_leak.")) << one;
  const auto none = because_of({}, {});
  EXPECT_TRUE(says(none, "No single run speaks for muscle_leak.")) << none;
}

}  // namespace
}  // namespace mckibben::diagnose
