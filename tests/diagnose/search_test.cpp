// A search is ended by time; what it had reached stands.
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include <sim/diagnose/search.hpp>

namespace mckibben::diagnose {
namespace {

void work_until_told() {
  while (!run::interrupted()) std::this_thread::yield();
  throw run::Interrupted();
}

TEST(Search, GoesThroughWithoutALimit) {
  Search search;
  int done = 0;
  EXPECT_TRUE(search.part("one", [&] { ++done; }));
  EXPECT_TRUE(search.part("two", [&] { ++done; }));
  EXPECT_EQ(done, 2);
  EXPECT_EQ(search.ended(), Ended::no);
  EXPECT_TRUE(search.not_done().empty());
}

TEST(Search, EndsWhereItsTimeIsOver) {
  Search search(0.02);
  int reached = 0;
  EXPECT_FALSE(search.part("long", [&] {
    reached = 1;
    work_until_told();
  }));
  EXPECT_EQ(reached, 1);
  EXPECT_FALSE(run::interrupted());  // what follows goes on
  EXPECT_FALSE(search.part("later", [&] { reached = 2; }));
  EXPECT_FALSE(search.part("later", [&] { reached = 2; }));
  EXPECT_EQ(reached, 1);
  EXPECT_EQ(search.ended(), Ended::by_time);
  EXPECT_EQ(search.not_done(), (std::vector<std::string>{"long", "later"}));
}

TEST(Search, EndsWhenTheUserAsks) {
  run::catch_interrupts();
  Search search;
  EXPECT_FALSE(search.part("long", [] {
    std::raise(SIGTERM);
    work_until_told();
  }));
  EXPECT_EQ(search.ended(), Ended::by_user);
  EXPECT_FALSE(run::interrupted());
}

TEST(Search, LetsOtherFailuresThrough) {
  Search search;
  EXPECT_THROW(search.part("one", [] { throw std::runtime_error("broken"); }), std::runtime_error);
  EXPECT_EQ(search.ended(), Ended::no);
}

}  // namespace
}  // namespace mckibben::diagnose
