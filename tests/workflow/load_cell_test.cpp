// A whole diagnosis of a hanging load with a load cell on its cord.
#include "diagnose/load_cell.hpp"

#include <gtest/gtest.h>

#include "diagnose/planted.hpp"
#include "named.hpp"

namespace mckibben::diagnose {
namespace {

TEST(LoadCellDiagnosis, TellsTheGuidesFrictionFromTheThreads) {
  plant::Rig truth;
  truth.effects.get<plant::GuideFriction>().coefficient = 0.03;
  const Diagnosis found = diagnosis_of(data::with_rows(with_a_cell(truth)), 2);
  ASSERT_TRUE(names_only(found, "guide_friction"));
  EXPECT_TRUE(surrounds(found.effects[0].parameters.at(0), 0.03));
  ASSERT_EQ(found.gap.beside.size(), 1u);
  const BesideGap& force = found.gap.beside[0];
  EXPECT_EQ(force.reading, "force");
  EXPECT_GT(force.nominal_rmse, 1.3 * force.noise_floor);
  EXPECT_LT(force.corrected_rmse, 1.2 * force.noise_floor);
}

}  // namespace
}  // namespace mckibben::diagnose
