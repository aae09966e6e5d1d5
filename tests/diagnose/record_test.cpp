// What the program's own suite says of a name, and where it says nothing.
#include <algorithm>

#include <gtest/gtest.h>

#include <sim/diagnose/record.hpp>

namespace mckibben::diagnose {
namespace {

TEST(Record, SharesHaveWilsonsInterval) {
  const auto [low, high] = Share{.yes = 81, .of = 263}.interval();  // Newcombe, Statist. Med. 17 (1998) 857
  EXPECT_NEAR(low, 0.2553, 5e-5);
  EXPECT_NEAR(high, 0.3662, 5e-5);
  EXPECT_EQ((Share{.yes = 0, .of = 20}.interval()[0]), 0.0);
  EXPECT_NEAR((Share{.yes = 0, .of = 20}.interval()[1]), 0.1611, 5e-5);
  EXPECT_NEAR((Share{.yes = 20, .of = 20}.interval()[1]), 1.0, 1e-12);
}

TEST(Record, HoldsBinsOneAfterTheOther) {
  EXPECT_EQ(record.names.front().margin, 0.0);
  EXPECT_TRUE(std::ranges::is_sorted(record.names, std::ranges::less(), &Bin::margin));
  for (const Bin& bin : record.names) EXPECT_GT(bin.right.of, 0);
  EXPECT_GT(record.false_alarms.of, 0);
}

NamedEffect leak(double fall, double before_rivals) {
  return {.name = "muscle_leak", .variant = "", .support = {.fall = fall, .before_rivals = before_rivals}};
}

int of(const std::optional<Share>& share) {
  return share ? share->of : -1;
}

TEST(Record, ANameIsWorthWhatItIsAheadBy) {
  const Diagnosis d;
  const auto& bins = record.names;
  EXPECT_EQ(of(confidence(d, leak(1e9, 1e9))), bins.back().right.of);
  EXPECT_EQ(of(confidence(d, leak(1e9, bins[1].margin))), bins[1].right.of);
  EXPECT_EQ(of(confidence(d, leak(0.5 * bins[1].margin, 1e9))), bins[0].right.of);
  NamedEffect open = leak(1e9, 1e9);
  open.confusable_with.emplace_back("polytropic_gas");
  const int several = record.first_of_several.of;
  EXPECT_EQ(of(confidence(d, open)), several > 0 ? several : -1);
}

TEST(Record, SaysNothingOfWhatTheSuiteDoesNotHold) {
  Diagnosis d;
  EXPECT_FALSE(confidence(d, leak(-1.0, 1e9)));
  NamedEffect other = leak(1e9, 1e9);
  other.stands_in = true;
  EXPECT_FALSE(confidence(d, other));
  other = leak(1e9, 1e9);
  other.name = "cord_creep";  // a user's own law
  EXPECT_FALSE(confidence(d, other));
  d.remaining.floors = 2.1;
  EXPECT_FALSE(confidence(d, leak(1e9, 1e9)));
  d.remaining.floors = 1.9;
  EXPECT_TRUE(confidence(d, leak(1e9, 1e9)));
  d.gap.judged = Judged::angle;
  EXPECT_FALSE(confidence(d, leak(1e9, 1e9)));
}

}  // namespace
}  // namespace mckibben::diagnose
