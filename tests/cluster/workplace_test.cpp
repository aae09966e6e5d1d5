// Ranks that wait for others say so after a while, and for whom.
#include <csignal>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sim/cluster/handout.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::cluster {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t pieces = 3;

/// Rank 1: takes a piece of work and is stopped.
[[noreturn]] void take_one_and_stop(const std::filesystem::path& folder) {
  Workplace place(folder, {1, 2, "call", 1});
  place.begin("key");
  Handout handout(place, pieces, [](std::size_t) { return false; });
  handout.take();
  raise(SIGSTOP);
  _exit(0);
}

TEST(Handout, SaysWhoIsStoppedAndGoesOnOnceThatHasEnded) {
  const Scratch scratch;
  const auto folder = scratch / "out.ranks";
  std::string said;
  Workplace place(
      folder, {0, 2, "call", 1}, [&](const std::string& text) { said += text + "\n"; }, 50ms);
  const pid_t other = fork();
  if (other == 0) take_one_and_stop(folder);
  place.begin("key");
  int status = 0;
  ASSERT_EQ(waitpid(other, &status, WUNTRACED), other);
  ASSERT_TRUE(WIFSTOPPED(status));

  std::set<std::size_t> there;
  Handout handout(place, pieces, [&](std::size_t i) { return there.contains(i); });
  do {
    while (const auto i = handout.take()) {
      there.insert(*i);
      handout.done(*i);
    }
    if (said.empty() || there.size() == pieces) continue;
    kill(other, SIGKILL);
    waitpid(other, &status, 0);
  } while (handout.again());
  EXPECT_EQ(there.size(), pieces);
  EXPECT_TRUE(holds(said, "waiting for work that other ranks have begun",
                    "rank 1 (process " + std::to_string(other) + ") is stopped: kill -CONT"))
      << said;
}

}  // namespace
}  // namespace mckibben::cluster
