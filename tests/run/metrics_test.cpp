// Metrics against closed forms: a sine shifted by a known lag, a first-order response, hand-made runs.
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <sim/run/metrics.hpp>

namespace mckibben::run {
namespace {

constexpr double tick_s = 0.012;

template <class Function>
std::vector<double> sampled(std::size_t ticks, Function function) {
  std::vector<double> values(ticks);
  for (std::size_t k = 0; k < ticks; ++k) values[k] = function(static_cast<double>(k) * tick_s);
  return values;
}

// Columns that a test fills; their view is what is measured.
struct Columns {
  std::vector<double> target, contraction;
  std::vector<double> current_mA = std::vector<double>(target.size(), 4.0);

  Followed view() const { return {target, contraction, current_mA, tick_s}; }
};

TEST(Metrics, ErrorsFollowTheirDefinitions) {
  Columns run{{0.1, 0.1, 0.1, 0.1}, {0.1, 0.13, 0.06, 0.1}, {4.0, 10.0, 8.0, 8.0}};
  run.contraction.back() = 0.08;
  Followed view = run.view();
  view.air_kg = 2e-3;
  const Metrics metrics = measure(view);
  EXPECT_NEAR(metrics.rmse, std::sqrt((9e-4 + 16e-4 + 4e-4) / 4.0), 1e-15);
  EXPECT_NEAR(metrics.mae, 0.09 / 4.0, 1e-15);
  EXPECT_NEAR(metrics.largest_error, 0.04, 1e-15);
  EXPECT_NEAR(metrics.final_error, -0.02, 1e-15);
  EXPECT_NEAR(metrics.current_travel_mA, 8.0, 1e-15);
  EXPECT_EQ(metrics.air_kg, 2e-3);
}

TEST(Metrics, CountsTheTicksAtAnEndOfTheCurrent) {
  const Columns run{{0.1, 0.1, 0.1, 0.1}, {0.1, 0.1, 0.1, 0.1}, {4.0, 10.0, 4.0, 20.0}};
  Followed view = run.view();
  EXPECT_FALSE(measure(view).at_lowest_current) << "no limits";
  view.limits = {4.0, 20.0};
  EXPECT_EQ(measure(view).at_lowest_current, 0.5);
  EXPECT_EQ(measure(view).at_highest_current, 0.25);
}

TEST(Metrics, ACurrentThatGoesToAndFroSwings) {
  const auto swings = [](auto current_mA) {
    Columns run{std::vector<double>(500, 0.1), std::vector<double>(500, 0.1), sampled(500, current_mA)};
    Followed view = run.view();
    view.limits = {4.0, 20.0};
    return measure(view).swings;
  };
  EXPECT_TRUE(swings([](double t) { return std::fmod(t, 0.4) < 0.2 ? 4.0 : 20.0; }));
  EXPECT_TRUE(swings([](double t) { return std::fmod(t, 0.4) < 0.2 ? 4.0 : 9.0; }));
  EXPECT_FALSE(swings([](double t) { return t < 3.0 ? 4.0 : 9.0; }));
  EXPECT_FALSE(swings([](double t) { return std::fmod(t, 0.4) < 0.2 ? 4.0 : 4.5; })) << "it waits at its end";
}

TEST(Metrics, ConstantTargetHasNoLagOvershootOrSettling) {
  const Columns run{{0.1, 0.1, 0.1}, {0.0, 0.2, 0.1}};
  Followed view = run.view();
  view.last_change_s = 0.0;
  const Metrics metrics = measure(view);
  EXPECT_FALSE(metrics.time_lag_s);
  EXPECT_FALSE(metrics.overshoot);
  EXPECT_FALSE(metrics.settling_time_s);
}

TEST(Metrics, RunsThatCannotBeMeasuredAreRefused) {
  EXPECT_THROW(measure(Columns{}.view()), std::invalid_argument);
  const Columns uneven{{0.1, 0.2}, {0.1}};
  EXPECT_THROW(measure(uneven.view()), std::invalid_argument);
  const Columns run{{0.1}, {0.1}};
  Followed view = run.view();
  view.tick_s = 0.0;
  EXPECT_THROW(measure(view), std::invalid_argument);
}

class LagOfASine : public testing::TestWithParam<double> {};

TEST_P(LagOfASine, IsFoundBetweenTicks) {
  const auto sine = [](double t) {
    return t < 0.5 ? 0.15 : 0.15 + 0.05 * std::sin(2.0 * std::numbers::pi * (t - 0.5) / 5.0);
  };
  const double lag_s = GetParam();
  const Columns run{sampled(1500, sine), sampled(1500, [&](double t) { return sine(t - lag_s); })};
  EXPECT_NEAR(time_lag_s(run.view()).value(), lag_s, 0.02 * tick_s);
}

INSTANTIATE_TEST_SUITE_P(Lags, LagOfASine, testing::Values(0.0, 0.012, 0.1234, 0.3, 0.777, 1.99));

TEST(Lag, DoesNotDependOnAnErrorOfTheMean) {
  const auto sine = [](double t) { return 0.15 + 0.05 * std::sin(2.0 * std::numbers::pi * t); };
  // Whole periods, so that the offset multiplies a sum that is zero.
  const Columns run{sampled(1000, sine), sampled(1000, [&](double t) { return sine(t - 0.12) + 0.001; })};
  EXPECT_NEAR(time_lag_s(run.view()).value(), 0.12, tick_s);
}

TEST(Lag, IsNeverNegativeNorBeyondItsLimit) {
  const auto ramp = [](double t) { return 0.01 * t; };
  const Columns ahead{sampled(1000, ramp), sampled(1000, [&](double t) { return ramp(t + 0.5); })};
  EXPECT_EQ(time_lag_s(ahead.view()), 0.0);
  const Columns far_behind{sampled(400, ramp),
                           sampled(400, [&](double t) { return ramp(std::max(0.0, t - 3.0)); })};
  EXPECT_FALSE(time_lag_s(far_behind.view()));  // it lies outside what is searched: not known, not the limit
}

/// Where it hardly follows, what little it moves had been told to be half a period behind.
TEST(Lag, OfAMuscleThatHardlyFollowsIsUnknown) {
  const auto lag = [](double part) {
    const auto sine = [](double t) { return std::sin(2.0 * std::numbers::pi * t / 2.5); };
    return time_lag_s(Columns{
        sampled(1000, [&](double t) { return 0.15 + 0.05 * sine(t); }), sampled(1000, [&](double t) {
          return 0.1 + 0.05 * part * sine(t - 0.1);
        })}.view());
  };
  EXPECT_NEAR(lag(0.6).value(), 0.1, 0.05);
  EXPECT_FALSE(lag(0.01));
  EXPECT_FALSE(lag(-0.01));
}

TEST(Lag, OfAMuscleThatDoesNotMoveIsUnknown) {
  const Columns run{sampled(100, [](double t) { return 0.1 * t; }), std::vector<double>(100, 0.05)};
  EXPECT_FALSE(time_lag_s(run.view()));
}

double step_up(double t) {
  return t < 1.2 - 1e-9 ? 0.05 : 0.15;
}

TEST(Overshoot, OfASecondOrderStepIsTheTextbooks) {
  constexpr double damping = 0.3, natural_rad_per_s = 5.0;
  const double ringing_rad_per_s = natural_rad_per_s * std::sqrt(1.0 - damping * damping);
  const auto response = [&](double t) {
    if (t < 1.2) return 0.05;
    const double decay = std::exp(-damping * natural_rad_per_s * (t - 1.2));
    const double angle = ringing_rad_per_s * (t - 1.2);
    return 0.05 + 0.1 * (1.0 - decay * (std::cos(angle) +
                                        damping * natural_rad_per_s / ringing_rad_per_s * std::sin(angle)));
  };
  const Columns run{sampled(600, step_up), sampled(600, response)};
  const double expected = std::exp(-damping * std::numbers::pi / std::sqrt(1.0 - damping * damping));
  EXPECT_NEAR(overshoot(run.view()).value(), expected, 1e-3);
}

TEST(Overshoot, CountsOnlyInTheDirectionTheTargetHasMoved) {
  // Begins below the target's range, because the load was at rest there; the target only rises.
  const Columns rising{{0.05, 0.05, 0.15, 0.15}, {0.0, 0.02, 0.10, 0.15}};
  EXPECT_EQ(overshoot(rising.view()), 0.0);
  const Columns falling{{0.15, 0.15, 0.05, 0.05}, {0.19, 0.18, 0.10, 0.03}};
  EXPECT_NEAR(overshoot(falling.view()).value(), 0.2, 1e-12);
}

/// Up by 0.1, after a rest by 0.02 more, and down to the start.
double three_steps(double t) {
  return t < 1.0 ? 0.05 : t < 3.0 ? 0.15 : t < 5.0 ? 0.17 : 0.05;
}

TEST(Overshoot, OfSeveralStepsIsTheLargestOfItsOwnStep) {
  const Columns run{sampled(600, three_steps), sampled(600, [](double t) {
                      const double past = t > 3.2 && t < 3.4   ? 0.01   // half of its step
                                          : t > 1.2 && t < 1.4 ? 0.01   // a tenth
                                          : t > 5.2 && t < 5.4 ? -0.03  // a quarter
                                                               : 0.0;
                      return three_steps(t) + past;
                    })};
  EXPECT_NEAR(overshoot(run.view()).value(), 0.5, 1e-12);
}

TEST(Overshoot, OfASineIsOfItsWholeRange) {
  const auto sine = [](double t) { return 0.05 * std::sin(2.0 * std::numbers::pi * t / 2.5); };
  const Columns run{sampled(1000, sine), sampled(1000, [&](double t) { return 1.2 * sine(t); })};
  EXPECT_NEAR(overshoot(run.view()).value(), 0.1, 1e-4);
}

TEST(Lag, OfStepsIsUnknown) {
  const auto late = [](const auto& target) {
    return time_lag_s(
        Columns{sampled(600, target), sampled(600, [&](double t) { return target(t - 0.12); })}.view());
  };
  EXPECT_FALSE(late(three_steps));
  EXPECT_FALSE(moves_in_steps(std::vector<double>(100, 0.1)));
  EXPECT_TRUE(late([](double t) { return t < 4.0 ? three_steps(t) : 0.17 - 0.05 * (t - 4.0); }));
}

TEST(Settling, OfSeveralStepsIsTheLongest) {
  const auto first_order = [](double t, double time_constant_s) {
    const auto left = [&](double from, double step) {
      return t < from ? 0.0 : step * std::exp(-(t - from) / time_constant_s);
    };
    return three_steps(t) - left(1.0, 0.1) - left(3.0, 0.02) + left(5.0, 0.12);
  };
  Columns run{sampled(600, three_steps),
              sampled(600, [&](double t) { return first_order(t, t < 3.0 ? 0.3 : 0.1); })};
  Followed view = run.view();
  view.last_change_s = 5.0;
  EXPECT_NEAR(settling_time_s(view).value(), 0.3 * std::log(50.0), tick_s);
  for (double& reached : run.contraction) reached += 0.0005;  // within 2 % of the first and last step alone
  EXPECT_FALSE(settling_time_s(view));
}

TEST(Settling, OfAFirstOrderStepIsLn50TimeConstants) {
  constexpr double time_constant_s = 0.25;
  const auto response = [](double t) {
    return t < 1.2 ? 0.05 : 0.15 - 0.1 * std::exp(-(t - 1.2) / time_constant_s);
  };
  const Columns run{sampled(500, step_up), sampled(500, response)};
  Followed view = run.view();
  EXPECT_FALSE(settling_time_s(view)) << "a periodic target has no last change";
  view.last_change_s = 1.2;
  const double exact_s = time_constant_s * std::log(50.0);
  EXPECT_GE(settling_time_s(view).value(), exact_s);
  EXPECT_LT(settling_time_s(view).value(), exact_s + tick_s);
}

TEST(Settling, IsNoneIfTheErrorStaysOrComesBack) {
  Columns run{sampled(500, step_up), sampled(500, step_up)};
  Followed view = run.view();
  view.last_change_s = 1.2;
  EXPECT_EQ(settling_time_s(view), 0.0);
  view.last_change_s = 99.0;
  EXPECT_FALSE(settling_time_s(view)) << "the run ends before the last change";
  view.last_change_s = 1.2;
  run.contraction.back() += 0.003;
  EXPECT_FALSE(settling_time_s(view));
  run.contraction.back() -= 0.003;
  run.contraction[300] += 0.003;
  EXPECT_NEAR(settling_time_s(view).value(), 301 * tick_s - 1.2, 1e-12);
}

TEST(Spread, OfKnownValues) {
  const std::vector<double> values{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  const Spread found = spread(values);
  EXPECT_EQ(found.lowest, 2.0);
  EXPECT_EQ(found.highest, 9.0);
  EXPECT_EQ(found.width(), 7.0);
  EXPECT_NEAR(found.mean, 5.0, 1e-15);
  EXPECT_NEAR(found.standard_deviation, std::sqrt(32.0 / 7.0), 1e-15);
  EXPECT_EQ(spread(std::vector<double>{3.0}).standard_deviation, 0.0);
  EXPECT_THROW(spread({}), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::run
