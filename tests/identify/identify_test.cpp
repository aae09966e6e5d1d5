// Small data sets whose answer is known, from their readings to the verdict.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/identify/estimates.hpp>
#include <sim/identify/identify.hpp>

#include "diagnose/planted.hpp"

namespace mckibben::identify {
namespace {

using Names = std::vector<std::string>;

Names named(const Identified& found) {
  return found.table[found.decision.chosen].names;
}

plant::Rig leaky() {
  plant::Rig rig;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
  return rig;
}

TEST(Identify, NamesTheLeak) {
  const Identified found = identify(diagnose::small(leaky()), {.threads = 2});
  EXPECT_EQ(found.decision.verdict, Verdict::missing_effect);
  EXPECT_EQ(named(found), Names{"muscle_leak"});
  EXPECT_LT(found.chosen().left(), 0.4);  // counts; rounding alone leaves 0.29
}

// Beside a leak an effect that the data do not have is of no size; without it the rest stands.
TEST(Identify, AnEffectOfNoSizeIsSeenAsOne) {
  const Study study(diagnose::small(leaky()), {.threads = 2});
  const Dictionary& dictionary = study.dictionary;
  const auto begun = [&](std::string_view name, double size) {
    const auto entry = std::ranges::find(dictionary.entries, name, &Entry::name);
    return dictionary.clipped({static_cast<std::size_t>(entry - dictionary.entries.begin()), size,
                               entry->begin.empty() ? std::vector<double>{} : entry->begin.front()});
  };
  const Error error(study.rows, study.simulator.wander(dictionary.setting(dictionary.described())));
  Model model(study.problem,
              dictionary.nominal().with(begun("muscle_leak", 0.5)).with(begun("friction_warm_up", 0.1)),
              error);
  model.look();
  model.settle({});
  model.evidence();
  const auto places = model.may_be_nothing();
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(dictionary.entries[model.point.effects[places.front()].entry].name, "friction_warm_up");
}

TEST(Identify, NamesNothingWhereNothingIsMissing) {
  const Identified found = identify(diagnose::small({}), {.threads = 2});
  EXPECT_EQ(found.decision.verdict, Verdict::nothing_missing);
  EXPECT_TRUE(named(found).empty());
}

// Radius, braid angle and end correction are a curved valley, in which slopes cancel.
TEST(Descent, EndsInOnePlaceWhereverItBegins) {
  plant::Rig truth;
  truth.muscle.rest_radius_m *= 0.99;
  truth.muscle.braid_angle_rad *= 0.985;
  truth.muscle.end_correction *= 1.01;
  domain::Dataset data = diagnose::small(truth, 4.0);
  data.rig = plant::Rig{};
  const Study study(std::move(data), {.threads = 2});
  const Error error(study.rows,
                    study.simulator.wander(study.dictionary.setting(study.dictionary.described())));
  std::vector<double> ends;
  for (const double sign : {0.0, 1.0, -1.0}) {
    Point point = study.dictionary.nominal();
    for (Eigen::Index j = 0; j < point.z.size(); ++j) point.z[j] = j % 2 == 0 ? sign : -sign;
    Model model(study.problem, std::move(point), error);
    model.look();
    model.settle({});
    ends.push_back(model.evidence());
    const auto radius =
        std::ranges::find(study.dictionary.parameters, "muscle.rest_radius", &Dictionary::Free::path) -
        study.dictionary.parameters.begin();
    const double off =
        truth.muscle.rest_radius_m - study.dictionary.setting(model.point).rig.muscle.rest_radius_m;
    EXPECT_LT(std::abs(off) / study.dictionary.parameters[static_cast<std::size_t>(radius)].scale,
              3.0 * std::sqrt(model.covariance(radius, radius)));
  }
  EXPECT_LT(std::ranges::max(ends) - std::ranges::min(ends), 0.5);
}

// A regulator drifts where it is asked for less than nothing, too; a command that wanders would not show
// there.
TEST(Simulator, WanderIsFeltBelowTheZeroOfTheCommand) {
  controllers::SineCurrent sine;
  sine.low_mA = 3.0;
  sine.period_s = 2.5;
  const Study study(diagnose::planted({}, {11.138}, {{"sine", 5.0, sine}}, 7), {.threads = 2});
  const auto& current_mA = study.rows.data().runs.front().current_mA;
  const auto below = std::ranges::min_element(current_mA) - current_mA.begin();
  const Wander wander = study.simulator.wander(study.dictionary.setting(study.dictionary.described()));
  EXPECT_GT(wander.together[below], 0.5 * wander.together.maxCoeff());
}

Dictionary::Free free_of(const domain::Dataset& data, const std::string& path) {
  const auto all = Dictionary(data, 0.0).parameters;
  return *std::ranges::find(all, path, &Dictionary::Free::path);
}

// Threads that stick exactly are bristles far stiffer than described. They were called guide friction with
// backlash.
TEST(Descent, FindsThreadsThatStickWithoutAnEffect) {
  plant::Rig truth;
  truth.friction.memory = plant::FrictionMemory::coulomb;
  const Study study(diagnose::small(truth), {.threads = 2});
  const Error error(study.rows,
                    study.simulator.wander(study.dictionary.setting(study.dictionary.described())));
  Model model(study.problem, study.dictionary.nominal(), error);
  model.look();
  EXPECT_GT(model.left(), 1.5);  // counts
  model.settle({});
  EXPECT_LT(model.left(), 0.8);
  EXPECT_GT(study.dictionary.setting(model.point).rig.friction.bristle_stiffness_N_per_m, 3e6);
}

TEST(Dictionary, WhatIsKnownToAFactorStaysWithinFourOfThem) {
  domain::Dataset data;
  data.runs.emplace_back().read("contraction", {0.0, 0.1});
  const std::string path = "friction.bristle_stiffness";
  const auto usual = free_of(data, path);
  EXPECT_NEAR(usual.highest / usual.origin, std::exp(4.0), 1e-9);
  EXPECT_NEAR(usual.origin / usual.lowest, std::exp(4.0), 1e-9);
  data.rig.spreads = {{path, 1e4}};  // somebody has measured it
  EXPECT_EQ(free_of(data, path).scale, 1e4);
  data.rig.friction.memory = plant::FrictionMemory::coulomb;  // which has none
  const auto fitted = [&] {
    return std::ranges::count(Dictionary(data, 0.0).parameters, path, &Dictionary::Free::path);
  };
  EXPECT_EQ(fitted(), 0);
  data.rig = {};
  EXPECT_EQ(fitted(), 1);
  data.recorded.start = domain::Start::moving;
  EXPECT_EQ(fitted(), 0);
  data.recorded.start = domain::Start::settled;
  data.runs.front().measured.emplace().point_s = 5.0;  // threads rest at each
  EXPECT_EQ(fitted(), 0);
}

// Rounding moves a reading by a step at most; further off its zero is wrong, which is a fault to be named.
TEST(Dictionary, WhatIsWrittenCoarselyIsOffByAStepAtMost) {
  domain::Dataset data;
  data.runs.emplace_back().read("contraction", {0.0, 0.1});
  data.runs.back().load_kg = 3.0;
  const Dictionary dictionary(data, 2e-3);
  const auto zero = std::ranges::find(dictionary.parameters, "bench.zero", &Dictionary::Free::path);
  ASSERT_NE(zero, dictionary.parameters.end());
  EXPECT_EQ(zero->highest, 2e-3);
  EXPECT_EQ(zero->lowest, -2e-3);
}

// What could pull upwards, a cord softer than any, a link lighter in its turning than its mass allows.
TEST(Dictionary, NumbersGoAsFarAsAFileIsReadWithTheData) {
  domain::Dataset data;
  for (const double load_kg : {3.0, 0.1}) {
    data.runs.emplace_back().load_kg = load_kg;
    data.runs.back().read("contraction", {0.0, 0.1});
  }
  data.rig.spreads = {{"joint.load_offset", 0.5}, {"muscle.cord.stiffness", 1e4}};
  data.rig.muscle.cord.stiffness_N_per_m = 2e4;
  EXPECT_NEAR(free_of(data, "joint.load_offset").lowest, -0.1, 1e-9);
  EXPECT_TRUE(data.rig.can_hang(0.1 + free_of(data, "joint.load_offset").lowest));
  EXPECT_EQ(free_of(data, "joint.load_offset").highest, 5.0);
  EXPECT_NEAR(free_of(data, "muscle.cord.stiffness").lowest, 1e3, 1e-6);
  EXPECT_EQ(free_of(data, "muscle.rest_radius").lowest, 5e-4);

  data.rig.mechanics = plant::Lever{};
  for (domain::Run& run : data.runs) run.readings.clear(), run.read("angle", {0.0, 1.0});
  EXPECT_NEAR(free_of(data, "joint.load_offset").lowest, -0.1, 1e-9);
  data.rig.spreads = {{"mechanics.inertia", 0.01}};
  EXPECT_NEAR(free_of(data, "mechanics.inertia").lowest, 1.0 * 0.15 * 0.15, 1e-9);
}

/// The rig's parameters fitted to two runs of four seconds, without a search for more.
Estimates recalibrated(const plant::Rig& truth, const plant::Rig& nominal, double load_kg) {
  auto currents = diagnose::three_kinds();
  currents.pop_back();
  for (auto& current : currents) current.duration_s = 4.0;
  const Study study(diagnose::planted(truth, {load_kg}, currents, 7, nominal), {.threads = 2});
  const Error error(study.rows,
                    study.simulator.wander(study.dictionary.setting(study.dictionary.described())));
  Model model(study.problem, study.dictionary.nominal(), error);
  model.look();
  model.settle({});
  EXPECT_TRUE(std::isfinite(model.evidence()));
  return estimates_of(model);
}

diagnose::FittedNumber fitted(const Estimates& all, const std::string& path) {
  for (const diagnose::Moved& moved : all.moved)
    if (moved.fitted.name == path) return moved.fitted;
  return {};
}

TEST(Estimates, FindACordThatIsSofterThanWasSaid) {
  plant::Rig truth;
  truth.muscle.cord.stiffness_N_per_m = 15000.0;
  plant::Rig nominal = truth;
  nominal.muscle.cord.stiffness_N_per_m = 20000.0;
  nominal.spreads = {{"muscle.cord.stiffness", 1e4}};
  const Estimates found = recalibrated(truth, nominal, 16.138);
  const diagnose::FittedNumber stiffness = fitted(found, "muscle.cord.stiffness");
  EXPECT_TRUE(stiffness.determined);
  EXPECT_NEAR(stiffness.value, 15000.0, 300.0);
  EXPECT_LT(stiffness.low, 15000.0);
  EXPECT_GT(stiffness.high, 15000.0);
  EXPECT_EQ(found.rig.muscle.cord.stiffness_N_per_m, stiffness.value);
  EXPECT_LT(found.rig.spreads.at("muscle.cord.stiffness"), 1e3);
}

TEST(Estimates, LeaveTheFilesDeviationOfWhatTheRunsDoNotTell) {
  plant::Rig nominal;
  nominal.spreads = {{"valve.critical_ratio", 1.2345e-6}, {"muscle.rest_radius", 1e-4}};
  const Estimates found = recalibrated({}, nominal, 16.138);
  EXPECT_FALSE(fitted(found, "valve.critical_ratio").determined);
  EXPECT_EQ(found.rig.spreads.at("valve.critical_ratio"), 1.2345e-6);
  EXPECT_LT(found.rig.spreads.at("muscle.rest_radius"), 5e-5);
}

// Loads of 0.1 kg stand for nothing that hangs.
TEST(Estimates, IntervalsEndWhereALoadWouldPullUpwards) {
  plant::Rig truth;
  truth.joint.load_offset_kg = -0.1;
  plant::Rig nominal;
  nominal.spreads = {{"joint.load_offset", 0.5}};
  const diagnose::FittedNumber offset = fitted(recalibrated(truth, nominal, 0.1), "joint.load_offset");
  EXPECT_NEAR(offset.low, -0.1, 1e-9);
  EXPECT_GE(0.1 + offset.low, 0.0);
  EXPECT_GE(0.1 + offset.value, 0.0);
  EXPECT_NEAR(offset.value, -0.1, 0.01);
  EXPECT_GT(offset.high, -0.1);
}

TEST(Simulator, ASettingThatCannotGoOnLeavesTheOthers) {
  const Study study(diagnose::small({}, 1.0), {.threads = 2});
  std::vector<Setting> settings(3, study.dictionary.setting(study.dictionary.described()));
  settings[1].bench.load_offset_kg = 1e6;
  const Eigen::MatrixXd seen = study.simulator.differences(settings);
  EXPECT_TRUE(seen.col(0).allFinite());
  EXPECT_FALSE(seen.col(1).allFinite());
  EXPECT_TRUE(seen.col(2).allFinite());
}

TEST(Identify, DoesNotDependOnThreads) {
  const domain::Dataset data = diagnose::small(leaky(), 2.0);
  const Identified one = identify(data, {.threads = 1}), two = identify(data, {.threads = 2});
  ASSERT_EQ(one.table.size(), two.table.size());
  for (std::size_t i = 0; i < one.table.size(); ++i) EXPECT_EQ(one.table[i].score, two.table[i].score);
  EXPECT_EQ(one.passes, two.passes);
}

}  // namespace
}  // namespace mckibben::identify
