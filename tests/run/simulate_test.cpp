// The tick loop: order of things in a tick, the static hysteresis loop,
// instruments, chance, and no heap on the way.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <plant/plant.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/rig_model.hpp>
#include <sim/run/simulate.hpp>

#include "heap_watch.hpp"
#include "switched_on.hpp"

namespace mckibben::run {
namespace {

RunPlan plan(double load_kg, std::size_t ticks) {
  RunPlan s;
  s.load_kg = load_kg;
  s.ticks = ticks;
  return s;
}

Recording ride(const RunPlan& s, const controllers::Settings& settings) {
  const auto controller = controllers::make(settings, knowledge_of(s.rig, {}));
  return simulate(s, *controller);
}

controllers::TriangleCurrent slow_triangle() {
  controllers::TriangleCurrent current;
  current.low_mA = 4.0;
  current.high_mA = 20.0;
  current.speed_mA_per_s = 0.5;
  return current;
}

TEST(Simulate, TheCurrentOfARowIsFeltInTheNext) {
  controllers::StepCurrent current;
  current.start_mA = 8.0;
  current.moves = {{0.036, 16.0}};
  const auto recording = ride(plan(16.138, 6), current);
  ASSERT_EQ(recording.samples.size(), 6u);
  EXPECT_EQ(recording.samples[2].current_mA, recording.samples[0].current_mA);
  EXPECT_NE(recording.samples[3].current_mA, recording.samples[2].current_mA);
  EXPECT_NEAR(recording.samples[3].state.side.valve_pressure_Pa,
              recording.samples[0].state.side.valve_pressure_Pa, 1.0);
  EXPECT_GT(recording.samples[4].state.side.valve_pressure_Pa,
            recording.samples[3].state.side.valve_pressure_Pa + 1e4);
}

// 5 kg that are hung on later are a weight of 49.03325 N from then on.
TEST(Simulate, AForceOnTheCordActsFromItsTickOn) {
  controllers::StepCurrent current;
  current.start_mA = 8.0;
  current.moves = {{0.5, 14.0}};
  RunPlan pulled = plan(10.0, 900);
  pulled.outer_forces = {{3.0, 49.03325}, {9.0, 0.0}};
  pulled.keep_ledger = true;
  const auto free = ride(plan(10.0, 900), current), with = ride(pulled, current);
  EXPECT_TRUE(with.driven.joint_force);
  EXPECT_FALSE(free.driven.joint_force);
  for (std::size_t k = 0; k <= 250; ++k)
    ASSERT_EQ(with.samples[k].state.joint.contraction_ratio, free.samples[k].state.joint.contraction_ratio);
  EXPECT_EQ(with.samples[249].joint_force_N, 0.0);
  EXPECT_EQ(with.samples[250].joint_force_N, 49.03325);
  EXPECT_LT(with.samples[251].state.joint.contraction_speed_per_s,
            free.samples[251].state.joint.contraction_speed_per_s);
  EXPECT_LT(with.imbalance.energy, 1e-5);
  // Where nothing but the floor of 1 N rubs it comes to rest where 15 kg do.
  RunPlan early = plan(10.0, 900);
  early.rig.friction.scale = 0.0;
  early.rig.joint.guide_damping_N_s_per_m = 200.0;
  RunPlan heavy = early;
  heavy.load_kg = 15.0;
  early.outer_forces = {{0.0, 49.03325}};
  EXPECT_NEAR(ride(early, current).samples.back().state.joint.contraction_ratio,
              ride(heavy, current).samples.back().state.joint.contraction_ratio, 5e-4);
}

// On solenoids commanded by a duty: 12 V of 24 V is both shut.
TEST(Simulate, APidWithADeadZoneLetsSolenoidsRest) {
  RunPlan bench = plan(10.0, 600);
  plant::command_in(bench.rig, plant::CommandUnit::V, 0.0, 24.0);
  bench.rig.dac = plant::dac_for(bench.rig.valve);
  bench.rig.valve.kind = plant::ValveKind::on_off;
  bench.rig.valve.switching = plant::Switching::pwm;
  bench.rig.valve.pwm_frequency_Hz = 40.0;
  bench.rig.valve.conductance_m3_per_s_Pa = 1e-9;
  bench.rig.valve.resolve();
  controllers::PidSettings settings;
  settings.proportional_mA = 100.0;
  settings.integral_time_s = settings.derivative_time_s = 0.0;
  settings.dead_zone = 0.002;
  const auto controller = controllers::make(controllers::Settings(settings), knowledge_of(bench.rig, {0.08}));
  const auto recording = simulate(bench, *controller);
  ASSERT_EQ(recording.failure, "");
  EXPECT_NEAR(recording.samples.back().state.joint.contraction_ratio, 0.08, 0.003);
  for (std::size_t k = 500; k < 600; ++k) EXPECT_EQ(recording.samples[k].current_mA, 12.0) << k;
}

// T 2.8, 4.1, 4.2 at rest: going up P (A [..] - f S) = m g + floor,
// coming down P (A [..] + f S) = m g - floor.
TEST(Simulate, ASlowRideRunsRoundTheStaticHysteresisLoop) {
  const double load_kg = 16.138;
  const plant::Rig rig;
  const plant::Braid braid(rig.muscle);
  const double area_m2 = std::numbers::pi * 7.5e-3 * 7.5e-3;
  const auto recording = ride(plan(load_kg, 5400), slow_triangle());  // 64 s: up and down once
  int up = 0, down = 0;
  for (std::size_t k = 200; k + 1 < recording.samples.size(); ++k) {
    const auto& state = recording.samples[k].state;
    const double e = state.joint.contraction_ratio, w = state.joint.contraction_speed_per_s;
    if (e < 0.03 || std::abs(w) < 2e-3) continue;
    const double pull = area_m2 * braid.pull_ratio(e);
    const double friction = plant::friction_coefficient(rig.friction, e, 0.0) * braid.contact_surface_m2(e);
    const double sign = w > 0.0 ? 1.0 : -1.0;
    const double guide_N = rig.joint.guide_damping_N_s_per_m * rig.muscle.rest_length_m * w;
    const double expected_Pa = (load_kg * plant::gravity_m_per_s2 + sign * rig.friction.floor_N + guide_N) /
                               (pull - sign * friction);
    // What the statics leave out: what little the load accelerates.
    EXPECT_NEAR(state.side.muscle_pressure_Pa, expected_Pa, 1e-3 * expected_Pa)
        << "at e = " << e << ", w = " << w;
    ++(w > 0.0 ? up : down);
  }
  EXPECT_GT(up, 300);
  EXPECT_GT(down, 300);
}

std::vector<controllers::Settings> one_of_each() {
  controllers::PidSettings pid;
  pid.feedback_delay_ticks = 3;
  controllers::StaticInverseSettings inverse;
  inverse.assumed_load_kg = 14.0;
  controllers::StepCurrent steps;
  steps.moves = {{1.0, 12.0}, {2.0, 6.0}};
  controllers::RecordedCurrent recorded;
  recorded.samples_mA = std::vector<double>(100, 10.0);
  controllers::ModelInverseSettings planned;
  planned.model = model_of(plant::Rig(), 0.012);
  controllers::ModelInverseFeedbackSettings with_feedback;
  with_feedback.model = planned.model;
  with_feedback.feedback_delay_ticks = 2;
  std::vector<controllers::Settings> all{pid,
                                         planned,
                                         with_feedback,
                                         controllers::FeedforwardPidSettings{},
                                         controllers::OpenLoopSettings{},
                                         controllers::OpenLoopLimitedSettings{},
                                         inverse,
                                         controllers::SineCurrent{},
                                         slow_triangle(),
                                         steps,
                                         controllers::StairCurrent{},
                                         controllers::ChirpCurrent{},
                                         recorded};
  std::vector<domain::InputFile> inputs;
  const auto model = input::read_calibration(MCKIBBEN_TEST_DATA "/calibration.yaml", inputs);
  for (auto& settings : all) {
    if (auto* terms = controllers::part_of<controllers::PidForm>(settings)) {
      terms->proportional_mA = 60.0;
      terms->integral_time_s = 0.2;
      terms->derivative_time_s = 0.05;
    }
    if (auto* calibrated = controllers::part_of<controllers::CalibrationTerms>(settings)) {
      calibrated->model = model;
      calibrated->extrapolate_load = true;
    }
  }
  return all;
}

TEST(Simulate, TouchesNoHeapBetweenFirstAndLastTick) {
  constexpr std::size_t ticks = 300;
  const auto allocations_of = [&](const RunPlan& plan, const controllers::Settings& settings) {
    auto knowledge = knowledge_of(plan.rig, std::vector<double>(ticks, 0.1));
    knowledge.reach = reachable(plan.rig);
    Watched controller(controllers::make(settings, knowledge), ticks - 1);
    EXPECT_EQ(simulate(plan, controller).failure, "");
    return controller.allocations;
  };
  for (const auto method : {solver::Method::erk, solver::Method::cvode, solver::Method::automatic})
    for (const bool ledger : {false, true})
      for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb}) {
        RunPlan p = plan(13.87, ticks);
        p.rig.integrator.method = method;
        p.keep_ledger = ledger;
        p.rig.friction.memory = memory;
        p.rig.sensors.position().wiring = plant::EncoderWiring::crosswise;
        p.noise = {1e-4, 100.0, 0.01};
        EXPECT_EQ(allocations_of(p, one_of_each().front()), 0)
            << "method " << static_cast<int>(method) << ", ledger " << ledger;
        p.rig.effects = plant::rig_with_all_effects().effects;
        p.noise.ripple_Pa = p.noise.wander_Pa = 100.0;
        EXPECT_EQ(allocations_of(p, one_of_each().front()), 0)
            << "with effects, method " << static_cast<int>(method) << ", ledger " << ledger;
      }
  for (const auto& settings : one_of_each())
    EXPECT_EQ(allocations_of(plan(13.87, ticks), settings), 0) << controllers::name_of(settings);
  constexpr std::size_t guests = 2;  // a process and a library, whose heap is their own affair
  EXPECT_EQ(one_of_each().size() + guests, std::variant_size_v<controllers::SingleSettings>);
}

