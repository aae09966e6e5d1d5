// The next measurement: the one of a menu that most probably ends a doubt, if any may.
#include <cmath>
#include <mutex>
#include <set>
#include <variant>

#include <gtest/gtest.h>

#include <sim/diagnose/plan.hpp>

#include "joint.hpp"
#include "planted.hpp"
#include "says.hpp"

namespace mckibben::diagnose {
namespace {

/// Plans on a data set of one load so heavy that it leaves two loads of seven currents each.
std::optional<NextExperiment> next(const Power& power) {
  const domain::Dataset data = planted({}, {85.0}, {three_kinds()[0]}, 1);
  plant::Rig rougher = data.rig;
  rougher.friction.scale = 1.2;
  return plan(data, 2, data.rig, rougher, {"a", "b"}, power);
}

TEST(Plan, TakesTheMeasurementOfTheHighestPower) {
  const auto found = next([](const domain::Run& run) { return run.load_kg < 50.0 ? 0.6 : 0.4; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->expected_power, 0.6);
  EXPECT_EQ(found->load_kg, 42.5);  // half of what was hung; 1.3 times it would not be lifted
  EXPECT_EQ(found->separates, (std::vector<std::string>{"a", "b"}));
  EXPECT_FALSE(found->current.empty());
  EXPECT_TRUE(std::visit([&](const auto& waveform) { return std::string(waveform.kind) == found->waveform; },
                         found->measurement.current.value()));
  EXPECT_DOUBLE_EQ(found->measurement.duration_s, 10.0);
}

TEST(Plan, ALeverLiftsWhatItsArmLetsItsMuscleLift) {
  plant::Rig rig;
  rig.mechanics = plant::Lever{};
  rig.joint.lowest_rad = 0.0, rig.joint.highest_rad = 100.0 * plant::degree_rad;
  const domain::Dataset data = planted(rig, {12.0}, {three_kinds()[0]}, 1, rig);
  ASSERT_FALSE(data.runs[0].judged().values.empty());
  plant::Rig rougher = data.rig;
  rougher.friction.scale = 1.2;
  std::mutex one_by_one;
  std::set<double> loads_kg;
  const auto found = plan(data, 2, data.rig, rougher, {"a", "b"}, [&](const domain::Run& run) {
    const std::scoped_lock lock(one_by_one);
    loads_kg.insert(run.load_kg);
    return 0.5;
  });
  ASSERT_TRUE(found);
  EXPECT_EQ(loads_kg, (std::set{6.0, 12.0}));  // 15.6 kg pull like 110 kg at the cord
}

/// What a run of a pair commands a muscle with.
const std::vector<double>& command(const domain::Run& run, std::size_t muscle) {
  return run.measured->given("command", muscle);
}

TEST(Plan, CommandsBothMusclesOfAPairTogetherAndAgainstEachOther) {
  domain::Dataset data = of_a_joint(plant::thesis_pair(), true);
  data.runs.resize(1);
  const plant::Rig leaks = pair_with(plant::MuscleLeak{.conductance_m3_per_s_Pa = 3e-10}, Side::two);
  std::mutex one_by_one;
  std::size_t together = 0, against = 0;
  const auto propose = [&] {
    return plan(data, 2, data.rig, leaks, {"a", "b"}, [&](const domain::Run& run) {
      const auto &one = command(run, 1), &two = command(run, 2);
      bool alike = true, opposed = true;
      for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_TRUE(one[k] > 7.0 && one[k] < 17.0 && two[k] > 7.0 && two[k] < 17.0);
        alike = alike && one[k] == two[k];
        opposed = opposed && std::abs(one[k] + two[k] - 24.0) < 0.02;  // a step of the DAC
      }
      EXPECT_NE(alike, opposed);
      const std::scoped_lock lock(one_by_one);
      ++(alike ? together : against);
      return alike ? 0.3 : 0.6;
    });
  };
  const auto found = propose();
  ASSERT_TRUE(found);
  EXPECT_GT(against, 0U);
  EXPECT_EQ(together + against, thresholds.plan.refitted);
  EXPECT_EQ(found->expected_power, 0.6);
  EXPECT_EQ(found->load_kg, 0.0);
  EXPECT_TRUE(holds(found->current, "muscle 1: ", "; muscle 2: 24 mA minus the same"));
  EXPECT_FALSE(found->measurement.current);
  ASSERT_TRUE(found->measurement.current_1 && found->measurement.current_2);

  // Once measured it is not proposed again.
  domain::Campaign campaign;
  campaign.rig = data.rig;
  campaign.currents = {found->measurement};
  const run::CampaignRun made = run::run_job(campaign, run::jobs_of(campaign).front());
  domain::Measurement& measured = data.runs.front().measured.emplace();
  for (const run::Sample& sample : made.recording.samples) {
    measured.time_s.push_back(sample.time_s);
    measured.give("command", 1).push_back(sample.current_mA);
    measured.give("command", 2).push_back(sample.opposite.current_mA);
  }
  const auto next = propose();
  ASSERT_TRUE(next);
  EXPECT_NE(next->current, found->current);
}

TEST(Plan, ProposesNothingThatWasMeasured) {
  domain::Dataset data = planted({}, {85.0}, {three_kinds()[0]}, 1);
  plant::Rig rougher = data.rig;
  rougher.friction.scale = 1.2;
  std::set<std::string> proposed;
  const auto heavy = [](const domain::Run& run) { return run.load_kg > 60.0 ? 0.6 : 0.0; };
  while (const auto found = plan(data, 2, data.rig, rougher, {"a", "b"}, heavy)) {
    ASSERT_TRUE(proposed.insert(found->current).second) << found->current;
    domain::Run made = planted({}, {0.98 * found->load_kg}, {found->measurement}, 2).runs.front();
    made.current_mA.insert(made.current_mA.begin(), 40, made.current_mA.front());  // recorded before it began
    data.runs.push_back(std::move(made));
  }
  EXPECT_GE(proposed.size(), 4U);
}

TEST(Plan, PromisesNothingBelowATenth) {
  EXPECT_FALSE(next([](const domain::Run&) { return 0.09; }));
}

}  // namespace
}  // namespace mckibben::diagnose
