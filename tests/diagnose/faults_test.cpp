// Runs whose recording is at fault, each kind alone: found in its run, with its size;
// and sound runs left alone.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <gtest/gtest.h>

#include <sim/data/judged.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/run/simulate.hpp>

#include "examined.hpp"

namespace mckibben::diagnose {
namespace {

const domain::Dataset& undisturbed() {
  static const domain::Dataset data = small(plant::Rig{});
  return data;
}

using Spoil = std::function<void(double& ratio, double k)>;

domain::Dataset spoilt(std::size_t run, const Spoil& spoil) {
  domain::Dataset data = undisturbed();
  auto& ratios = data.runs[run].contraction_ratio;
  for (std::size_t k = 0; k < ratios.size(); ++k) spoil(ratios[k], static_cast<double>(k));
  return data;
}

double count() {
  return run::contraction_per_count(plant::Rig{});
}

void expect_one(const domain::Dataset& data, FaultKind kind, std::size_t run, double size, double tolerance) {
  const auto faults = faults_of(data);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].kind, kind);
  EXPECT_EQ(faults[0].run, run);
  EXPECT_NEAR(faults[0].size, size, tolerance);
  EXPECT_FALSE(faults[0].common);
}

TEST(Faults, SoundRunsHaveNone) {
  EXPECT_TRUE(faults_of(undisturbed()).empty());
}

TEST(Faults, ARunThatIsLate) {
  auto data = undisturbed();
  delay(data.runs[1], 3);
  expect_one(data, FaultKind::late, 1, 3.0, 0.3);
}

/// Of a recorder with a clock of its own, twelve of whose readings make a row.
TEST(Faults, ARunThatIsLateByAPartOfARow) {
  auto data = undisturbed();
  data.own_clock = true;
  data.rows_of_stamps = {.row_s = data.rig.tick_s, .readings = 12.0};
  auto& ratios = data.runs[1].contraction_ratio;
  for (std::size_t k = ratios.size(); k-- > 1;) ratios[k] = std::lerp(ratios[k], ratios[k - 1], 0.4);
  expect_one(data, FaultKind::late, 1, 0.4, 0.1);
  const Fault fault{1, FaultKind::late, 0.25};
  EXPECT_EQ(told(data, fault).words, "is 3 ms late");
  EXPECT_EQ(told(data, fault).unit, "s");
  Checked checked = no_doubts(data);
  mend(data, checked, {fault});
  EXPECT_EQ(checked.left_out, Runs{1});  // it cannot be shifted by a part of a row
}

TEST(Faults, CurrentThatTheValveDidNotHave) {
  auto scaled = undisturbed(), moved = undisturbed();
  for (double& current_mA : scaled.runs[4].current_mA) current_mA *= 1.05;
  for (double& current_mA : moved.runs[0].current_mA) current_mA += 0.4;
  expect_one(scaled, FaultKind::current_scale, 4, 0.05, 0.005);
  expect_one(moved, FaultKind::current_offset, 0, 0.4, 0.05);
}

/// With a valve that takes 0 to 10 V.
domain::Dataset in_volts(domain::Dataset data) {
  for (domain::Run& run : data.runs)
    for (double& command : run.current_mA) command = 10.0 * (command - 4.0) / plant::thesis_span_mA;
  plant::command_in(data.rig, plant::CommandUnit::V, 0.0, 10.0);
  return data;
}

TEST(Faults, VoltsThatTheValveDidNotHave) {
  auto data = in_volts(undisturbed());
  for (double& command_V : data.runs[4].current_mA) command_V *= 1.05;
  expect_one(data, FaultKind::current_scale, 4, 0.05, 0.005);
  EXPECT_EQ(told(data, {4, FaultKind::current_scale, 0.05}).words,
            "has a command that is 1.050 times what the valve had");
  EXPECT_EQ(told(data, {4, FaultKind::current_offset, 1.0}).words,
            "has a command that is 1.00 V more than what the valve had");
}

/// The pressure that a gauge read drives the muscle, in one run another one than the gauge says.
domain::Dataset driven_by_pressure(std::size_t run, double factor, double offset_Pa) {
  plant::Rig gauged;
  gauged.sensors.put(plant::gauge());
  domain::Dataset data = small(gauged);
  data.own_clock = true;
  for (domain::Run& each : data.runs) {
    const bool off = &each == &data.runs[run];
    domain::Measurement& measured = each.measured.emplace();
    for (std::size_t k = 0; k < each.contraction_ratio.size(); ++k) {
      measured.time_s.push_back(static_cast<double>(k) * data.rig.tick_s);
      const double read_Pa = (*each.muscle_pressure_Pa)[k];
      measured.give("muscle_pressure").push_back(off ? factor * read_Pa + offset_Pa : read_Pa);
    }
    measured.take("contraction") = std::exchange(each.contraction_ratio, {});
    each.current_mA.clear();
    each.muscle_pressure_Pa.reset();
  }
  return data::with_rows(std::move(data));
}

