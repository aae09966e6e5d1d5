// Jobs over threads: each once, the first failure by index, and an orderly stop.
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <sim/run/batch.hpp>

namespace mckibben::run {
namespace {

TEST(Batch, DoesEachJobOnceOnAnyNumberOfThreads) {
  for (const unsigned threads : {1u, 2u, 7u, 64u}) {
    std::vector<std::atomic<int>> times(20);
    std::vector<std::atomic<int>> heard(times.size() + 1);
    for_each_job(
        times.size(), threads, [&](std::size_t i) { ++times[i]; },
        [&](std::size_t done) { ++heard.at(done); });
    for (const auto& count : times) EXPECT_EQ(count, 1);
    EXPECT_EQ(heard[0], 0);
    for (std::size_t done = 1; done < heard.size(); ++done) EXPECT_EQ(heard[done], 1);
  }
}

TEST(Batch, ThrowsTheFirstFailureByIndexAfterAllHaveEnded) {
  std::atomic<int> ended{0};
  const auto job = [&](std::size_t i) {
    ++ended;
    if (i == 3 || i == 7) throw std::runtime_error(std::to_string(i));
  };
  try {
    for_each_job(10, 4, job, [](std::size_t) {});
    FAIL();
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "3");
  }
  EXPECT_EQ(ended, 10);
}

TEST(Batch, StopsBetweenJobsWhenInterrupted) {
  const auto work = [] {
    catch_interrupts();
    int begun = 0;
    try {
      for_each_job(
          10, 1,
          [&](std::size_t i) {
            ++begun;
            if (i == 2) std::raise(SIGINT);
          },
          [](std::size_t) {});
    } catch (const Interrupted&) {
      std::_Exit(begun);  // the job that was running is finished, no other begun
    }
    std::_Exit(100);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(3), "");
}

TEST(Batch, WhatOneThreadsWorkIsAskedStopsNoOther) {
  const auto jobs_done = [](bool stops) {
    OwnStop stop;
    std::atomic<int> begun{0};
    try {
      for_each_job(
          50, 3,
          [&](std::size_t) {
            if (++begun == 5 && stops) stop.ask();
          },
          [](std::size_t) {});
    } catch (const Interrupted&) {
      EXPECT_TRUE(take_interrupt());
      EXPECT_TRUE(interrupted()) << "it stays asked";
    }
    return begun.load();
  };
  std::atomic<int> other{0};
  {
    std::jthread beside([&] { other = jobs_done(false); });
    EXPECT_LT(jobs_done(true), 50);
  }
  EXPECT_EQ(other, 50);
  EXPECT_FALSE(interrupted());
}

}  // namespace
}  // namespace mckibben::run
