// Work in a process of its own: what it returns, why it refuses, and how it ends.
#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/formats/isolated.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

using Parts = std::vector<std::string>;

std::string refusal(const std::function<Parts()>& work) {
  try {
    isolated(work);
  } catch (const BadFile& bad) {
    return bad.what();
  }
  return "";
}

TEST(Isolated, GivesWhatTheWorkReturns) {
  const Parts parts{"", std::string("a\0b", 3), std::string(1U << 20U, 'x')};
  EXPECT_EQ(isolated([&] { return parts; }), parts);
  EXPECT_EQ(isolated([] { return Parts{}; }), Parts{});
}

TEST(Isolated, ACrashIsADamagedFile) {
  EXPECT_EQ(refusal([]() -> Parts { throw BadFile("it has a password"); }), "it has a password");
  EXPECT_EQ(refusal([]() -> Parts {
              raise(SIGKILL);
              return {};
            }),
            "it is damaged: the library that reads it ended by Killed");
  EXPECT_NE(refusal([]() -> Parts { std::abort(); }), "");
}

}  // namespace
}  // namespace mckibben::formats
