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
  if (campaign.rig.sensors.of(plant::Sensed::muscle_pressure) != nullptr) table.muscle_pressure_Pa.emplace();
  for (const Sample& sample : run.recording.samples) {
    table.current_mA.push_back(sample.current_mA);
    if (campaign.rig.has_angle())
      table.angle_rad.push_back(sample.read_angle_rad);
    else
      table.contraction_ratio.push_back(static_cast<double>(sample.counts) * per_count);
    if (table.muscle_pressure_Pa)
      table.muscle_pressure_Pa->push_back(sample.shown[plant::Sensed::muscle_pressure]);
    if (campaign.rig.sensors.of(plant::Sensed::force) != nullptr)
      table.force_N.push_back(sample.shown[plant::Sensed::force]);
  }
  return table;
}

}  // namespace mckibben::run