// A load that the stop cannot hold falls out of the range of the laws.
TEST(Simulate, AFailureEndsTheRecordingAndSaysWhy) {
  RunPlan p = plan(400.0, 100);
  p.rig.muscle.stop_stiffness_N_per_m = 1e3;
  p.rig.muscle.stop_damping_s_per_m = 0.0;
  const auto settling = ride(p, slow_triangle());
  EXPECT_NE(settling.failure.find("(settling)"), std::string::npos) << settling.failure;
  EXPECT_TRUE(settling.samples.empty());
  p.rig.settling_time_s = 0.0;
  const auto falling = ride(p, slow_triangle());
  EXPECT_NE(falling.failure.find("left the range"), std::string::npos) << falling.failure;
  EXPECT_GT(falling.samples.size(), 2u);
  EXPECT_LT(falling.samples.size(), 100u);
}

TEST(Simulate, HeapWatchSeesAllocations) {
  start_heap_watch();
  std::vector<int> touched(100);
  EXPECT_NE(touched.data(), nullptr);
  EXPECT_GT(stop_heap_watch(), 0);
}

TEST(Simulate, AGaugeOnTheValveReadsItsPressureWithANoiseOfItsOwn) {
  RunPlan s = plan(11.138, 400);
  s.rig.sensors.put({.signal = plant::Sensed::valve_pressure,
                     .kind = plant::SensorKind::gauge,
                     .resolution = 10.0,
                     .noise = 300.0,
                     .highest = 1e5});
  double squares = 0.0;
  int below = 0, at_the_end = 0;
  for (const Sample& row : ride(s, slow_triangle()).samples) {
    const double read_Pa = row.shown[plant::Sensed::valve_pressure];
    EXPECT_NEAR(read_Pa, 10.0 * std::round(read_Pa / 10.0), 1e-6);
    if (row.state.side.valve_pressure_Pa < 9.8e4) {
      squares += std::pow(read_Pa - row.state.side.valve_pressure_Pa, 2);
      ++below;
    }
    at_the_end += read_Pa == 1e5 ? 1 : 0;
  }
  ASSERT_GT(below, 50);
  EXPECT_GT(at_the_end, 50);
  EXPECT_NEAR(std::sqrt(squares / below), 300.0, 60.0);
}

