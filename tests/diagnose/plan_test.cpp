// The next experiment: it separates what can be separated, and does not promise what it cannot.
#include <cmath>
#include <stdexcept>
#include <variant>

#include <gtest/gtest.h>

#include <sim/diagnose/plan.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Plans on a data set of one load so heavy that it leaves two loads of seven currents each.
class Plan : public testing::Test {
 protected:
  std::optional<NextExperiment> next(const plant::Rig& named, const plant::Rig& rival, double noise,
                                     double share) const {
    const Experiment experiment(data_, {std::vector<bool>(data_.runs[0].current_mA.size(), false)}, 2);
    return plan(experiment, named, rival, {"a", "b"}, noise, share);
  }

  domain::Dataset data_ = planted({}, {85.0}, {three_kinds()[0]}, 1);
};

TEST_F(Plan, FindsWhatSeparatesDeadBandFromHysteresis) {
  plant::Rig band, play;
  band.effects.get<plant::ValveDeadBand>().half_width_Pa = 8e3;
  play.effects.get<plant::ValveHysteresis>().half_width_Pa = 8e3;
  const auto found = next(band, play, 3e-4, 0.02);
  ASSERT_TRUE(found);
  EXPECT_GT(found->expected_power, 0.9);
  EXPECT_LE(found->expected_power, 1.0);
  EXPECT_EQ(found->separates, (std::vector<std::string>{"a", "b"}));
  EXPECT_FALSE(found->current.empty());
  EXPECT_TRUE(std::visit([&](const auto& waveform) { return std::string(waveform.kind) == found->waveform; },
                         found->measurement.current.value()));
  EXPECT_DOUBLE_EQ(found->measurement.duration_s, 10.0);
  EXPECT_TRUE(found->load_kg == 85.0 || found->load_kg == 42.5);  // 1.3 times it would not be lifted
}

TEST_F(Plan, PromisesNothingThatNoiseHides) {
  plant::Rig rougher;
  rougher.friction.scale = 1.05;
  EXPECT_FALSE(next({}, rougher, 0.1, 0.1));
}

TEST_F(Plan, AGainOfTheReadingsSeparatesNothing) {
  plant::Rig scaled;
  scaled.effects.get<plant::EncoderScale>().error = 0.02;
  EXPECT_FALSE(next({}, scaled, 3e-4, 0.1));
}

TEST_F(Plan, TheShareOfIndependentSamplesIsAShare) {
  EXPECT_THROW(next({}, {}, 3e-4, 0.0), std::invalid_argument);
  EXPECT_THROW(next({}, {}, 3e-4, 1.5), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::diagnose
