// Small data sets whose answer is known, from their readings to the verdict.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

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