TEST(Simulate, ASlowGaugeShowsAReadingWithItsNoiseUntilTheNext) {
  RunPlan s = plan(11.138, 100);
  plant::Sensor slow = plant::gauge();
  slow.noise = 300.0;
  slow.rate_Hz = 0.2 / s.rig.tick_s;
  s.rig.sensors.put(slow);
  const auto rows = ride(s, slow_triangle()).samples;
  const auto shown_Pa = [&](std::size_t k) { return rows[k].shown[plant::Sensed::muscle_pressure]; };
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_NEAR(shown_Pa(k), shown_Pa(k - k % 5), 1e-6) << k;
  EXPECT_NE(shown_Pa(0), shown_Pa(5));
}

// What was recorded by it is compared with what it would show, not with the pressure of now.
TEST(Simulate, AReplayComparesASlowGaugeWithWhatItWouldShow) {
  RunPlan s = plan(11.138, 100);
  plant::Sensor slow = plant::gauge();
  slow.rate_Hz = 0.1 / s.rig.tick_s;
  slow.delay_s = 0.05;
  s.rig.sensors.put(slow);
  controllers::TriangleCurrent fast = slow_triangle();
  fast.speed_mA_per_s = 10.0;
  const Recording recording = ride(s, fast);
  domain::Run run;
  std::vector<double> ratios, shown_Pa;
  double most_Pa = 0.0;
  for (const Sample& row : recording.samples) {
    ratios.push_back(row.read_ratio);
    shown_Pa.push_back(row.shown[plant::Sensed::muscle_pressure]);
    most_Pa = std::max(most_Pa, std::abs(shown_Pa.back() - row.state.side.muscle_pressure_Pa));
  }
  run.read("contraction", ratios);
  run.read("muscle_pressure", shown_Pa);
  EXPECT_GT(most_Pa, 1e3);
  const auto gaps = gaps_of(run, s.rig, recording);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps[1].reading, "muscle_pressure");
  EXPECT_LT(gaps[1].largest, 1e-9);
}

