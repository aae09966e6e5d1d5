// A whole diagnosis of a hanging load with a load cell on its cord.
#include "diagnose/load_cell.hpp"

#include <gtest/gtest.h>

#include "diagnose/planted.hpp"

namespace mckibben::diagnose {
namespace {

TEST(LoadCellDiagnosis, TellsTheGuidesFrictionFromTheThreads) {
  plant::Rig truth;
  truth.effects.get<plant::GuideFriction>().coefficient = 0.03;
  const Diagnosis found = diagnosis_of(data::with_rows(with_a_cell(truth)), 2);
  EXPECT_EQ(found.verdict, Verdict::missing_effect) << found.because;
  ASSERT_EQ(found.effects.size(), 1u) << found.because;
  EXPECT_EQ(found.effects[0].name, "guide_friction");
  EXPECT_LT(found.effects[0].parameters.at(0).low, 0.03);
  EXPECT_GT(found.effects[0].parameters.at(0).high, 0.03);
  ASSERT_EQ(found.gap.beside.size(), 1u);
  const BesideGap& force = found.gap.beside[0];
  EXPECT_EQ(force.reading, "force");
  EXPECT_GT(force.nominal_rmse, 1.3 * force.noise_floor);
  EXPECT_LT(force.corrected_rmse, 1.2 * force.noise_floor);
}

}  // namespace
}  // namespace mckibben::diagnose
