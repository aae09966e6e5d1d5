// A whole diagnosis of forces that were read on a bench.
#include "diagnose/bench.hpp"

#include <array>

#include <gtest/gtest.h>

#include "diagnose/planted.hpp"
#include "named.hpp"

namespace mckibben::diagnose {
namespace {

TEST(BenchDiagnosis, NamesTheTubeThatPullsBack) {
  plant::Rig truth;
  auto& tube = truth.effects.get<plant::BladderElasticity>();
  tube.variant = plant::BladderLaw::saturating;
  tube.force_N = 60.0;
  tube.ratio = 0.05;
  const Diagnosis found = diagnosis_of(on_a_bench(truth, 0.5), 2);
  ASSERT_TRUE(names_only(found, "bladder_elasticity"));
  EXPECT_EQ(found.effects[0].variant, "saturating");
  const FittedNumber& force = found.effects[0].parameters.at(0);
  EXPECT_TRUE(surrounds(force, 60.0));
  EXPECT_EQ(found.gap.judged, Judged::force);
  EXPECT_GT(found.gap.nominal_rmse, 30.0);  // N
  EXPECT_LT(found.gap.corrected_rmse, 2.0 * found.gap.noise_floor);
  EXPECT_NE(found.because.find("the cord's force falls from"), std::string::npos) << found.because;
}

// Ends that pull more or less at each length look like gains of runs.
TEST(BenchDiagnosis, FindsNoFaultOfARunWhereEachHasALengthOfItsOwn) {
  domain::Dataset data = on_a_bench({}, 0.5);
  const std::array more{0.10, -0.045, -0.04, 0.03, 0.07};
  for (std::size_t i = 0; i < more.size(); ++i)
    for (double& force_N : data.runs[i].judged().values) force_N *= 1.0 + more[i];
  const Diagnosis found = diagnosis_of(data, 2);
  for (const BenchFault& fault : found.bench) ADD_FAILURE() << fault.words;
}

TEST(BenchDiagnosis, NamesNothingWhereNothingIsMissing) {
  const Diagnosis found = diagnosis_of(on_a_bench({}, 0.5), 2);
  EXPECT_TRUE(found.effects.empty()) << found.because;
  EXPECT_TRUE(found.residual_law.empty()) << found.because;
  EXPECT_NE(found.verdict, Verdict::recalibrate) << found.because;
}

}  // namespace
}  // namespace mckibben::diagnose
