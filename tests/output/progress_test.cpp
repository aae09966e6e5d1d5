// The progress line: how much is done, and the time left once it can be told.
#include <algorithm>
#include <chrono>
#include <string>

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

TEST(Progress, HasNoBarForWorkWithoutAKnownEnd) {
  EXPECT_EQ(progress_line("a", "b", 23, 0, 75.0, 200), "a: b, step 23, 1 min 15 s so far");
}

TEST(Progress, SaysALineNowAndThenInAPipe) {
  testing::internal::CaptureStderr();
  {
    Progress progress("a", std::chrono::milliseconds(0));
    progress.hook()("b", 1, 0);
    progress.hook()("c", 1, 2);
    Progress("d").hook()("e", 1, 0);
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(said.starts_with("a: b, step 1, ")) << said;
  EXPECT_NE(said.find("\na: c ["), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << said;  // nothing of d: no minute has passed
}

TEST(Progress, FitsTheTerminal) {
  EXPECT_EQ(progress_line("a long title", "simulating", 9, 36, 3.0, 20), "a long title: simula");
}

}  // namespace
}  // namespace mckibben::output
