// Runs of a campaign in memory, without its folder, and what instruments would have recorded of them.
#pragma once

#include <functional>
#include <span>
#include <utility>

#include <sim/domain/campaign.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {

/// One of them by itself.
inline CampaignRun run_job(const domain::Campaign& campaign, const CampaignJob& job) {
  const Order order = order_of(campaign, job);
  return {job, simulate(order.plan, *order.controller)};
}

/// Side by side, as the verb dataset makes them. `finished` is given each as it ends, from any thread.
inline void run_jobs(const domain::Campaign& campaign, std::span<const CampaignJob> jobs, unsigned threads,
                     const std::function<void(const CampaignRun&)>& finished) {
  const auto sorted = longest_first(campaign, jobs);
  simulate_all(
      sorted.size(), threads, [&](std::size_t i) { return order_of(campaign, sorted[i]); },
      [&](std::size_t i, Recording recording) {
        finished({sorted[i], std::move(recording)});
      });
}

/// What was measured in a run of one muscle: currents, counted contraction ratios, pressures if the rig has a
/// gauge.
inline domain::Run measured(const domain::Campaign& campaign, const CampaignRun& run) {
  domain::Run table;
  table.id = run.job.id;
  table.file = run.job.id + ".csv";
  table.load_kg = run.job.load_kg;
  const double per_count = contraction_per_count(campaign.rig);
  const bool angle = campaign.rig.has_angle();
  std::vector<double>& position = table.read(angle ? "angle" : "contraction").values;
  for (const Sample& sample : run.recording.samples) {
    table.current_mA.push_back(sample.current_mA);
    position.push_back(angle ? sample.read_angle_rad : static_cast<double>(sample.counts) * per_count);
  }
  for (const plant::Sensed beside : {plant::Sensed::muscle_pressure, plant::Sensed::force}) {
    if (campaign.rig.sensors.of(beside) == nullptr) continue;
    std::vector<double>& read = table.read(name_of(beside)).values;
    for (const Sample& sample : run.recording.samples) read.push_back(sample.shown[beside]);
  }
  return table;
}

}  // namespace mckibben::run
