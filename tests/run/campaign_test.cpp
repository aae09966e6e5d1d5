// The runs of a campaign: their names, noise of their own,
// no dependence on order or threads, and an end in the middle.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <sim/data/amount.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/run/batch.hpp>

#include "campaign_runs.hpp"

namespace mckibben::run {
namespace {

domain::Campaign small_campaign() {
  domain::Campaign campaign;
  campaign.loads_kg = {11.138, 23.406};
  controllers::SineCurrent sine;
  sine.low_mA = 0.0;
  sine.period_s = 2.4;
  campaign.currents = {{"a", 0.6, sine}, {"b", 0.3, controllers::StepCurrent{}}};
  campaign.repeats = 2;
  campaign.noise.encoder_jitter = 1e-3;
  return campaign;
}

std::vector<double> ratios(const domain::Campaign& campaign, const CampaignJob& job) {
  return measured(campaign, run_job(campaign, job)).judged().values;
}

TEST(Campaign, EveryRunHasAnIdAndAStreamOfItsOwn) {
  const auto jobs = jobs_of(small_campaign());
  ASSERT_EQ(jobs.size(), 8u);
  EXPECT_EQ(jobs[0].id, "m1_a_r1");
  EXPECT_EQ(jobs[7].id, "m2_b_r2");
  std::set<std::string> ids;
  std::set<std::uint64_t> streams;
  for (const auto& job : jobs) {
    ids.insert(job.id);
    streams.insert(job.stream);
  }
  EXPECT_EQ(ids.size(), 8u);
  EXPECT_EQ(streams.size(), 8u);
  EXPECT_EQ(jobs[5].load_kg, 23.406);
}

TEST(Campaign, TheThesissHas100RunsOfFivePeriods) {
  const auto campaign = input::read_campaign(MCKIBBEN_SOURCE_DIR "/scenarios/thesis_campaign.yaml");
  const auto jobs = jobs_of(campaign);
  ASSERT_EQ(jobs.size(), 100u);
  EXPECT_EQ(jobs[0].id, "m1_n200");
  const auto run = run_job(campaign, jobs[0]);
  ASSERT_EQ(run.recording.samples.size(), 1000u);  // 5 x 200
  EXPECT_EQ(run.recording.samples[0].current_mA, 0.0);
  EXPECT_EQ(run.recording.samples[100].current_mA, 20.0);  // half a period later
  EXPECT_EQ(run.recording.samples[200].current_mA, 0.0);
  EXPECT_GT(run.recording.largest_contraction_ratio, 0.15);
}

TEST(Campaign, RepeatsDifferByTheirNoiseAndARunIsAlwaysTheSame) {
  const auto campaign = small_campaign();
  const auto jobs = jobs_of(campaign);
  EXPECT_NE(ratios(campaign, jobs[0]), ratios(campaign, jobs[1]));
  EXPECT_EQ(ratios(campaign, jobs[1]), ratios(campaign, jobs[1]));
  auto reseeded = campaign;
  reseeded.seed = 2;
  EXPECT_NE(ratios(campaign, jobs[0]), ratios(reseeded, jobs[0]));
}

TEST(Campaign, MeasuredIsWhatTheInstrumentsShow) {
  auto campaign = small_campaign();
  campaign.rig.sensors.put(plant::gauge(1e3));
  const auto run = run_job(campaign, jobs_of(campaign)[0]);
  const auto table = measured(campaign, run);
  ASSERT_EQ(table.current_mA.size(), 50u);
  const auto& sample = run.recording.samples[49];
  EXPECT_EQ(table.judged().values[49],
            static_cast<double>(sample.counts) * contraction_per_count(campaign.rig));
  EXPECT_EQ(table.find("muscle_pressure")->values[49], sample.shown[plant::Sensed::muscle_pressure]);
  EXPECT_NE(sample.shown[plant::Sensed::muscle_pressure], sample.state.side.muscle_pressure_Pa);
}

domain::Campaign small_pair() {
  domain::Campaign campaign;
  campaign.rig = plant::thesis_pair();
  campaign.rig.sensors.put(plant::gauge());
  controllers::SineCurrent sine;
  sine.low_mA = 6.0;
  sine.high_mA = 16.0;
  controllers::StepCurrent still;
  still.start_mA = 9.0;
  campaign.currents = {{.name = "a", .duration_s = 0.6, .current_1 = sine, .current_2 = still},
                       {.name = "b", .duration_s = 0.6, .current_1 = still, .current_2 = sine}};
  return campaign;
}

TEST(Campaign, APairHasARunForEachPairOfCurrents) {
  auto campaign = small_pair();
  campaign.repeats = 2;
  const auto jobs = jobs_of(campaign);
  ASSERT_EQ(jobs.size(), 4u);
  EXPECT_EQ(jobs[1].id, "a_r2");
  EXPECT_EQ(jobs[2].id, "b_r1");
  EXPECT_EQ(jobs[2].load_kg, 0.0);
}

TEST(Campaign, ExchangedCurrentsTurnAPairTheOtherWay) {
  const auto campaign = small_pair();
  const auto jobs = jobs_of(campaign);
  const auto a = run_job(campaign, jobs[0]), b = run_job(campaign, jobs[1]);
  ASSERT_EQ(a.recording.samples.size(), 50u);
  double most_rad = 0.0;
  for (std::size_t k = 0; k < 50; ++k) {
    const Sample &one = a.recording.samples[k], &other = b.recording.samples[k];
    EXPECT_EQ(one.current_mA, other.opposite.current_mA);
    EXPECT_NEAR(one.angle_rad, -other.angle_rad, 2e-5);
    EXPECT_NEAR(one.shown[plant::Sensed::muscle_pressure],
                other.opposite.shown[plant::Sensed::muscle_pressure], 10.0);
    most_rad = std::max(most_rad, one.angle_rad);
  }
  EXPECT_GT(most_rad, 0.1);
  const EndedRun end = ended(campaign, a);
  EXPECT_NEAR(end.angle_rad.high, most_rad, data::reading_per_count(campaign.rig));
}

TEST(Campaign, EachGaugeOfAPairHasNoiseOfItsOwn) {
  auto campaign = small_pair();
  const auto quiet = run_job(campaign, jobs_of(campaign)[0]);
  campaign.noise.gauge_Pa = 1e3;
  const auto noisy = run_job(campaign, jobs_of(campaign)[0]);
  double squares = 0.0, others = 0.0, together = 0.0;
  for (std::size_t k = 0; k < 50; ++k) {
    const Sample &is = noisy.recording.samples[k], &was = quiet.recording.samples[k];
    EXPECT_EQ(is.state.side.muscle_pressure_Pa, was.state.side.muscle_pressure_Pa);
    const double one = is.shown[plant::Sensed::muscle_pressure] - was.shown[plant::Sensed::muscle_pressure],
                 two = is.opposite.shown[plant::Sensed::muscle_pressure] -
                       was.opposite.shown[plant::Sensed::muscle_pressure];
    squares += one * one / 50.0;
    others += two * two / 50.0;
    together += one * two / 50.0;
  }
  EXPECT_NEAR(std::sqrt(squares), 1e3, 300.0);
  EXPECT_NEAR(std::sqrt(others), 1e3, 300.0);
  EXPECT_LT(std::abs(together), 0.4e6);
}

TEST(Campaign, RunsDoNotDependOnThreads) {
  const auto campaign = small_campaign();
  const auto jobs = jobs_of(campaign);
  std::mutex mutex;
  std::map<std::string, std::vector<double>> one, four;
  for (auto [threads, found] : {std::pair{1u, &one}, std::pair{4u, &four}})
    run_jobs(campaign, jobs, threads, [&](const CampaignRun& run) {
      const std::scoped_lock lock(mutex);
      (*found)[run.job.id] = measured(campaign, run).judged().values;
    });
  EXPECT_EQ(one.size(), 8u);
  EXPECT_EQ(one, four);
}

TEST(Campaign, AFailureIsKeptWithItsRun) {
  auto campaign = small_campaign();
  campaign.rig.muscle.stop_stiffness_N_per_m = 1e3;  // the load falls past the range of the laws
  campaign.rig.muscle.stop_damping_s_per_m = 0.0;
  campaign.loads_kg = {400.0};
  const auto run = run_job(campaign, jobs_of(campaign)[0]);
  EXPECT_NE(run.recording.failure.find("integration failed"), std::string::npos);
}

// In a process of its own: asking to stop cannot be taken back.
TEST(CampaignDeathTest, CtrlCEndsItOnceThoseUnderWayHaveEnded) {
  auto campaign = small_campaign();
  campaign.repeats = 10;
  const int asked_for = 40;
  const auto stopped_early = [&] {
    catch_interrupts();
    int ended = 0;
    const auto finished = [&](const CampaignRun&) {
      if (++ended == 3) std::raise(SIGINT);
    };
    try {
      run_jobs(campaign, jobs_of(campaign), 1, finished);
    } catch (const Interrupted&) {
      std::_Exit(ended);
    }
    std::_Exit(100);
  };
  const auto some = [&](int status) {
    return WIFEXITED(status) && WEXITSTATUS(status) >= 3 && WEXITSTATUS(status) < asked_for;
  };
  EXPECT_EXIT(stopped_early(), some, "");
}

}  // namespace
}  // namespace mckibben::run
