// Words for controllers at a limit and for tunings that gained nothing, from made-up runs.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <sim/run/remarks.hpp>

namespace mckibben::run {
namespace {

TrackedRun stood(double load_kg, double lowest, double highest) {
  TrackedRun run{.load_kg = load_kg, .controller = "pid"};
  run.limits = {4.0, 20.0};
  run.metrics.at_lowest_current = lowest;
  run.metrics.at_highest_current = highest;
  return run;
}

Comparison of(const std::vector<TrackedRun>& runs) {
  Comparison comparison;
  comparison.runs = runs;
  return comparison;
}

TEST(Remarks, SayHowLongAControllerStoodAtALimitAndWithWhichLoadMost) {
  EXPECT_EQ(limit_words(of({stood(8.0, 0.3, 0.0)}), {}, "pid"),
            "stood at its lowest current, 4 mA, for 30 % of the time");
  EXPECT_EQ(limit_words(of({stood(8.0, 0.3, 0.0), stood(9.5, 0.1, 0.1)}), {}, "pid"),
            "stood at its lowest current, 4 mA, for 20 % of the time and at its highest current, 20 mA, "
            "for 5 % of the time (with 8 kg for 30 %)");
  EXPECT_EQ(limit_words(of({stood(8.0, 0.005, 0.0)}), {}, "pid"), "");
  EXPECT_EQ(limit_words(of({stood(8.0, 0.5, 0.0)}), {}, "other"), "");
}

TEST(Remarks, SayFromWhenErrorsCountAndWhatTheWayFromRestAdds) {
  domain::Scenario scenario;
  scenario.duration_s = 8.0;
  TrackedRun run = stood(8.0, 0.0, 0.0);
  run.recording.samples.resize(4);  // at rest, at 0
  Comparison comparison = of({run});
  const auto said = [&](const std::vector<double>& values, std::size_t first) {
    Wanted target;
    target.ratios = target.values = values;
    target.first = first;
    comparison.targets = {target};
    return counted_words(scenario, comparison);
  };
  EXPECT_EQ(said({0.05, 0.05, 0.1, 0.1}, 1), ", from the target's first move on");
  EXPECT_EQ(said({0.10, 0.12, 0.15, 0.10}, 0),
            ", from 0 s on, the way from rest included (skip: 2 s leaves it out)");
  EXPECT_EQ(said({0.001, 0.02, 0.05, 0.10}, 0), "") << "begins where the load rests";
  scenario.duration_s = 1.0;
  EXPECT_NE(said({0.1, 0.1, 0.1, 0.1}, 0).find("skip: 0.25 s"), std::string::npos);
  scenario.skip_s = 0.0;
  EXPECT_EQ(said({0.10, 0.12, 0.15, 0.10}, 0), "") << "as it was asked for";
  scenario.skip_s = 0.5;
  EXPECT_EQ(said({0.10, 0.12, 0.15, 0.10}, 2), ", from 0.5 s on");
}

TEST(Remarks, NameTheKeyThatWouldHelp) {
  plant::Rig rig;
  EXPECT_EQ(limit_warning(stood(8.0, 0.4, 0.0), rig), "");
  EXPECT_NE(limit_warning(stood(8.0, 0.6, 0.0), rig).find("valve.zero_pressure"), std::string::npos);
  EXPECT_NE(limit_warning(stood(8.0, 0.0, 0.6), rig).find("valve.span_pressure"), std::string::npos);
  EXPECT_EQ(limit_warning(stood(8.0, 0.0, 0.6), rig).find("calibration"), std::string::npos);
  EXPECT_NE(limit_warning(stood(8.0, 0.0, 0.6), rig, true).find(", or a calibration of this rig and load,"),
            std::string::npos);
  rig.valve.zero_command = 0.0;
  EXPECT_NE(limit_warning(stood(8.0, 0.6, 0.0), rig).find("goes down to 0 mA: lower lowest_command"),
            std::string::npos);
}

TEST(Remarks, OneThatSwingsIsNotToldThatItsTargetIsOutOfReach) {
  TrackedRun run = stood(8.0, 0.3, 0.3);
  run.metrics.swings = true;
  const std::string warning = limit_warning(run, {});
  EXPECT_NE(warning.find("it swings to and from the ends of its current, where it stood for 60 %"),
            std::string::npos)
      << warning;
  EXPECT_EQ(warning.find("the target needs"), std::string::npos) << warning;
}

TEST(Remarks, AnOpenLoopThatEndsOffItsTargetIsToldWhy) {
  const plant::Rig rig;
  Wanted wanted;
  wanted.ratios.assign(200, 0.03);
  std::fill(wanted.ratios.begin() + 50, wanted.ratios.end(), 0.13);
  wanted.ratios[50] = 0.08;  // a ramp of two ticks
  controllers::OpenLoopSettings settings;
  settings.model.range = {.lowest_speed_mA_per_s = 5.5, .highest_speed_mA_per_s = 17.0};
  TrackedRun run{.load_kg = 16.0, .controller = "open_loop"};
  run.recording.samples.resize(200);
  run.recording.samples.front().state.joint.contraction_ratio = 0.08;
  run.recording.findings = {{"believed_load", "kg", 16.5}, {"ticks_outside_calibrated_speed", "1", 120.0}};

  run.metrics.final_error = -0.019;
  EXPECT_EQ(missed_warning(run, wanted, settings, rig), "") << "within a fifth of the target's range";
  run.metrics.final_error = -0.05;
  EXPECT_EQ(missed_warning(run, wanted, settings, rig),
            "it ends 15.0 mm below its target and began 15.0 mm above target.start, to which no feedback "
            "brings it; at 120 of 200 ticks its command should change slower or faster than those of the "
            "calibration, 5.5 to 17 mA/s, and it takes the nearest: extrapolate_target: true, or calibrate "
            "with such commands; feedback (kind: feedforward_pid) would help and, if its calibration is of "
            "another rig, one of this rig");
  settings.extrapolate_target = true;
  settings.assumed_load_kg = 12.0;
  run.recording.samples.front().state.joint.contraction_ratio = 0.03;
  EXPECT_EQ(
      missed_warning(run, wanted, settings, rig),
      "it ends 15.0 mm below its target; feedback (kind: feedforward_pid) would help and, if its calibration "
      "is of another rig, one of this rig");
  Wanted steps = wanted;
  steps.ratios[50] = 0.13;
  EXPECT_EQ(missed_warning(run, steps, settings, rig),
            "it ends 15.0 mm below its target; its model gives commands for speeds, and its target moves in "
            "steps: a target of kind: minimum_jerk or ramps, open_loop_limited, which slows it, or feedback "
            "(kind: feedforward_pid)");

  EXPECT_EQ(missed_warning(run, wanted, controllers::FeedforwardPidSettings{}, rig), "") << "has feedback";
  wanted.ratios.back() = 0.12;
  EXPECT_EQ(missed_warning(run, wanted, settings, rig), "") << "the target does not rest at the end";
}

TEST(Remarks, AStaticInverseIsToldThatItKnowsNoRubber) {
  plant::Rig rig;
  Wanted wanted;
  wanted.ratios.assign(200, 0.03);
  std::fill(wanted.ratios.begin() + 50, wanted.ratios.end(), 0.13);
  TrackedRun run{.load_kg = 16.0, .controller = "static_inverse"};
  run.recording.samples.resize(200);
  run.recording.samples.front().state.joint.contraction_ratio = 0.03;
  run.metrics.final_error = -0.05;
  EXPECT_EQ(missed_warning(run, wanted, controllers::StaticInverseSettings{}, rig), "");
  rig.effects.get<plant::BladderElasticity>().stiffness_N_per_m = 1000.0;
  EXPECT_EQ(missed_warning(run, wanted, controllers::StaticInverseSettings{}, rig),
            "it ends 15.0 mm below its target; its law has no rubber tube (effects.bladder_elasticity), and "
            "this rig has one: kind: model_inverse has it, too, and feedback helps");
}

// T 4.3: what it weighs may be wrong by a tenth.
TEST(Remarks, AWrongLoadIsToldWhereverTheRunEnds) {
  TrackedRun run;
  run.load_kg = 5.0;
  controllers::OpenLoopSettings settings;
  const auto weighed = [&](double kg) {
    run.recording.findings = {{"believed_load", "kg", kg}};
    return load_warning(run, settings);
  };
  EXPECT_EQ(weighed(5.49), "");
  EXPECT_EQ(
      weighed(9.451),
      "it takes its load of 5 kg for 9.45 kg: write assumed_load: 5 kg, or a weighing or calibration that "
      "fits this rig");
  settings.assumed_load_kg = 5.0;
  EXPECT_EQ(weighed(9.451), "");
  settings.assumed_load_kg = 4.0;
  EXPECT_EQ(weighed(5.0), "it takes its load of 5 kg for 4 kg: write assumed_load: 5 kg");
  EXPECT_EQ(load_warning(run, controllers::FeedforwardPidSettings{}), "") << "has feedback";
  run.failure = "the load was not weighed";
  EXPECT_EQ(load_warning(run, settings), "");
}

TEST(Remarks, AReadingThatIsOffIsToldWithItsKeyWhereAControllerUsesIt) {
  plant::Rig rig;
  rig.joint.reading_offset_m = 4.2e-3;
  TrackedRun run{.load_kg = 16.0, .controller = "pid"};
  run.recording.samples.resize(10);
  for (Sample& sample : run.recording.samples) sample.misread_ratio = 0.014;
  run.metrics.mae = 0.015;
  EXPECT_EQ(
      reading_warning(run, controllers::PidSettings{}, rig),
      "it reads 4.2 mm too high in the mean (joint.reading_offset), which it cannot see: the errors, which "
      "are true ones, have that in them, as on a bench that reads so; for one that reads right take it out "
      "of the rig");
  controllers::OpenLoopSettings weighs;
  EXPECT_NE(reading_warning(run, weighs, rig), "");
  weighs.assumed_load_kg = 16.0;
  EXPECT_EQ(reading_warning(run, weighs, rig), "") << "it reads nothing";
  EXPECT_EQ(reading_warning(run, controllers::ModelInverseFeedbackSettings{}, rig), "") << "its model has it";
  run.metrics.mae = 0.15;
  EXPECT_EQ(reading_warning(run, controllers::PidSettings{}, rig), "") << "hardly any of the error";

  rig.joint.reading_offset_m = 0.0;
  run.metrics.mae = 0.015;
  EXPECT_EQ(reading_warning(run, controllers::PidSettings{}, rig), "") << "late";
  rig.effects.get<plant::EncoderScale>().error = 0.05;
  EXPECT_NE(reading_warning(run, controllers::PidSettings{}, rig).find("(effects.encoder_scale.error)"),
            std::string::npos);
}

TEST(Remarks, ALoopThatOscillatesIsToldItsAmplitudeAndPeriod) {
  plant::Rig rig;
  Wanted wanted;
  wanted.ratios.assign(400, 0.1);
  TrackedRun run{.load_kg = 16.0, .controller = "pid"};
  controllers::PidSettings settings;
  settings.proportional_mA = 120.0;
  double flat = 1.0;  // a smaller part of the swing: the load sticks at its ends
  const auto swinging = [&](double amplitude) {
    run.recording.samples.clear();
    for (int k = 0; k < 400; ++k) {
      run.recording.samples.emplace_back();
      run.recording.samples.back().state.joint.contraction_ratio =
          0.1 + amplitude * std::clamp(std::sin(0.2 * k), -flat, flat);
    }
    run.cycle = limit_cycle(run.recording, wanted, rig.tick_s);
    return cycle_warning(run, wanted, settings, rig);
  };
  EXPECT_EQ(swinging(4e-4), "");
  EXPECT_EQ(swinging(4e-3),
            "it oscillates where its target rests from 0 s on, by ±1.2 mm with a period of 0.38 s; a lower "
            "proportional (it is 120 mA) or a longer integral_time would help: linearise shows the margins");
  flat = 0.5;
  EXPECT_NE(
      swinging(4e-3).find("a longer integral_time or, as friction holds it in between, a dead_zone of "),
      std::string::npos);
  flat = 1.0;
  run.limits = {4.0, 20.0};
  run.metrics.at_lowest_current = 0.6;
  rig.valve.command_unit = plant::CommandUnit::V;
  EXPECT_NE(swinging(4e-3).find("(it is 120 V)"), std::string::npos) << "at a limit elsewhere";
  run.metrics.swings = true;
  EXPECT_EQ(swinging(4e-3), "") << "its limits say so";
}

TEST(Remarks, AControllerThatOscillatesIsNotPraisedWithoutSayingSo) {
  plant::Rig rig;
  rig.muscle.rest_length_m = 0.3;
  Comparison comparison = of({stood(8.0, 0.0, 0.0), stood(9.5, 0.0, 0.0)});
  EXPECT_EQ(cycle_words(comparison, rig, "pid"), "");
  EXPECT_FALSE(in_doubt(comparison, "pid"));
  comparison.runs[0].cycle = LimitCycle{.amplitude = 0.01, .period_s = 0.4, .from_s = 0.0};
  comparison.runs[1].cycle = LimitCycle{.amplitude = 0.026, .period_s = 0.4, .from_s = 0.0};
  EXPECT_EQ(cycle_words(comparison, rig, "pid"),
            "oscillates where its target rests, by ±7.8 mm (with 9.5 kg)");
  EXPECT_TRUE(in_doubt(comparison, "pid"));
  EXPECT_EQ(cycle_words(comparison, rig, "other"), "");
  comparison.runs.resize(1);
  EXPECT_EQ(cycle_words(comparison, rig, "pid"), "oscillates where its target rests, by ±3 mm");
}

TEST(Remarks, ATuningMustBeatNoFeedback) {
  TunedController tuned{.controller = "pid", .load_kg = 8.0};
  tuned.tuned.cost = 0.02;
  EXPECT_FALSE(gained_nothing(tuned)) << "nothing to compare with";
  tuned.idle_cost = 0.1;
  EXPECT_FALSE(gained_nothing(tuned));
  tuned.tuned.cost = 0.099;
  EXPECT_TRUE(gained_nothing(tuned));
  EXPECT_EQ(tuning_warning(tuned, {}),
            "its tuning gained nothing: the cost is 0.099, without any feedback 0.1; feedback "
            "does not help with this target: can the load follow it (tuning_load), is the delay too long "
            "(feedback_delay_ticks)?");
  Comparison comparison = of({stood(8.0, 0.1, 0.1)});
  EXPECT_FALSE(in_doubt(comparison, "pid"));
  comparison.tuned = {tuned};
  EXPECT_TRUE(in_doubt(comparison, "pid"));
}

}  // namespace
}  // namespace mckibben::run
