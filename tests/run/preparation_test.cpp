// Ticks before tick 0: stepped in order, felt by the rig, left out of recording and ledger.
#include <vector>

#include <gtest/gtest.h>

#include <controllers/open_loop.hpp>
#include <controllers/open_loop_limited.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/simulate.hpp>

#include "heap_watch.hpp"

namespace mckibben::run {
namespace {

class Preparing final : public controllers::Controller {
 public:
  explicit Preparing(std::int64_t ticks) : ticks_(ticks) {}
  controllers::Command rest() override { return {4.0}; }
  std::int64_t preparation_ticks() const override { return ticks_; }
  controllers::Command step(const controllers::Reading& reading) override {
    stepped.push_back(reading);
    return {reading.tick < 0 ? 12.0 : 4.0};
  }
  std::vector<controllers::Finding> findings() const override { return {{"steps", "1", 3.0}}; }

  std::vector<controllers::Reading> stepped;

 private:
  std::int64_t ticks_;
};

RunPlan plan(std::size_t ticks) {
  RunPlan plan;
  plan.load_kg = 16.138;
  plan.ticks = ticks;
  plan.keep_ledger = true;
  return plan;
}

TEST(Preparation, TicksAreSteppedInOrderAndNotRecorded) {
  Preparing controller(100);
  const Recording recording = simulate(plan(10), controller);
  ASSERT_EQ(controller.stepped.size(), 110u);
  for (std::size_t i = 0; i < 110; ++i) {
    EXPECT_EQ(controller.stepped[i].tick, static_cast<std::int64_t>(i) - 100);
    EXPECT_NEAR(controller.stepped[i].time_s, 0.012 * (static_cast<double>(i) - 100.0), 1e-12);
  }
  ASSERT_EQ(recording.samples.size(), 10u);
  EXPECT_EQ(recording.samples.front().time_s, 0.0);
  EXPECT_GT(recording.samples.front().state.joint.contraction_ratio, 0.1)
      << "what was lifted before stays up";
  EXPECT_EQ(controller.stepped[0].counts, controller.stepped[1].counts)
      << "the current of the first preparation tick is felt in the one after";
  EXPECT_GT(controller.stepped[100].counts, 200);
}

TEST(Preparation, LedgerBeginsAtTickZero) {
  Preparing controller(100);
  const Recording one_row = simulate(plan(1), controller);
  EXPECT_EQ(one_row.ledger.air_drawn_kg, 0.0);
  EXPECT_EQ(one_row.ledger.braid_work_J, 0.0);
  Preparing again(100);
  EXPECT_NE(simulate(plan(50), again).ledger.braid_work_J, 0.0);
}

TEST(Preparation, FindingsAreCarriedIntoTheRecording) {
  Preparing controller(0);
  const Recording recording = simulate(plan(2), controller);
  ASSERT_EQ(recording.findings.size(), 1u);
  EXPECT_EQ(recording.findings[0].name, "steps");
  EXPECT_EQ(recording.findings[0].value, 3.0);
}

// The rig's own friction law, and pressures that move a load somehow.
controllers::Calibration rough_calibration() {
  controllers::Calibration model;
  model.contraction_friction = {0.046937, 0.0, -0.139715, 0.005306};
  model.contraction = {
      .a0 = {1e5}, .a1_0 = {0.0}, .a1_1 = {4e5}, .a2_0 = {0.0}, .a2_1 = {0.0}, .a3 = {0.0}, .a4 = {0.0}};
  model.relaxation = {.b0_0 = {0.0},
                      .b0_1 = {8e4},
                      .b1 = {4e5},
                      .b2 = {0.0},
                      .b3 = {0.0},
                      .b4_0 = {0.0},
                      .b4_1 = {0.0},
                      .b4_2 = {0.0}};
  model.range = {0.01, 0.25, 1.0, 100.0, 5.0, 17.0};
  return model;
}

// What is left is the thesis's assumption that pressure follows
// the current at once: while it rises it stays behind, and the load looks heavier than it is.
TEST(Preparation, AnOpenLoopControllerWeighsTheLoadToTheThesissFifteenPerCent) {
  controllers::OpenLoopSettings settings;
  settings.model = rough_calibration();
  for (const double load_kg : {8.87, 16.138, 23.406}) {
    RunPlan run = plan(2);
    run.load_kg = load_kg;
    const auto controller = settings.make(knowledge_of(run.rig, {0.1, 0.1}));
    const Recording recording = simulate(run, *controller);
    ASSERT_EQ(recording.findings[0].name, "weighed_load");
    EXPECT_NEAR(recording.findings[0].value, load_kg, 0.15 * load_kg);
    EXPECT_GT(recording.findings[0].value, load_kg);
    EXPECT_LT(recording.findings[1].value, 0.05 * load_kg) << "spread";
  }
}

TEST(Preparation, WhatItNeedsIsAllocatedBeforeTickZero) {
  controllers::OpenLoopLimitedSettings settings;
  settings.model = rough_calibration();
  const RunPlan run = plan(300);
  std::vector<double> target(300, 0.05);
  for (std::size_t k = 50; k < 200; ++k) target[k] = 0.15;
  auto knowledge = knowledge_of(run.rig, target);
  knowledge.reach = reachable(run.rig);
  Watched controller(settings.make(knowledge), 299);
  simulate(run, controller);
  EXPECT_EQ(controller.allocations, 0);
}

}  // namespace
}  // namespace mckibben::run
