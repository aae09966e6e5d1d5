// Given currents to the valves of a pair.
#pragma once

#include <memory>

#include <controllers/controller.hpp>
#include <sim/domain/campaign.hpp>

namespace mckibben::run {

/// Plays both as the rig's DAC gives them; a recording is what it gave.
std::unique_ptr<controllers::Controller> play(const domain::CampaignWaveform& current_1,
                                              const domain::CampaignWaveform& current_2,
                                              const plant::Rig& rig);

}  // namespace mckibben::run