// One draw of it, held while the rig settles, would be an offset of the current.
TEST(Simulate, TheRigSettlesWithoutNoiseOfItsCurrent) {
  controllers::StepCurrent rests;
  rests.start_mA = 10.0;
  rests.moves = {};
  RunPlan s = plan(11.138, 40);
  const auto quiet = ride(s, rests).samples;
  s.noise.current_mA = 0.05;
  const auto noisy = ride(s, rests).samples;
  EXPECT_EQ(noisy[0].state.joint.contraction_ratio, quiet[0].state.joint.contraction_ratio);
  EXPECT_EQ(noisy[0].state.side.valve_pressure_Pa, quiet[0].state.side.valve_pressure_Pa);
  EXPECT_NE(noisy[39].state.side.valve_pressure_Pa, quiet[39].state.side.valve_pressure_Pa);
}

TEST(Simulate, SameSeedAndStreamGiveTheSameBytesOthersDoNot) {
  RunPlan s = plan(11.138, 300);
  s.noise = {1e-4, 200.0, 0.02};
  const auto same = [](const Recording& a, const Recording& b) {
    for (std::size_t k = 0; k < a.samples.size(); ++k)
      if (std::memcmp(&a.samples[k].state, &b.samples[k].state, sizeof a.samples[k].state) != 0 ||
          a.samples[k].counts != b.samples[k].counts ||
          a.samples[k].shown[plant::Sensed::muscle_pressure] !=
              b.samples[k].shown[plant::Sensed::muscle_pressure])
        return false;
    return true;
  };
  const auto first = ride(s, slow_triangle());
  EXPECT_TRUE(same(first, ride(s, slow_triangle())));
  RunPlan other = s;
  other.seed = 2;
  EXPECT_FALSE(same(first, ride(other, slow_triangle())));
  other = s;
  other.stream = 1;
  EXPECT_FALSE(same(first, ride(other, slow_triangle())));
}

TEST(Simulate, ARecordedCurrentIsNotRoundedAgain) {
  controllers::RecordedCurrent recorded;
  recorded.samples_mA = {8.0001, 8.0002, 8.0003};
  const auto recording = ride(plan(11.138, 3), recorded);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(recording.samples[k].current_mA, recorded.samples_mA[k]);
  const auto rounded = ride(plan(11.138, 1), controllers::Settings(slow_triangle()));
  EXPECT_EQ(rounded.samples[0].current_mA, 819.0 * 20.0 / 4096.0);  // 4 mA is between two steps
}

TEST(Simulate, TheEncoderReadsTheStateBeforeTheNewCurrent) {
  const auto recording = ride(plan(11.138, 2000), slow_triangle());
  const double per_count = contraction_per_count(plant::Rig{});
  for (const auto& sample : recording.samples) {
    const double e = sample.state.joint.contraction_ratio,
                 read = static_cast<double>(sample.counts) * per_count;
    EXPECT_LE(read, e + 1e-12);
    EXPECT_GT(read, e - per_count - 1e-12);
  }
}

TEST(Simulate, CurrentSpeedRaisesFrictionWhereTheLawSaysSo) {
  RunPlan s = plan(16.138, 1200);
  const auto nominal = ride(s, slow_triangle());
  s.rig.friction.f1_s2_per_mA2 = 1.0;  // 0.25 per cent more at 0.5 mA/s
  const auto faster = ride(s, slow_triangle());
  EXPECT_LT(faster.samples.back().state.joint.contraction_ratio,
            nominal.samples.back().state.joint.contraction_ratio - 1e-4);
}

}  // namespace
}  // namespace mckibben::run
