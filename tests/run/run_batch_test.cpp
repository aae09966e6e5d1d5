// Runs in batches: each is what it is alone, within the tolerance, whatever shares the batch; one that
// fails, fails alone.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "campaign_runs.hpp"
#include "switched_on.hpp"

namespace mckibben::run {
namespace {

/// Runs of 200 ticks under a sine that lifts and lowers.
class Runs {
 public:
  void add(plant::Rig rig, double load_kg, const solver::Settings& engine = {},
           const plant::Noise& noise = {}) {
    rig.integrator = engine;
    plans_.push_back({.rig = rig, .load_kg = load_kg, .ticks = 200, .noise = noise, .stream = plans_.size()});
  }
  void keep_ledgers() {
    for (RunPlan& plan : plans_) plan.keep_ledger = true;
  }
  Recording alone(std::size_t i) const {
    const Order order = order_of(i);
    return simulate(order.plan, *order.controller);
  }
  std::vector<Recording> in_batch(unsigned threads = 1) const {
    std::vector<Recording> recordings(plans_.size());
    simulate_all(
        plans_.size(), threads, [&](std::size_t i) { return order_of(i); },
        [&](std::size_t i, Recording recording) { recordings[i] = std::move(recording); });
    return recordings;
  }

 private:
  Order order_of(std::size_t i) const {
    controllers::SineCurrent sine;
    sine.low_mA = 0.0;
    sine.period_s = 2.4;
    return {plans_[i], sine.make(knowledge_of(plans_[i].rig, {}))};
  }

  std::vector<RunPlan> plans_;
};

double furthest(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.samples.size(), b.samples.size());
  double most = 0.0;
  for (std::size_t k = 0; k < std::min(a.samples.size(), b.samples.size()); ++k)
    most = std::max(most, std::abs(a.samples[k].state.joint.contraction_ratio -
                                   b.samples[k].state.joint.contraction_ratio));
  return most;
}

Runs ten_of_all_kinds(const solver::Settings& settings) {
  Runs runs;
  for (const double load_kg : {8.0, 11.138, 16.138, 23.406}) runs.add({}, load_kg, settings);
  for (const double scale : {0.5, 2.0}) {
    plant::Rig rig;
    rig.friction.scale = scale;
    rig.muscle.rest_radius_m = 8e-3;
    runs.add(rig, 12.0, settings);
  }
  plant::Rig creeping, leaking, by_area;
  plant::switch_on(creeping.effects.get<plant::BladderCreep>(), plant::BladderCreep::variants.front());
  plant::switch_on(leaking.effects.get<plant::MuscleLeak>(), plant::MuscleLeak::variants.front());
  by_area.friction.law = plant::FrictionLaw::area;
  for (const plant::Rig& rig : {creeping, leaking, by_area}) runs.add(rig, 14.0, settings);
  runs.add({}, 20.0, settings);
  return runs;
}

TEST(RunBatch, EachRunIsWhatItIsAlone) {
  for (const auto& [tolerance, most] : {std::pair{solver::tightest_tolerance, 1e-9}, {1e-6, 2e-6}}) {
    const Runs runs = ten_of_all_kinds({solver::Method::automatic, tolerance});
    const std::vector<Recording> together = runs.in_batch();
    for (std::size_t i = 0; i < together.size(); ++i) {
      EXPECT_TRUE(together[i].failure.empty()) << together[i].failure;
      const Recording alone = runs.alone(i);
      EXPECT_LT(furthest(together[i], alone), most) << "run " << i << " at " << tolerance;
      EXPECT_GT(together[i].solver.steps, 200);
    }
  }
}

TEST(RunBatch, LedgersComeAlongAndChangeNothing) {
  const Runs without = ten_of_all_kinds({});
  Runs with = ten_of_all_kinds({});
  plant::Rig polytropic;  // its ledger is kept alone, as is that of any gas with a temperature
  plant::switch_on(polytropic.effects.get<plant::PolytropicGas>(), plant::PolytropicGas::variants.front());
  with.add(polytropic, 14.0);
  plant::Rig warming;
  plant::switch_on(warming.effects.get<plant::GasTemperature>(), plant::GasTemperature::variants.front());
  with.add(warming, 14.0);
  with.keep_ledgers();
  const std::vector<Recording> plain = without.in_batch(), kept = with.in_batch();
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(furthest(kept[i], plain[i]), 0.0) << i;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_GT(kept[i].ledger.air_drawn_kg, 0.0) << i;
    EXPECT_LT(kept[i].imbalance.gas, 1e-6) << i;
    EXPECT_LT(kept[i].imbalance.energy, 1e-6) << i;
    const plant::Ledger<double> alone = with.alone(i).ledger;
    EXPECT_NEAR(kept[i].ledger.air_drawn_kg, alone.air_drawn_kg, 1e-5 * alone.air_drawn_kg) << i;
    EXPECT_NEAR(kept[i].ledger.thread_friction_work_J, alone.thread_friction_work_J,
                1e-4 * alone.thread_friction_work_J)
        << i;
  }
}

