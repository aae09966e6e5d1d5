// Jobs of a campaign; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/run/batch.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {

std::vector<CampaignJob> jobs_of(const domain::Campaign& campaign) {
  const auto digits = [](std::size_t count) { return std::to_string(count).size(); };
  const std::size_t load_digits = digits(campaign.loads_kg.size());
  const std::size_t repeat_digits = digits(static_cast<std::size_t>(campaign.repeats));
  std::vector<CampaignJob> jobs;
  for (std::size_t load = 0; load < campaign.loads_kg.size(); ++load)
    for (std::size_t current = 0; current < campaign.currents.size(); ++current)
      for (int repeat = 1; repeat <= campaign.repeats; ++repeat) {
        std::string id = fmt::format("m{:0{}}_{}", load + 1, load_digits, campaign.currents[current].name);
        if (campaign.repeats > 1) id += fmt::format("_r{:0{}}", repeat, repeat_digits);
        jobs.push_back({std::move(id), campaign.loads_kg[load], current, repeat, jobs.size() + 1});
      }
  return jobs;
}

CampaignRun run_job(const domain::Campaign& campaign, const CampaignJob& job) {
  const domain::CampaignCurrent& current = campaign.currents[job.current];
  CampaignRun run{.job = job};
  const auto controller = std::visit(
      [&](const auto& waveform) { return waveform.make(knowledge_of(campaign.rig, {})); }, current.current);
  run.recording =
      simulate({.rig = campaign.rig,
                .load_kg = job.load_kg,
                .ticks = static_cast<std::size_t>(std::llround(current.duration_s / campaign.rig.tick_s)),
                .engine = campaign.rig.integrator,
                .noise = campaign.noise,
                .seed = campaign.seed,
                .stream = job.stream},
               *controller);
  run.failure = run.recording.failure;
  return run;
}

void run_jobs(const domain::Campaign& campaign, std::span<const CampaignJob> jobs, unsigned threads,
              const std::function<void(const CampaignRun&)>& finished, const ProgressHook& progress) {
  for_each_job(
      jobs.size(), threads, [&](std::size_t i) { finished(run_job(campaign, jobs[i])); },
      [&](std::size_t done) { progress("simulating", done, jobs.size()); });
}

domain::Run measured(const domain::Campaign& campaign, const CampaignRun& run) {
  domain::Run table;
  table.id = run.job.id;
  table.file = run.job.id + ".csv";
  table.load_kg = run.job.load_kg;
  const double per_count = contraction_per_count(campaign.rig);
  if (campaign.rig.gauge.fitted) table.muscle_pressure_Pa.emplace();
  for (const Sample& sample : run.recording.samples) {
    table.current_mA.push_back(sample.current_mA);
    table.contraction_ratio.push_back(static_cast<double>(sample.counts) * per_count);
    if (table.muscle_pressure_Pa) table.muscle_pressure_Pa->push_back(sample.gauge_Pa);
  }
  return table;
}

}  // namespace mckibben::run
