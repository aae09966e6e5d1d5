// The filter on commands: against the closed form of its step response, through the one door of all
// controllers.
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>

namespace mckibben::controllers {
namespace {

using Complex = std::complex<double>;
constexpr double sampling_s = 0.01;

/// Commands 10 until a tick, and then `to`.
class Jump final : public Controller {
 public:
  explicit Jump(double to_mA) : to_mA_(to_mA) {}
  Command rest() override { return {10.0, 6.0}; }
  Command step(const Reading& reading) override {
    return reading.tick < 3 ? Command{10.0, 6.0} : Command{to_mA_, 7.0};
  }

 private:
  double to_mA_;
};

/// Residues of H(z) z^k/(z - 1), with s = (z - 1)/(z + 1)/tan(pi f T) in 1/(s^2 + 2 d s + 1).
double step_response(const CommandFilter& filter, int k) {
  const double w = std::tan(std::numbers::pi * filter.frequency_Hz * sampling_s), d = filter.damping;
  const Complex s(-d, std::sqrt(1.0 - d * d)), p = (1.0 + w * s) / (1.0 - w * s);
  const Complex slope = 2.0 / (w * (p + 1.0) * (p + 1.0));
  const double low_pass = 1.0 + 2.0 * (std::pow(p, k) / ((p - 1.0) * slope * (s - std::conj(s)))).real();
  if (filter.kind == FilterKind::low_pass) return low_pass;
  // s^2 + 1 in the numerator: its value at the pole.
  return 1.0 + 2.0 * ((s * s + 1.0) * std::pow(p, k) / ((p - 1.0) * slope * (s - std::conj(s)))).real();
}

TEST(CommandFilter, StepResponseIsTheClosedFormAndBeginsAtRest) {
  for (const CommandFilter& filter :
       {CommandFilter{FilterKind::low_pass, 5.0, 0.7071}, CommandFilter{FilterKind::low_pass, 30.0, 0.3},
        CommandFilter{FilterKind::notch, 3.0, 0.5}}) {
    const auto controller = filtered(filter, std::nullopt, sampling_s, std::make_unique<Jump>(12.0));
    EXPECT_EQ(controller->rest().current_mA, 10.0);
    for (int k = 0; k < 60; ++k) {
      const Command command = controller->step({k, k * sampling_s, 0});
      const double rise = k < 3 ? 0.0 : step_response(filter, k - 3);
      EXPECT_NEAR(command.current_mA, 10.0 + 2.0 * rise, 1e-9) << k;
      EXPECT_NEAR(command.opposite_mA, 6.0 + rise, 1e-9) << k;
    }
  }
}

TEST(CommandFilter, CommandsStayWithinTheLimits) {
  const CommandFilter lively{FilterKind::low_pass, 5.0, 0.1};
  const auto most = [&](const std::optional<CurrentRange>& limits) {
    const auto controller = filtered(lively, limits, sampling_s, std::make_unique<Jump>(19.0));
    controller->rest();
    double highest_mA = 0.0;
    for (int k = 0; k < 100; ++k)
      highest_mA = std::max(highest_mA, controller->step({k, k * sampling_s, 0}).current_mA);
    return highest_mA;
  };
  EXPECT_GT(most(std::nullopt), 24.0);
  EXPECT_EQ(most(CurrentRange{4.0, 20.0}), 20.0);
}

/// What `make` makes of settings is filtered, and nothing else of it changes.
TEST(CommandFilter, IsOfEveryControllerThatIsMade) {
  Knowledge known;
  known.contraction_per_count = 1e-4;
  known.tick_s = sampling_s;
  known.largest_current_mA = 20.0;
  known.valve = {4.0, 20.0, 0.0, 5e5};
  known.target = {0.1, 0.1, 0.2};
  PidSettings pid;
  pid.proportional_mA = 20.0, pid.integral_time_s = 0.3, pid.derivative_time_s = 0.0;
  PidSettings with = pid;
  with.command_filter = CommandFilter{FilterKind::low_pass, 5.0, 0.7071};
  const auto plain = make(pid, known), smooth = make(with, known);
  ASSERT_EQ(plain->rest().current_mA, smooth->rest().current_mA);
  double jump_mA = 0.0, smooth_jump_mA = 0.0;
  for (int k = 0; k < 3; ++k) {
    jump_mA = plain->step({k, k * sampling_s, 0}).current_mA;
    smooth_jump_mA = smooth->step({k, k * sampling_s, 0}).current_mA;
  }
  EXPECT_GT(jump_mA - 4.0, 1.9);
  EXPECT_GT(smooth_jump_mA - 4.0, 0.0);
  EXPECT_LT(smooth_jump_mA - 4.0, 0.1 * (jump_mA - 4.0));
}

/// All controllers, but commands that are given as they are to be.
TEST(CommandFilter, EveryKindHasTheKeyButGivenCommands) {
  [&]<class... One>(std::variant<One...>*) {
    const auto look = []<class Settings>(const Settings&) {
      EXPECT_NE((std::derived_from<Settings, CommandTerms>), Settings::kind.ends_with("_current"))
          << Settings::kind;
    };
    (look(One{}), ...);
  }(static_cast<Settings*>(nullptr));
}

}  // namespace
}  // namespace mckibben::controllers
