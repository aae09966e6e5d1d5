// Two muscles under controllers on the rig itself: the stiffness that a row tells, models that are true and
// wrong, delays, tuning, and no heap on the way.
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <plant/joint_stiffness.hpp>
#include <sim/run/compare.hpp>

#include "heap_watch.hpp"

namespace mckibben::run {
namespace {

constexpr double deg = plant::degree_rad;
const ProgressHook nobody = [](const std::string&, std::size_t, std::size_t) {};

domain::Scenario sine(std::vector<controllers::Settings> settings, std::vector<double> loads_kg) {
  domain::Scenario scenario = domain::pair_scenario();
  scenario.duration_s = 2.4;
  controllers::SineOf<controllers::Angle> angle;
  angle.amplitude.value = 15.0 * deg;
  angle.period_s = 2.4;
  scenario.targets.push_back({"sine", angle, std::nullopt});
  scenario.loads_kg = std::move(loads_kg);
  scenario.controllers = std::move(settings);
  return scenario;
}

controllers::PairPidSettings pid() {
  controllers::PairPidSettings settings;
  settings.proportional_mA = 30.0;
  settings.integral_time_s = 0.1;
  settings.derivative_time_s = 0.08;
  return settings;
}

TEST(JointStiffness, IsThatOfTheBraidsAtTheirPressures) {
  const plant::Rig rig = plant::thesis_pair();
  const plant::Plant plant = plant::plant_of(rig);
  plant::State<double> state{};
  state.joint.contraction_ratio = 0.12;
  state.side.muscle_pressure_Pa = 3e5;
  state.opposite.muscle_pressure_Pa = 2e5;
  const plant::Braid braid(rig.muscle);
  const auto drop_N = [&](double e, double pressure_Pa) {
    return (braid.force_N(e - 1e-4, pressure_Pa) - braid.force_N(e + 1e-4, pressure_Pa)) / 2e-4;
  };
  const double R = rig.joint.wheel_radius_m, l0 = rig.muscle.rest_length_m;
  EXPECT_NEAR(plant::joint_stiffness_N_m_per_rad(plant, state, {}, {}),
              R * R / l0 * (drop_N(0.12, 3e5) + drop_N(0.08, 2e5)), 1e-5);
}

// Controllers are compared under one noise: neither place in the file nor other loads change a run's.
TEST(PairTracking, NoiseGoesByTheLoad) {
  const auto ran = [](std::vector<double> loads_kg, bool twice) {
    controllers::PairPidSettings other = pid();
    other.name = "other";
    domain::Scenario scenario = sine({pid()}, std::move(loads_kg));
    if (twice) scenario.controllers.insert(scenario.controllers.begin(), other);
    scenario.noise.encoder_jitter = 1e-3;
    const Comparison all = compare(scenario, 1, nobody);
    std::map<double, std::set<double>> rmse;
    for (const TrackedRun& run : all.runs) rmse[run.load_kg].insert(run.metrics.rmse);
    return rmse;
  };
  const auto alone = ran({1.0}, false), beside = ran({0.0, 1.0}, true);
  EXPECT_EQ(beside.at(0.0).size(), 1u);
  EXPECT_EQ(beside.at(1.0), alone.at(1.0));
  EXPECT_NE(beside.at(0.0), alone.at(1.0));
}

TEST(PairTracking, ATrueModelFollowsAndAWrongLoadIsMadeUpForByFeedback) {
  controllers::PairModelInverseSettings open;
  controllers::PairModelInverseFeedbackSettings closed, late;
  late.name = "late";
  late.feedback_delay_ticks = 5;
  const Comparison all = compare(sine({open, closed, late, pid()}, {0.0, 1.0}), 2, nobody);
  ASSERT_EQ(all.runs.size(), 8u);
  std::vector<double> rmse_deg;
  for (const TrackedRun& run : all.runs) {
    ASSERT_EQ(run.failure, "") << run.name;
    rmse_deg.push_back(run.metrics.rmse / deg);
  }
  EXPECT_EQ(all.runs[5].name, "sine_1kg_model_inverse_feedback");
  EXPECT_LT(rmse_deg[0], 0.4) << "the model is the rig";
  EXPECT_NEAR(rmse_deg[1], rmse_deg[0], 1e-6) << "counts tell nothing new";
  EXPECT_GT(rmse_deg[4], 3.0 * rmse_deg[0]) << "nobody told it of the load";
  EXPECT_LT(rmse_deg[5], 0.7 * rmse_deg[4]);
  EXPECT_LT(rmse_deg[6], 0.9 * rmse_deg[4]) << "five ticks late";
  EXPECT_LT(rmse_deg[7], 2.5);

  controllers::PairModelInverseSettings told = open;
  told.assumed_load_kg = 1.0;
  const Comparison once = compare(sine({told}, {1.0}), 1, nobody);
  EXPECT_LT(once.runs.front().metrics.rmse / deg, 0.4);
}

// 0.2 deg at 12 ms were 17 deg at 1 ms.
TEST(PairTracking, AModelFollowsAtAnyTick) {
  for (const double period_s : {0.0005, 0.05}) {
    domain::Scenario scenario = sine(
        {controllers::PairModelInverseSettings{}, controllers::PairModelInverseFeedbackSettings{}}, {0.0});
    scenario.rig.tick_s = period_s;
    scenario.duration_s = 1.2;
    const Comparison all = compare(scenario, 1, nobody);
    for (const TrackedRun& run : all.runs) {
      ASSERT_EQ(run.failure, "") << period_s;
      EXPECT_LT(run.metrics.rmse / deg, 0.4) << period_s << ' ' << run.name;
    }
  }
}

TEST(PairTracking, ALookAheadThatIsTooShortIsRefused) {
  controllers::PairModelInverseSettings open;
  controllers::PairModelInverseFeedbackSettings closed;
  open.look_ahead_s = closed.look_ahead_s = 0.006;
  domain::Scenario scenario = sine({open, closed}, {0.0});
  scenario.rig.tick_s = 0.002;
  scenario.duration_s = 1.2;
  for (const TrackedRun& run : compare(scenario, 2, nobody).runs)
    EXPECT_NE(run.failure.find("look_ahead, 6 ms, is shorter than this rig takes to answer"),
              std::string::npos)
        << run.name << ": " << run.failure;
}

TEST(PairTracking, TheStiffnessIsHadThatIsWanted) {
  controllers::PairModelInverseSettings inverse;
  domain::Scenario scenario = sine({pid(), inverse}, {0.5});
  controllers::StepsOf<controllers::Stiffness> steps;
  steps.start.value = 12.0;
  steps.moves.push_back({1.2, {16.0}});
  scenario.targets.front().stiffness = steps;
  const Comparison all = compare(scenario, 2, nobody);
  for (const TrackedRun& run : all.runs) {
    ASSERT_EQ(run.failure, "");
    const auto& rows = run.recording.samples;
    EXPECT_NEAR(rows[88].stiffness_N_m_per_rad, 12.0, 0.4) << run.name;  // plans look 8 ticks ahead
    EXPECT_NEAR(rows.back().stiffness_N_m_per_rad, 16.0, 0.4) << run.name;
    EXPECT_NEAR(*run.joint->stiffness_asked, 14.0, 0.1);
    EXPECT_LT(*run.joint->stiffness_rmse, 0.7);
  }
}

TEST(PairTracking, SidesMayBeExchanged) {
  domain::Scenario one = sine({pid()}, {0.0}), two = one;
  one.rig.muscle.rest_radius_m = 0.0085;  // muscle 1 the stronger, or muscle 2
  std::get<plant::Pair>(two.rig.mechanics).opposite.muscle.rest_radius_m = 0.0085;
  auto& angle = std::get<controllers::SineOf<controllers::Angle>>(two.targets.front().angle);
  angle.amplitude.value = -angle.amplitude.value;
  const Comparison first = compare(one, 1, nobody), second = compare(two, 1, nobody);
  const auto &a = first.runs.front().recording.samples, &b = second.runs.front().recording.samples;
  // The encoder rounds down both ways round, by half a count in the mean; the controller knows that.
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a[k].state.joint.contraction_ratio, b[k].opposite.contraction_ratio, 0.003) << k;
}

TEST(PairTracking, TuningLeavesGainsThatFollow) {
  controllers::PairPidSettings open;
  open.integral_time_s = 0.1;
  open.derivative_time_s = 0.08;  // one gain is left
  domain::Scenario scenario = sine({open}, {0.0, 1.0});
  Briefing briefing = briefing_of(scenario);
  int trials = 0;
  controllers::Settings* left[] = {&briefing.settings.front()};
  const auto tuned = tune_controllers(scenario, briefing, left, 1, [&] { ++trials; });
  ASSERT_EQ(tuned.size(), 1u);
  EXPECT_EQ(tuned.front().failure, "");
  EXPECT_EQ(tuned.front().load_kg, 0.0) << "the lower of the two in the middle";
  EXPECT_EQ(trials, tuned.front().tuned.evaluations);
  const auto& pid = std::get<controllers::PairPidSettings>(briefing.settings.front());
  EXPECT_FALSE(pid.needs_tuning());
  EXPECT_NEAR(*pid.proportional_mA * per_ratio(scenario.rig), tuned.front().tuned.gains.proportional_mA,
              1e-9);
  EXPECT_LT(tuned.front().tuned.cost, *tuned.front().tuned.start_cost + 1e-12);
}

/// Counts what is taken from the heap between the first tick and the last.
class Watched final : public controllers::Controller {
 public:
  Watched(std::unique_ptr<Controller> inner, std::int64_t last) : inner_(std::move(inner)), last_(last) {}
  controllers::Command rest() override { return inner_->rest(); }
  std::int64_t preparation_ticks() const override { return inner_->preparation_ticks(); }
  controllers::Command step(const controllers::Reading& reading) override {
    if (reading.tick == last_) allocations = stop_heap_watch();
    const controllers::Command command = inner_->step(reading);
    if (reading.tick == 0) start_heap_watch();
    return command;
  }
  bool already_quantised() const override { return inner_->already_quantised(); }
  long allocations = -1;

 private:
  std::unique_ptr<Controller> inner_;
  std::int64_t last_;
};

TEST(PairTracking, TouchesNoHeapBetweenFirstAndLastTick) {
  const domain::Scenario scenario =
      sine({pid(), controllers::PairModelInverseSettings{}, controllers::PairModelInverseFeedbackSettings{}},
           {0.5});
  const Briefing briefing = briefing_of(scenario);
  for (const controllers::Settings& settings : briefing.settings) {
    Watched controller(briefing.make(settings, 0, 0.5),
                       static_cast<std::int64_t>(briefing.targets.front().values.size()) - 1);
    EXPECT_EQ(simulate(plan_of(scenario, 0.5, 1), controller).failure, "");
    EXPECT_EQ(controller.allocations, 0) << name_of(settings);
  }
}

}  // namespace
}  // namespace mckibben::run
