// Warnings of one kind are one.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/data/warnings.hpp>

namespace mckibben::data {
namespace {

using Lines = std::vector<std::string>;

TEST(Warnings, OfOneKindAreOne) {
  Lines many;
  for (const char* id : {"r01", "r02", "r03", "r04", "r05", "r06"})
    many.push_back(warning_of_run(id, "the gauge is ignored"));
  many.insert(many.begin() + 2, "the data set is short");
  EXPECT_EQ(grouped(many),
            (Lines{"6 runs (r01, r02, r03, r04 and 2 more): the gauge is ignored", "the data set is short"}));
}

TEST(Warnings, OfManyRunsThatDifferInNumbersShowThoseOfTheFirst) {
  Lines many{warning_of_run("a at 3.5 kg", "off by 1.2e-3 at 7 of 10 ticks"),
             warning_of_run("b at 3.5 kg", "off by -9e-4 at 12 of 10 ticks"),
             warning_of_run("c at 3.5 kg", "off by 0.2 at 1 of 10 ticks")};
  EXPECT_EQ(grouped(many), many) << "few enough to tell each";
  many.push_back(warning_of_run("d at 3.5 kg", "off by 3 at 4 of 10 ticks"));
  EXPECT_EQ(
      grouped(many),
      (Lines{"4 runs (a at 3.5 kg, b at 3.5 kg, c at 3.5 kg, d at 3.5 kg): for example a at 3.5 kg: off "
             "by 1.2e-3 at 7 of 10 ticks"}));
}

TEST(Warnings, OfOtherKindsStayApart) {
  const Lines apart{"run r01: it is late", "run r02: it is early", "r03 is bad", "r04 is bad"};
  EXPECT_EQ(grouped(apart), apart);
  EXPECT_EQ(grouped({"twice", "twice"}), Lines{"twice"});
  EXPECT_EQ(grouped({"run r01: odd", "run r01: odd"}), Lines{"run r01: odd"});
}

}  // namespace
}  // namespace mckibben::data
