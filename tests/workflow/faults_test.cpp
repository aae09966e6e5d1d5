// Faults of the recording in all runs at once, told from effects: every effect of the catalogue is tried.
#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/run/simulate.hpp>

#include "diagnose/examined.hpp"

namespace mckibben::diagnose {
namespace {

TEST(Faults, AnEffectThatIsMissingIsNone) {
  plant::Rig lag, creep, late, shown_late;
  lag.effects.get<plant::ValveLag>().time_s = 0.03;
  creep.effects.get<plant::BladderCreep>().stiffness_N_per_m = 200.0;
  creep.effects.get<plant::BladderCreep>().time_s = 1.5;
  late.effects.get<plant::CommandDelay>().time_s = 0.024;  // what all runs have, and a run alone may have too
  shown_late.effects.get<plant::ReadingDelay>().time_s = 0.03;
  for (const plant::Rig& truth : {lag, creep, late, shown_late})
    EXPECT_TRUE(faults_of(small(truth), catalogue()).empty());
}

TEST(Faults, WhatAllRunsHaveInCommonIsTheRecorders) {
  auto early = small(plant::Rig{}), drifting = early;
  const double count = run::contraction_per_count(plant::Rig{});
  for (domain::Run& run : early.runs) hasten(run, 2);
  for (domain::Run& run : drifting.runs)
    for (std::size_t k = 0; k < run.contraction_ratio.size(); ++k)
      run.contraction_ratio[k] += count * std::floor(static_cast<double>(k) / 40.0);
  for (const auto& [data, kind] :
       {std::pair{early, FaultKind::late}, std::pair{drifting, FaultKind::drift}}) {
    const auto faults = faults_of(data, catalogue());
    ASSERT_EQ(faults.size(), 6u);
    for (const Fault& fault : faults) {
      EXPECT_EQ(fault.kind, kind);
      EXPECT_TRUE(fault.common);
    }
  }
}

// What a model leaves that was not looked for to the end says nothing of a run.
TEST(Faults, ASearchThatWasCutAccusesNoRun) {
  auto data = small(plant::Rig{}, 2.0);
  delay(data.runs[1], 3);
  const Diagnosis cut = diagnose(data, {.threads = 2, .time_limit_s = 0.0}, [](const auto&, auto, auto) {});
  EXPECT_EQ(cut.ended, Ended::by_time);
  EXPECT_TRUE(cut.faults.empty());
  EXPECT_TRUE(std::ranges::count(cut.not_done, "faults of runs")) << cut.because;
  EXPECT_TRUE(std::ranges::count(cut.not_done, "faults of runs beside what was found")) << cut.because;
}

// No effect alone, and no earliness alone, comes near: with both there is something to fit.
TEST(Faults, OfAllRunsAreSuspectedBesideAnEffect) {
  plant::Rig truth;
  truth.effects.get<plant::SpeedDependentFriction>().ratio = 0.8;
  auto data = small(truth);
  for (domain::Run& run : data.runs) hasten(run, 3);
  const Experiment experiment(data, no_doubts(data).masked, 2);
  const auto found =
      examine(experiment, {data.rig, nominal_parameters(data.rig)}, {0, 1, 2, 3, 4, 5}, catalogue());
  EXPECT_TRUE(found.faults.empty());
  ASSERT_FALSE(found.suspicions.empty());
  const Suspicion& first = found.suspicions.front();
  EXPECT_EQ(first.effect.candidate.effect, "speed_dependent_friction");
  EXPECT_LT(first.effect.amplitude, 1.0);
  EXPECT_EQ(first.sound.size(), 6u);
  ASSERT_EQ(first.common.size(), 6u);
  for (const Fault& fault : first.common) {
    EXPECT_EQ(fault.kind, FaultKind::late);
    EXPECT_EQ(fault.size, -3.0);
  }
}

}  // namespace
}  // namespace mckibben::diagnose