TEST(Faults, APressureThatTheMuscleDidNotHave) {
  const domain::Dataset scaled = driven_by_pressure(4, 1.05, 0.0);
  expect_one(scaled, FaultKind::current_scale, 4, 0.05, 0.01);
  EXPECT_EQ(told(scaled, {4, FaultKind::current_scale, 0.05}).words,
            "has a pressure that is 1.050 times what the muscle had");
  const domain::Dataset moved = driven_by_pressure(1, 1.0, 5e3);
  expect_one(moved, FaultKind::current_offset, 1, 0.05, 0.01);
  EXPECT_EQ(told(moved, {1, FaultKind::zero, 0.01}).words, "has its zero moved by 3 mm");
  EXPECT_EQ(told(moved, {1, FaultKind::late, 3.0}).words, "is 36 ms late");
}

TEST(Faults, ReadingsThatDriftOrHaveAnotherZeroOrScale) {
  const double rows = static_cast<double>(undisturbed().runs[0].contraction_ratio.size());
  const auto drift = [&](double& ratio, double k) { ratio += count() * std::round(8.0 * k / rows); };
  expect_one(spoilt(5, drift), FaultKind::drift, 5, 8.0 * count(), 0.5 * count());
  const auto zero = [](double& ratio, double) { ratio += 5.0 * count(); };
  expect_one(spoilt(2, zero), FaultKind::zero, 2, 5.0 * count(), 0.5 * count());
  const auto scale = [](double& ratio, double) { ratio = count() * std::floor(1.04 * ratio / count()); };
  expect_one(spoilt(3, scale), FaultKind::reading_scale, 3, 0.04, 0.005);
}

TEST(Faults, CountsAndRowsThatAreLostOnTheWay) {
  const auto slip = [](double& ratio, double k) { ratio -= k >= 180.0 ? 8.0 * count() : 0.0; };
  const auto slipped = faults_of(spoilt(1, slip));
  ASSERT_EQ(slipped.size(), 1u);
  EXPECT_EQ(slipped[0].kind, FaultKind::slipped);
  EXPECT_NEAR(slipped[0].size, -8.0 * count(), count());
  EXPECT_NEAR(static_cast<double>(slipped[0].row), 180.0, 10.0);
  auto lost = undisturbed();
  delay(lost.runs[2], 6, 150);
  expect_one(lost, FaultKind::rows_lost, 2, -6.0, 1.0);
}

TEST(Faults, ARunFromAnotherRig) {
  plant::Rig other;
  other.muscle.rest_radius_m *= 1.05;
  other.muscle.end_correction *= 1.03;
  auto data = undisturbed();
  data.runs[2] = small(other).runs[2];
  expect_one(data, FaultKind::another_rig, 2, 0.0, 0.0);
}

TEST(Faults, ThatSayWhatItIsAreBetterThanAnotherRig) {
  const std::vector<Fault> slipped{{1, FaultKind::slipped}}, other{{1, FaultKind::another_rig}},
      two{{1, FaultKind::late}, {4, FaultKind::drift}};
  std::vector<Fault> all;
  for (std::size_t run = 0; run < 6; ++run) all.push_back({run, FaultKind::late, 2.0, 0, true});
  EXPECT_TRUE(explains_more(slipped, other));
  EXPECT_TRUE(explains_more(two, other));
  EXPECT_TRUE(explains_more(slipped, two));
  EXPECT_TRUE(explains_more(all, two));
  EXPECT_FALSE(explains_more(all, slipped));
  EXPECT_FALSE(explains_more(slipped, all));
}

TEST(Faults, AGaugeIsShiftedOnlyIfItIsLateToo) {
  plant::Rig gauged;
  gauged.sensors.put(plant::gauge());
  auto data = small(gauged);
  const auto before = *data.runs[1].muscle_pressure_Pa;
  const std::vector<Fault> late{{1, FaultKind::late, 4.0}};
  auto both = data;
  delay(data.runs[1], 4);
  Checked checked = no_doubts(data);
  mend(data, checked, late);
  EXPECT_EQ(*data.runs[1].muscle_pressure_Pa, before);
  auto& gauge = *both.runs[1].muscle_pressure_Pa;
  for (std::size_t k = gauge.size(); k-- > 4;) gauge[k] = gauge[k - 4];
  checked = no_doubts(both);
  mend(both, checked, late);
  for (std::size_t k = 0; k + 4 < gauge.size(); ++k) ASSERT_EQ(gauge[k], before[k]);
}

