// A whole diagnosis of a rig with a regulator whose data sheet is off.
#include <gtest/gtest.h>

#include "diagnose/planted.hpp"

namespace mckibben::diagnose {
namespace {

TEST(RegulatorDiagnosis, RecalibratesALagThatIsNotThatOfTheDataSheet) {
  plant::Rig sheet;
  sheet.valve.kind = plant::ValveKind::regulator;
  sheet.valve.time_constant_s = 0.1;
  plant::Rig truth = sheet;
  truth.valve.time_constant_s = 0.14;
  auto data = small(truth, 3.0);
  data.rig = sheet;
  const auto found = diagnosis_of(data, 0);
  EXPECT_EQ(found.verdict, Verdict::recalibrate) << found.because;
  EXPECT_TRUE(found.effects.empty()) << found.because;
  EXPECT_NEAR(found.corrected.valve.time_constant_s, 0.14, 2e-3);
  EXPECT_NE(found.because.find("valve.time_constant from 0.1 to"), std::string::npos) << found.because;
  EXPECT_GT(found.gap.closed, 0.95);
}

}  // namespace
}  // namespace mckibben::diagnose
