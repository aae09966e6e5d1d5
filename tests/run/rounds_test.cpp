// Searches that are simulated together: each finds what it finds alone, and one that fails holds nobody up.
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/waveform.hpp>
#include <sim/run/rounds.hpp>

namespace mckibben::run {
namespace {

Order lifting(double load_kg) {
  RunPlan plan;
  plan.load_kg = load_kg;
  plan.ticks = 30;
  controllers::SineCurrent sine;
  sine.low_mA = 0.0;
  sine.period_s = 0.7;
  auto controller = sine.make(knowledge_of(plan.rig, {}));
  return {plan, std::move(controller)};
}

double height(const Recording& recording) {
  return recording.samples.back().state.joint.contraction_ratio;
}

// Looks where the last height leads it, a number of times that differs from search to search.
std::vector<double> search(std::size_t which, Rounds& rounds) {
  std::vector<double> heights{0.05};
  for (std::size_t step = 0; step <= which; ++step) {
    std::vector<Order> orders;
    orders.push_back(lifting(8.0 + static_cast<double>(which) + 10.0 * heights.back()));
    heights.push_back(height(rounds.simulated(std::move(orders)).front()));
  }
  return heights;
}

std::vector<std::vector<double>> together(std::size_t count, unsigned threads) {
  std::vector<std::vector<double>> found(count);
  search_in_rounds(count, threads, [&](std::size_t i, Rounds& rounds) { found[i] = search(i, rounds); });
  return found;
}

TEST(Rounds, EachSearchFindsWhatItFindsAlone) {
  const auto found = together(4, 2);
  EXPECT_EQ(found, together(4, 1));
  for (std::size_t i = 0; i < found.size(); ++i) {
    Rounds alone(1, 1);
    EXPECT_EQ(found[i], search(i, alone)) << i;
  }
}

TEST(Rounds, RunsComeBackInTheOrderInWhichTheyWereAskedFor) {
  Rounds alone(1, 1);
  std::vector<Order> orders;
  for (const double load_kg : {20.0, 8.0}) orders.push_back(lifting(load_kg));
  const auto both = alone.simulated(std::move(orders));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_LT(height(both[0]), height(both[1]));
}

TEST(Rounds, ASearchThatFailsHoldsNobodyUp) {
  std::vector<double> last(3);
  const auto failing = [&](std::size_t i, Rounds& rounds) {
    if (i == 1) throw std::logic_error("defect");
    last[i] = search(i, rounds).back();
  };
  EXPECT_THROW(search_in_rounds(3, 1, failing), std::logic_error);
  EXPECT_GT(last[0], 0.0);
  EXPECT_GT(last[2], 0.0);
}

}  // namespace
}  // namespace mckibben::run
