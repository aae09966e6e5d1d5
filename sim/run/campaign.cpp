// Jobs of a campaign; see the header.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <sim/data/warnings.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/draws.hpp>
#include <sim/run/two_currents.hpp>

namespace mckibben::run {

std::size_t count_of_jobs(const domain::Campaign& campaign) {
  const std::size_t loads = campaign.rig.pair() != nullptr ? 1 : campaign.loads_kg.size();
  return loads * campaign.currents.size() * static_cast<std::size_t>(campaign.repeats);
}

CampaignJob job_of(const domain::Campaign& campaign, std::size_t place) {
  const auto digits = [](std::size_t count) { return std::to_string(count).size(); };
  const auto repeats = static_cast<std::size_t>(campaign.repeats);
  CampaignJob job{.id = {},
                  .current = place / repeats % campaign.currents.size(),
                  .repeat = static_cast<int>(place % repeats) + 1,
                  .stream = place + 1};
  job.id = campaign.currents[job.current].name;
  if (campaign.rig.pair() == nullptr) {
    const std::size_t load = place / repeats / campaign.currents.size();
    job.load_kg = campaign.loads_kg[load];
    job.id = fmt::format("m{:0{}}_{}", load + 1, digits(campaign.loads_kg.size()), job.id);
  }
  if (repeats > 1) job.id += fmt::format("_r{:0{}}", job.repeat, digits(repeats));
  return job;
}

std::vector<CampaignJob> jobs_of(const domain::Campaign& campaign) {
  std::vector<CampaignJob> jobs(count_of_jobs(campaign));
  for (std::size_t i = 0; i < jobs.size(); ++i) jobs[i] = job_of(campaign, i);
  return jobs;
}

std::vector<CampaignJob> longest_first(const domain::Campaign& campaign, std::span<const CampaignJob> jobs) {
  std::vector<CampaignJob> sorted(jobs.begin(), jobs.end());
  std::ranges::stable_sort(sorted, std::greater(),
                           [&](const CampaignJob& job) { return campaign.currents[job.current].duration_s; });
  return sorted;
}

Order order_of(const domain::Campaign& campaign, const CampaignJob& job) {
  const domain::CampaignCurrent& current = campaign.currents[job.current];
  Order order{
      .plan = {.rig = drawn_rig(campaign, job.repeat),
               .load_kg = job.load_kg,
               .ticks = static_cast<std::size_t>(std::llround(current.duration_s / campaign.rig.tick_s)),
               .noise = campaign.noise,
               .seed = campaign.seed,
               .stream = job.stream},
      .controller = nullptr};
  if (campaign.rig.pair() != nullptr) {
    order.controller = play(*current.current_1, *current.current_2, campaign.rig);
  } else {
    order.controller =
        std::visit([&](const auto& waveform) { return waveform.make(knowledge_of(campaign.rig, {})); },
                   *current.current);
  }
  return order;
}

EndedRun ended(const domain::Campaign& campaign, const CampaignRun& run) {
  if (!run.recording.failure.empty()) return {run.job, run.recording.failure};
  const auto& samples = run.recording.samples;
  EndedRun end{.job = run.job, .rows = samples.size(), .solver = run.recording.solver};
  if (campaign.rig.has_angle()) {
    end.angle_rad = span_of(samples, [](const Sample& row) { return row.read_angle_rad; });
    end.doubts = doubts(run.recording);
  } else {
    end.largest_contraction_ratio =
        contraction_per_count(campaign.rig) *
        span_of(samples, [](const Sample& row) { return static_cast<double>(row.counts); }).high;
  }
  return end;
}

std::vector<std::string> warnings_of(const std::vector<EndedRun>& runs) {
  std::vector<std::string> all;
  for (const EndedRun& run : runs)
    for (const std::string& doubt : run.doubts) all.push_back(data::warning_of_run(run.job.id, doubt));
  return data::grouped(all);
}

}  // namespace mckibben::run
