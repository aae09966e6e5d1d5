// Faults of the recording, of one run and of all at once, told from effects.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/data/judged.hpp>
#include <sim/run/simulate.hpp>

#include "diagnose/planted.hpp"
#include "named.hpp"
#include "says.hpp"

namespace mckibben::diagnose {
namespace {

/// Its readings come so many rows later, from a row on.
void delay(domain::Run& run, std::size_t ticks) {
  auto& ratios = run.judged().values;
  for (std::size_t k = ratios.size(); k-- > ticks;) ratios[k] = ratios[k - ticks];
}
/// Its readings come so many rows earlier.
void hasten(domain::Run& run, std::size_t ticks) {
  auto& ratios = run.judged().values;
  for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] = ratios[std::min(k + ticks, ratios.size() - 1)];
}

TEST(Faults, ARunThatIsLateIsSaidInTheVerdictAndShifted) {
  auto data = small(plant::Rig{});
  delay(data.runs[1], 3);
  const auto found = diagnosis_of(data, 0);
  EXPECT_TRUE(found.because.starts_with("The readings of run r02 come 36")) << found.because;
  EXPECT_TRUE(holds(found.because, "ms late", "Apart from that"));
  EXPECT_EQ(found.verdict, Verdict::nothing_missing);
  EXPECT_TRUE(found.effects.empty());
  ASSERT_EQ(found.bench.size(), 1u);
  EXPECT_EQ(found.bench[0].name, "delays_differ");
  EXPECT_EQ(found.bench[0].runs, std::vector<std::string>{"r02"});
  EXPECT_TRUE(surrounds(found.bench[0].size, 0.036));
  EXPECT_TRUE(found.bench[0].write.starts_with(
      "columns: {contraction: {column: contraction_ratio, unit: 1, late: 36"))
      << found.bench[0].write;
  EXPECT_LT(found.runs[1].corrected_rmse, 2.0 * found.gap.noise_floor);
}

TEST(NightlyFaults, ARunThatIsLateIsFoundBesideAnEffectThatIsMissing) {
  plant::Rig truth;
  truth.effects.get<plant::SpeedDependentFriction>().ratio = 0.4;
  auto data = small(truth);
  delay(data.runs[1], 3);
  const auto found = diagnosis_of(data, 0);
  EXPECT_TRUE(found.because.starts_with("The readings of run r02 come 36")) << found.because;
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "speed_dependent_friction");
}

TEST(NightlyFaults, AllRunsThatAreEarlyAreFoundBesideAnEffectThatIsMissing) {
  plant::Rig truth;
  truth.effects.get<plant::SpeedDependentFriction>().ratio = 0.8;
  auto data = small(truth);
  for (domain::Run& run : data.runs) hasten(run, 3);
  const auto found = diagnosis_of(data, 0);
  EXPECT_TRUE(holds(found.because, "The clock of the readings is 36", "ahead of that of the input"));
  ASSERT_EQ(found.effects.size(), 1u) << found.because;
  EXPECT_EQ(found.effects[0].name, "speed_dependent_friction");
}

TEST(Faults, AClockThatRunsSlowIsSaidWithTheLineToWrite) {
  auto data = small(plant::Rig{});
  for (domain::Run& run : data.runs) {
    const auto read = run.judged().values;
    for (std::size_t k = 0; k < read.size(); ++k)
      run.judged().values[k] =
          read[std::min(static_cast<std::size_t>(1.02 * static_cast<double>(k)), read.size() - 1)];
  }
  const auto found = diagnosis_of(data, 0);
  ASSERT_EQ(found.bench.size(), 1u) << found.because;
  EXPECT_TRUE(
      found.bench[0].write.starts_with("columns: {contraction: {column: contraction_ratio, unit: 1, "
                                       "time: FILL_IN}}, FILL_IN a column of the stamps times 1.0"))
      << found.bench[0].write;
}

TEST(Faults, ADriftThatAllRunsHaveIsNoEffect) {
  auto data = small(plant::Rig{});
  const double count = run::contraction_per_count(data.rig);
  for (domain::Run& run : data.runs)
    for (std::size_t k = 0; k < run.rows(); ++k)
      run.judged().values[k] += count * std::floor(static_cast<double>(k) / 40.0);
  const auto found = diagnosis_of(data, 0);
  EXPECT_TRUE(found.effects.empty());
  ASSERT_EQ(found.bench.size(), 1u) << found.because;
  EXPECT_EQ(found.bench[0].runs.size(), 6u);
  EXPECT_TRUE(holds(found.because, "The readings of every run drift by"));
}

}  // namespace
}  // namespace mckibben::diagnose
