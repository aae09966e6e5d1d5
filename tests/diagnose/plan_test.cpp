// The next measurement: the one of a menu that most probably ends a doubt, if any may.
#include <mutex>
#include <set>
#include <variant>

#include <gtest/gtest.h>

#include <sim/diagnose/plan.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Plans on a data set of one load so heavy that it leaves two loads of seven currents each.
std::optional<NextExperiment> next(const Power& power) {
  const domain::Dataset data = planted({}, {85.0}, {three_kinds()[0]}, 1);
  Rig rougher = data.rig;
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
  ASSERT_FALSE(data.runs[0].angle_rad.empty());
  Rig rougher = data.rig;
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

TEST(Plan, ProposesNothingThatWasMeasured) {
  domain::Dataset data = planted({}, {85.0}, {three_kinds()[0]}, 1);
  Rig rougher = data.rig;
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
