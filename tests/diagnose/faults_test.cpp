// Runs whose recording is at fault, each kind alone: found in its run, with its size;
// and sound runs left alone.
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

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

TEST(Faults, CurrentThatTheValveDidNotHave) {
  auto scaled = undisturbed(), moved = undisturbed();
  for (double& current_mA : scaled.runs[4].current_mA) current_mA *= 1.05;
  for (double& current_mA : moved.runs[0].current_mA) current_mA += 0.4;
  expect_one(scaled, FaultKind::current_scale, 4, 0.05, 0.005);
  expect_one(moved, FaultKind::current_offset, 0, 0.4, 0.05);
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

}  // namespace
}  // namespace mckibben::diagnose
