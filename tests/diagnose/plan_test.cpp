// The next experiment: it separates what can be separated, and does not promise what it cannot.
#include <variant>

#include <gtest/gtest.h>

#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/priors.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Plans on a data set of one load so heavy that it leaves two loads of seven currents each. Nothing is free
/// in the rigs unless it is said.
class Plan : public testing::Test {
 protected:
  Fitted fitted(const plant::Rig& rig, std::vector<Parameter> free = {}) const {
    Fitted fit;
    fit.model.rig = rig;
    fit.model.free = std::move(free);
    fit.columns = experiment().slopes(fit.model.rig, fit.model.free, {0}).columns;
    fit.cost = static_cast<double>(fit.columns.rows()) / inflation_;
    return fit;
  }
  Experiment experiment() const {
    return {data_, {std::vector<bool>(data_.runs[0].current_mA.size(), false)}, 2};
  }
  std::optional<NextExperiment> next(const Fitted& one, const Fitted& other) const {
    return plan(experiment(), one, other, {"a", "b"}, inflation_, 1.5);
  }

  double inflation_ = 20.0;
  domain::Dataset data_ = planted({}, {85.0}, {three_kinds()[0]}, 1);
};

TEST_F(Plan, FindsWhatSeparatesDeadBandFromHysteresis) {
  plant::Rig band, play;
  band.effects.get<plant::ValveDeadBand>().half_width_Pa = 8e3;
  play.effects.get<plant::ValveHysteresis>().half_width_Pa = 8e3;
  const auto found = next(fitted(band), fitted(play));
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
  rougher.friction.scale = 1.0005;
  EXPECT_FALSE(next(fitted({}), fitted(rougher)));
}

TEST_F(Plan, PromisesNothingThatTheRivalsNumbersImitateUnlessOldReadingsKeepThem) {
  plant::Rig rougher;
  rougher.friction.scale = 1.02;  // small enough that straight slopes imitate it
  EXPECT_TRUE(next(fitted({}), fitted(rougher)));
  const auto numbers = nominal_parameters(Rig{});
  Fitted one = fitted({}, numbers), other = fitted(rougher, numbers);
  EXPECT_TRUE(next(one, other));
  one.columns.setZero();
  other.columns.setZero();
  const auto found = next(one, other);
  EXPECT_FALSE(found) << found->expected_power << ' ' << found->current;
}

}  // namespace
}  // namespace mckibben::diagnose
