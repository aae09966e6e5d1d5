// What the thesis's whole campaign costs on one core, without files: simulated seconds for each second of the
// clock, against the aim of 1500.
#include <algorithm>
#include <chrono>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <sim/input/campaign_file.hpp>
#include <sim/run/campaign.hpp>

namespace mckibben::run {
namespace {

constexpr double aim = 1500.0;

void thesis_campaign(benchmark::State& state) {
  const auto campaign = input::read_campaign(MCKIBBEN_SOURCE_DIR "/scenarios/thesis_campaign.yaml");
  const auto jobs = jobs_of(campaign);
  double best_s = 1e9, simulated_s = 0.0;
  for (auto _ : state) {
    simulated_s = 0.0;
    const auto start = std::chrono::steady_clock::now();
    for (const auto& job : jobs)
      simulated_s +=
          static_cast<double>(run_job(campaign, job).recording.samples.size()) * campaign.rig.tick_s;
    const double cost_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best_s = std::min(best_s, cost_s);
    state.SetIterationTime(cost_s);
  }
  state.counters["simulated_s"] = simulated_s;
  state.counters["times_real_time"] = simulated_s / best_s;
  state.SetLabel(fmt::format("{} runs; best {:.2f} s; 1/{:.0f} of the simulated time is {:.2f} s",
                             jobs.size(), best_s, aim, simulated_s / aim));
}

BENCHMARK(thesis_campaign)
    ->Name("thesis_campaign/one_core")
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace mckibben::run