TEST(RunBatch, OtherRunsMakeNoDifference) {
  const Runs all = ten_of_all_kinds({});
  Runs three;  // some of them
  for (const double load_kg : {16.138, 8.0, 20.0}) three.add({}, load_kg);
  const std::vector<Recording> of_ten = all.in_batch(), of_three = three.in_batch(), on_two = all.in_batch(2);
  EXPECT_EQ(furthest(of_ten[2], of_three[0]), 0.0);
  EXPECT_EQ(furthest(of_ten[0], of_three[1]), 0.0);
  EXPECT_EQ(furthest(of_ten[9], of_three[2]), 0.0);
  for (std::size_t i = 0; i < of_ten.size(); ++i) EXPECT_EQ(furthest(of_ten[i], on_two[i]), 0.0) << i;
}

TEST(RunBatch, ARunThatFailsFailsAlone) {
  Runs runs;
  plant::Rig soft;  // its load falls past the range of the laws
  soft.muscle.stop_stiffness_N_per_m = 1e3;
  soft.muscle.stop_damping_s_per_m = 0.0;
  plant::Rig weightless;
  weightless.joint.wheel_inertia_kg_m2 = 0.0;
  runs.add({}, 11.138);
  runs.add(soft, 400.0);
  runs.add(weightless, 0.0);
  runs.add({}, 23.406);
  const std::vector<Recording> together = runs.in_batch();
  EXPECT_NE(together[1].failure.find("integration failed"), std::string::npos) << together[1].failure;
  EXPECT_EQ(together[1].samples.size(), runs.alone(1).samples.size());
  EXPECT_NE(together[2].failure.find("leave no load"), std::string::npos);
  for (const std::size_t i : {0u, 3u}) {
    EXPECT_TRUE(together[i].failure.empty()) << together[i].failure;
    EXPECT_LT(furthest(together[i], runs.alone(i)), 2e-6);
  }
}

TEST(RunBatch, StiffRunsAreLeftToTheirOwnSteps) {
  Runs runs;
  plant::Rig stiff;
  stiff.friction.bristle_stiffness_N_per_m = 1e8;
  runs.add(stiff, 11.138);
  runs.add({}, 11.138);
  const std::vector<Recording> together = runs.in_batch();
  EXPECT_GE(together[0].solver.jacobians, 1);
  EXPECT_EQ(together[1].solver.jacobians, 0);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(furthest(together[i], runs.alone(i)), 2e-6) << i;
}

TEST(RunBatch, WithExactStickAndSlipEachRidesAlone) {
  Runs runs;
  plant::Rig coulomb;
  coulomb.friction.memory = plant::FrictionMemory::coulomb;
  runs.add(coulomb, 11.138);
  runs.add({}, 16.138);
  EXPECT_EQ(furthest(runs.in_batch()[0], runs.alone(0)), 0.0);
}

TEST(RunBatch, WhatIsThrownOnTheWayComesOut) {
  const auto order = [](std::size_t) {
    const RunPlan plan{.rig = {}, .load_kg = 11.138, .ticks = 20};
    return Order{plan, controllers::StairCurrent{}.make(knowledge_of(plan.rig, {}))};
  };
  const auto full = [](std::size_t, const Recording&) { throw std::runtime_error("disk full"); };
  EXPECT_THROW(simulate_all(5, 2, order, full), std::runtime_error);
}

TEST(RunBatch, NoiseIsTheRunsOwn) {
  Runs runs;
  for (int i = 0; i < 3; ++i) runs.add({}, 11.138, {}, {.encoder_jitter = 1e-3, .current_mA = 0.1});
  const std::vector<Recording> together = runs.in_batch();
  EXPECT_GT(furthest(together[0], together[1]), 1e-4);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(furthest(together[i], runs.alone(i)), 2e-6) << i;
}

TEST(RunBatch, ARunOfACampaignDoesNotDependOnWhatElseIsAskedFor) {
  domain::Campaign campaign;
  campaign.loads_kg = {9.0, 11.138, 13.0, 16.138, 23.406};
  campaign.currents = {{"a", 0.6, controllers::SineCurrent{}}, {"b", 0.6, controllers::StairCurrent{}}};
  const auto jobs = jobs_of(campaign);
  const auto last = [&](std::span<const CampaignJob> asked) {
    Recording recording;
    run_jobs(campaign, asked, 1, [&](const CampaignRun& run) {
      if (run.job.id == jobs.back().id) recording = run.recording;
    });
    return recording;
  };
  EXPECT_EQ(furthest(last(jobs), last(std::span(jobs).last(1))), 0.0);
}

}  // namespace
}  // namespace mckibben::run
