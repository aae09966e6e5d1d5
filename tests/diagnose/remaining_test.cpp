// What is left, and where it lies.
#include <gtest/gtest.h>

#include <sim/diagnose/remaining.hpp>

namespace mckibben::diagnose {
namespace {

Cell cell(const char* factor, const char* name, std::size_t rows, double share, bool significant = true) {
  return {.factor = factor, .cell = name, .rows = rows, .share_of_gap = share, .significant = significant};
}

TEST(Remaining, LiesWhereMuchOfItIsInLittleOfTheData) {
  const std::vector<Cell> map{cell("speed", "slow", 700, 0.3),
                              cell("speed", "fast", 300, 0.7),
                              cell("load", "8 kg", 500, 0.55),
                              cell("load", "20 kg", 500, 0.45),
                              cell("time", "early", 100, 0.9),
                              cell("time", "late", 900, 0.1),
                              cell("direction", "rising", 100, 0.8, false),
                              cell("direction", "falling", 900, 0.2, false)};
  const auto found = densest(map);
  ASSERT_EQ(found.size(), 2u);  // loads share it evenly; that it rises may be chance
  EXPECT_EQ(found[0].cell.cell, "early");
  EXPECT_NEAR(found[0].share_of_time, 0.1, 1e-12);
  EXPECT_EQ(found[1].cell.cell, "fast");
}

TEST(Remaining, IsSaidWhereItIsMoreThanNoise) {
  EXPECT_EQ(sentence_of(Remaining{.floors = 1.9, .share = 0.5}), "");
  EXPECT_EQ(sentence_of(Remaining{.floors = 5.0, .share = 0.5}),
            " 5 times the noise floor remains, in no part of the data more than in others.");
  EXPECT_EQ(sentence_of(Remaining{.floors = 168.4, .share = 0.5}),
            " 170 times the noise floor remains, in no part of the data more than in others.");
  EXPECT_EQ(sentence_of(Remaining{
                .floors = 5.0, .share = 0.5, .pattern = {{cell("speed", "above 100 mm/s", 20, 0.62), 0.2}}}),
            " 5 times the noise floor remains, 62 % of it in 20 % of the readings: speed above 100 mm/s.");
}

}  // namespace
}  // namespace mckibben::diagnose
