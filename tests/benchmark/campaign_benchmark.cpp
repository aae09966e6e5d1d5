// What the thesis's whole campaign costs on one core, without files: simulated seconds for each second of the
// clock, against the aim of 1500.
#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <sim/input/campaign_file.hpp>

#include "campaign_runs.hpp"

namespace mckibben::run {
namespace {

constexpr double aim = 1500.0;

/// Simulates the jobs; returns the simulated time [s].
using Simulate = std::function<double(const domain::Campaign&, const std::vector<CampaignJob>&)>;

double simulated_s(const domain::Campaign& campaign, const CampaignRun& run) {
  return static_cast<double>(run.recording.samples.size()) * campaign.rig.tick_s;
}

double one_by_one(const domain::Campaign& campaign, const std::vector<CampaignJob>& jobs) {
  double sum_s = 0.0;
  for (const auto& job : jobs) sum_s += simulated_s(campaign, run_job(campaign, job));
  return sum_s;
}

double side_by_side(const domain::Campaign& campaign, const std::vector<CampaignJob>& jobs) {
  double sum_s = 0.0;
  run_jobs(campaign, jobs, 1, [&](const CampaignRun& run) { sum_s += simulated_s(campaign, run); });
  return sum_s;
}

void thesis_campaign(benchmark::State& state, const Simulate& simulate) {
  const auto campaign = input::read_campaign(MCKIBBEN_SOURCE_DIR "/scenarios/thesis_campaign.yaml");
  const auto jobs = jobs_of(campaign);
  double best_s = 1e9, sum_s = 0.0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    sum_s = simulate(campaign, jobs);
    const double cost_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best_s = std::min(best_s, cost_s);
    state.SetIterationTime(cost_s);
  }
  state.counters["simulated_s"] = sum_s;
  state.counters["times_real_time"] = sum_s / best_s;
  state.SetLabel(fmt::format("{} runs; best {:.2f} s; 1/{:.0f} of the simulated time is {:.2f} s",
                             jobs.size(), best_s, aim, sum_s / aim));
}

BENCHMARK_CAPTURE(thesis_campaign, one_by_one, one_by_one)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(thesis_campaign, side_by_side, side_by_side)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace mckibben::run
