// Small data sets whose answer is known, from their readings to the verdict.
#include <algorithm>

#include <gtest/gtest.h>

#include <sim/identify/identify.hpp>

#include "diagnose/planted.hpp"

namespace mckibben::identify {
namespace {

using Names = std::vector<std::string>;

Names named(const Identified& found) {
  return found.table[found.decision.chosen].names;
}

plant::Rig leaky() {
  plant::Rig rig;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
  return rig;
}

TEST(Identify, NamesTheLeak) {
  const Identified found = identify(diagnose::small(leaky()), {.threads = 2});
  EXPECT_EQ(found.decision.verdict, Verdict::missing_effect);
  EXPECT_EQ(named(found), Names{"muscle_leak"});
  EXPECT_LT(found.chosen().left(), 0.4);  // counts; rounding alone leaves 0.29
}

TEST(Identify, NamesNothingWhereNothingIsMissing) {
  const Identified found = identify(diagnose::small({}), {.threads = 2});
  EXPECT_EQ(found.decision.verdict, Verdict::nothing_missing);
  EXPECT_TRUE(named(found).empty());
}

TEST(Identify, AFaultOfTheBenchIsNoEffectOfTheRig) {
  domain::Dataset data = diagnose::small(leaky());
  for (domain::Run& run : data.runs) run.load_kg += 1.0;  // a hook that was weighed twice
  const Identified found = identify(data, {.threads = 2});
  EXPECT_EQ(named(found), (Names{"load_label", "muscle_leak"}));
}

TEST(Identify, DoesNotDependOnThreads) {
  const domain::Dataset data = diagnose::small(leaky(), 2.0);
  const Identified one = identify(data, {.threads = 1}), two = identify(data, {.threads = 2});
  ASSERT_EQ(one.table.size(), two.table.size());
  for (std::size_t i = 0; i < one.table.size(); ++i) EXPECT_EQ(one.table[i].score, two.table[i].score);
  EXPECT_EQ(one.passes, two.passes);
}

}  // namespace
}  // namespace mckibben::identify
