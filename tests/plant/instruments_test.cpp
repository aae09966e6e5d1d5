// DAC, encoder and gauge; the crosswise counters with what they do wrong.
#include <gtest/gtest.h>

#include <plant/instruments.hpp>

namespace mckibben::plant {
namespace {

TEST(Dac, RoundsToTheNearestStepAndReachesItsTop) {
  const Dac dac;
  EXPECT_DOUBLE_EQ(dac_output_mA(dac, 20.0), 20.0);
  EXPECT_DOUBLE_EQ(dac_output_mA(dac, 30.0), 20.0);
  EXPECT_DOUBLE_EQ(dac_output_mA(dac, -1.0), 0.0);
  EXPECT_DOUBLE_EQ(dac_output_mA(dac, 4.0), 819.0 * 20.0 / 4096.0);  // 3.999...: 4 mA is not on the grid
}

TEST(Encoder, CountsAQuarterDegree) {
  EXPECT_NEAR(count_height_m(Rig{}), 0.1309e-3, 1e-8);
  EXPECT_NEAR(count_height_m(Rig{}) / 0.3, 4.363e-4, 1e-7);
}

TEST(Encoder, IdealWiringCountsTheFloor) {
  PulseCounter counter(EncoderWiring::ideal, 1.0);
  EXPECT_EQ(counter.count(2.999), 2);
  EXPECT_EQ(counter.count(-0.001), -1);
  EXPECT_EQ(counter.count(0.0), 0);
}

TEST(Encoder, CrosswiseWiringHasAQuarterCountOfPlay) {
  PulseCounter counter(EncoderWiring::crosswise, 1.0);
  EXPECT_EQ(counter.count(3.3), 4);  // edges at 0.25, 1.25, 2.25, 3.25
  EXPECT_EQ(counter.count(3.0), 4);  // back over 3.25 and not yet over 2.5: the play
  EXPECT_EQ(counter.count(2.4), 3);  // over 2.5
  EXPECT_EQ(counter.count(0.0), 1);  // 1.5 and 0.5; the count does not come back to zero
}

TEST(Encoder, CrosswiseWiringCountsATrembleUpAndUp) {
  PulseCounter counter(EncoderWiring::crosswise, 1.0);
  for (int i = 0; i < 10; ++i) {
    counter.count(0.3);
    counter.count(0.2);
  }
  EXPECT_EQ(counter.count(0.2), 10);  // ten crossings of one edge, never counted down
}

TEST(Gauge, ShowsStepsOfItsResolution) {
  const Sensor stepped = gauge(100.0), smooth = gauge();
  EXPECT_DOUBLE_EQ(shown(&stepped, 12344.0), 12300.0);
  EXPECT_DOUBLE_EQ(shown(&smooth, 12344.0), 12344.0);
}

}  // namespace
}  // namespace mckibben::plant
