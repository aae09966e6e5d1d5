// Data sets whose answer is known: a rig with an effect in it, simulated by the product's own tick loop, read
// with counts and jitter as instruments would, and handed over with the nominal rig beside it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/domain/dataset.hpp>

#include "campaign_runs.hpp"

namespace mckibben::diagnose {

/// A slow sine over the whole range; a staircase; fast triangles. Five seconds each.
inline std::vector<domain::CampaignCurrent> three_kinds() {
  controllers::SineCurrent sine;
  sine.period_s = 2.5;
  controllers::StairCurrent stair;
  stair.steps = 3;
  stair.dwell_s = 0.7;
  controllers::TriangleCurrent triangle;
  triangle.low_mA = 6.0;
  triangle.high_mA = 18.0;
  triangle.speed_mA_per_s = 12.0;
  return {{"sine", 5.0, sine}, {"stair", 5.0, stair}, {"triangle", 5.0, triangle}};
}

inline constexpr plant::Noise still_air{.encoder_jitter = 5e-5, .gauge_Pa = 400.0};

/// Each load under each current, runs r01, r02 and so on (loads in order, for each all currents). With a
/// gauge if `truth` has one. The data set's rig is `nominal`.
inline domain::Dataset planted(const plant::Rig& truth, std::vector<double> loads_kg,
                               std::vector<domain::CampaignCurrent> currents, std::uint64_t seed,
                               const plant::Rig& nominal = {}, const plant::Noise& noise = still_air) {
  domain::Campaign campaign;
  campaign.rig = truth;
  campaign.loads_kg = std::move(loads_kg);
  campaign.currents = std::move(currents);
  campaign.noise = noise;
  campaign.seed = seed;
  domain::Dataset data;
  data.rig = nominal;
  if (const auto* gauge = truth.sensors.of(plant::Sensed::muscle_pressure)) data.rig.sensors.put(*gauge);
  data.path = "planted/dataset.yaml";
  for (const run::CampaignJob& job : run::jobs_of(campaign)) {
    data.runs.push_back(run::measured(campaign, run::run_job(campaign, job)));
    data.runs.back().id = fmt::format("r{:02}", data.runs.size());
    data.runs.back().file = data.runs.back().id + ".csv";
  }
  return data;
}

/// No reading of a data set is left out.
inline std::vector<std::vector<bool>> nothing_masked(const domain::Dataset& data) {
  std::vector<std::vector<bool>> masked;
  for (const auto& run : data.runs) masked.emplace_back(run.rows(), false);
  return masked;
}

/// Six runs of four seconds, enough for a whole diagnosis: three loads, the middle one held out.
inline domain::Dataset small(const plant::Rig& truth, double duration_s = 4.0,
                             const plant::Noise& noise = still_air) {
  auto currents = three_kinds();
  currents.pop_back();
  for (auto& current : currents) current.duration_s = duration_s;
  return planted(truth, {11.138, 16.138, 23.406}, currents, 7, {}, noise);
}

}  // namespace mckibben::diagnose
