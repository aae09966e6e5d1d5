// What a diagnosis says of its work.
#include <gtest/gtest.h>

#include <sim/diagnose/telling.hpp>

namespace mckibben::diagnose {
namespace {

using namespace std::chrono_literals;

TEST(Telling, SaysStageTryAndTheTimeThatTheOthersMayTake) {
  Telling telling;
  const Telling::Clock::time_point began{};
  EXPECT_EQ(telling(stage("naming", 4), began), "naming");
  EXPECT_EQ(telling("trying leak", began + 1s), "naming: trying leak (1 of at most 4)");
  // The stage has taken 6 s so far, for one try: three are left.
  EXPECT_EQ(telling("trying creep", began + 6s), "naming: trying creep (2 of at most 4, at most 18 s left)");
  EXPECT_EQ(telling("trying droop", began + 8s), "naming: trying droop (3 of at most 4, at most 8 s left)");
}

TEST(Telling, SaysNoNumberOfTriesThatItDoesNotKnow) {
  Telling telling;
  const Telling::Clock::time_point began{};
  EXPECT_EQ(telling("checking", began), "checking");
  telling(stage("naming", 1), began);
  telling("trying leak", began);
  EXPECT_EQ(telling("fitting leak", began + 2s), "naming: fitting leak");
  EXPECT_EQ(telling(stage("recalibrating"), began), "recalibrating");
}

}  // namespace
}  // namespace mckibben::diagnose
