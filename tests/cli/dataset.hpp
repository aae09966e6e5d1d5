// A small campaign, begun and made with the verb dataset: what its tests share.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/output/campaign_folder.hpp>

#include "campaign_runs.hpp"
#include "program.hpp"

namespace mckibben::cli {

namespace fs = std::filesystem;

inline constexpr const char* small_campaign =
    "schema: mckibben-campaign/1\n"
    "rig: {gauge: {fitted: true}}\n"
    "loads: [11.138 kg, 23.406 kg]\n"
    "currents:\n"
    "  - {duration: 2.4 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}\n"
    "  - {name: up, duration: 1.2 s, current: {kind: step_current, start: 4 mA, "
    "moves: [{at: 0.3 s, to: 14 mA}]}}\n"
    "repeats: 2\n"
    "noise: {encoder_jitter: 1e-4, gauge: 4 mbar}\n";

/// Leaves OUT.unfinished as a campaign does that was stopped after `runs` runs.
inline void begin(const fs::path& out, const domain::Campaign& campaign, std::size_t runs,
                  const std::vector<std::string>& formats = {}) {
  const output::CampaignFolder folder(out, campaign, formats, [](const std::string&) {});
  run::run_jobs(campaign, std::span(folder.jobs()).first(runs), 1, [&](const auto& run) { folder.put(run); });
}

class Dataset : public InAFolder {
 protected:
  void SetUp() override { write_text(scratch / "small.yaml", small_campaign); }
  bool exists(const std::string& name) { return fs::exists(scratch / name); }
};

}  // namespace mckibben::cli