TEST(Faults, AreMendedWhereThatIsSafeAndElseLeftOut) {
  auto data = undisturbed();
  const auto before = data.runs;
  delay(data.runs[0], 2);
  for (double& ratio : data.runs[1].contraction_ratio) ratio += 3.0 * count();
  Checked checked = no_doubts(data);
  mend(data, checked,
       {{0, FaultKind::late, 2.1}, {1, FaultKind::zero, 3.2 * count()}, {4, FaultKind::drift, 2e-3}});
  const auto& shifted = data.runs[0].contraction_ratio;
  const std::size_t rows = shifted.size();
  for (std::size_t k = 0; k + 2 < rows; ++k) ASSERT_EQ(shifted[k], before[0].contraction_ratio[k]);
  EXPECT_FALSE(checked.masked[0][rows - 3]);
  EXPECT_TRUE(checked.masked[0][rows - 2]);
  EXPECT_TRUE(checked.masked[0][rows - 1]);
  EXPECT_NEAR(data.runs[1].contraction_ratio[100], before[1].contraction_ratio[100], 1e-12);
  EXPECT_EQ(checked.left_out, Runs{4});
  ASSERT_EQ(checked.faulty.size(), 3u);
  EXPECT_EQ(checked.faulty[0].words, "is 2 ticks late and was shifted");
  EXPECT_EQ(checked.faulty[1].words, "has its zero moved by 3.2 counts (corrected)");
  EXPECT_EQ(checked.faulty[2].words, "drifts by 0.6 mm from its beginning to its end (left out)");
}

// Runs that were each begun at another zero; where the load tells it, it may be a law of the rig's.
TEST(Faults, EachRunMayHaveAZeroOfItsOwn) {
  const auto moved_by = [](const std::vector<double>& counts) {
    auto data = undisturbed();
    EXPECT_EQ(counts.size(), data.runs.size());
    for (std::size_t i = 0; i < data.runs.size(); ++i)
      for (double& ratio : data.runs[i].contraction_ratio) ratio += counts[i] * count();
    return faults_of(data);
  };
  const auto by_chance = moved_by({7.0, -5.0, 4.0, 9.0, -8.0, 6.0});
  ASSERT_EQ(by_chance.size(), 6u);
  for (const Fault& fault : by_chance) {
    EXPECT_EQ(fault.kind, FaultKind::zero);
    EXPECT_FALSE(fault.told_by_load);
  }
  EXPECT_NEAR(by_chance[1].size, -5.0 * count(), 1.5 * count());
  const auto by_load = moved_by({7.0, 7.2, -1.0, -1.2, -8.0, -8.1});
  ASSERT_EQ(by_load.size(), 6u);
  for (const Fault& fault : by_load) EXPECT_TRUE(fault.told_by_load);
  for (const Fault& fault : moved_by({8.0, 8.0, 8.1, 8.1, 8.2, 8.2})) EXPECT_FALSE(fault.told_by_load);
}

// Of runs that last longer than a search needs, a few are asked which effect it may be; what all have in
// common is taken out of all.
TEST(Faults, OfManyRunsAFewSayWhichEffectIsSuspected) {
  plant::Rig truth;
  truth.effects.get<plant::SpeedDependentFriction>().ratio = 0.8;
  auto kinds = three_kinds();
  kinds.pop_back();
  std::vector<domain::CampaignCurrent> currents;
  for (std::size_t i = 0; i < 4; ++i) {
    currents.push_back(kinds[i % 2]);
    currents.back().duration_s = 26.0 + static_cast<double>(i);
  }
  auto data = planted(truth, {11.138, 16.138, 23.406}, currents, 7);
  for (domain::Run& run : data.runs) hasten(run, 3);
  const Experiment experiment(data, no_doubts(data).masked, 2);
  Runs all(data.runs.size());
  std::iota(all.begin(), all.end(), 0);
  auto friction = catalogue();
  std::erase_if(friction, [](const Candidate& c) { return c.effect != plant::SpeedDependentFriction::name; });
  const auto found = examine(experiment, {data.rig, nominal_parameters(data.rig)}, all, friction);
  EXPECT_TRUE(found.faults.empty());
  ASSERT_FALSE(found.suspicions.empty());
  const Suspicion& first = found.suspicions.front();
  EXPECT_EQ(first.sound.size(), 10u);
  ASSERT_EQ(first.common.size(), 12u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(first.common[i].run, i);
}

}  // namespace
}  // namespace mckibben::diagnose
