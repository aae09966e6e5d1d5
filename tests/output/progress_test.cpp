// The progress line: how much is done, and the time left once it can be told.
#include <gtest/gtest.h>

#include <sim/output/progress.hpp>

namespace mckibben::output {
namespace {

TEST(Progress, SaysWhatIsDoneAndTheTimeLeft) {
  EXPECT_EQ(progress_line("five", "simulating", 9, 36, 0.5, 200),
            "five: simulating [#######.......................] 9/36");
  EXPECT_EQ(progress_line("five", "simulating", 9, 36, 3.0, 200),
            "five: simulating [#######.......................] 9/36, 9 s left");
  EXPECT_EQ(progress_line("a", "b", 1, 100, 2.0, 200),
            "a: b [..............................] 1/100, 3 min 18 s left");
  EXPECT_EQ(progress_line("a", "b", 1, 1001, 10.0, 200),
            "a: b [..............................] 1/1001, 2 h 46 min left");
}

TEST(Progress, SaysNoTimeThatCannotBeTold) {
  EXPECT_EQ(progress_line("a", "b", 0, 4, 9.0, 200), "a: b [..............................] 0/4");
  EXPECT_EQ(progress_line("a", "b", 4, 4, 9.0, 200), "a: b [##############################] 4/4");
  EXPECT_EQ(progress_line("a", "b", 0, 0, 9.0, 200), "a: b [##############################] 0/0");
  EXPECT_EQ(progress_line("a", "b", 5, 4, 9.0, 200), "a: b [##############################] 5/4");
}

TEST(Progress, FitsTheTerminal) {
  EXPECT_EQ(progress_line("a long title", "simulating", 9, 36, 3.0, 20), "a long title: simula");
}

}  // namespace
}  // namespace mckibben::output
