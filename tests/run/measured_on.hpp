// Data that a rig makes, and what is said of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/data/plausible.hpp>
#include <sim/run/look.hpp>

#include "campaign_runs.hpp"

namespace mckibben::run {

/// Three loads under a sine and a staircase, counted; the data set's rig is the nominal one.
inline domain::Dataset measured_on(const plant::Rig& truth,
                                   std::vector<double> loads_kg = {11.138, 16.138, 23.406},
                                   const plant::Rig& nominal = {}) {
  controllers::SineCurrent sine;
  sine.low_mA = 0.0;
  sine.period_s = 2.5;
  controllers::StairCurrent stair;
  stair.steps = 3;
  stair.dwell_s = 0.5;
  domain::Campaign campaign;
  campaign.rig = truth;
  campaign.loads_kg = std::move(loads_kg);
  campaign.currents = {{"sine", 3.0, sine}, {"stair", 3.0, stair}};
  campaign.noise = {.encoder_jitter = 5e-5, .gauge_Pa = 400.0};
  domain::Dataset data;
  data.path = "measured/dataset.yaml";
  data.rig = nominal;
  if (const auto* gauge = truth.sensors.of(plant::Sensed::muscle_pressure)) data.rig.sensors.put(*gauge);
  for (const CampaignJob& job : jobs_of(campaign)) {
    data.runs.push_back(measured(campaign, run_job(campaign, job)));
    data.runs.back().id = fmt::format("r{:02}", data.runs.size());
  }
  return data;
}

inline const domain::Dataset& sound() {
  static const domain::Dataset data = [] {
    plant::Rig rig;
    rig.sensors.put(plant::gauge());
    return measured_on(rig);
  }();
  return data;
}

inline std::vector<std::string> said(const domain::Dataset& data) {
  std::vector<std::string> list;
  for (const auto& one : look(data).findings)
    if (!data::only_limits_diagnosis(one)) list.emplace_back(data::UnfitData(data, {one}).what());
  return list;
}

/// The only thing that is said.
inline std::string says(const domain::Dataset& data) {
  const auto list = said(data);
  EXPECT_EQ(list.size(), 1u);
  return list.empty() ? "" : list.front();
}

}  // namespace mckibben::run
