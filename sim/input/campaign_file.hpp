// Campaigns in files (schema mckibben-campaign/1). `read_campaign` gives one complete, every default in
// place, or says all that is wrong.
#pragma once

#include <filesystem>
#include <string_view>

#include <sim/domain/campaign.hpp>
#include <sim/input/json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

using domain::Campaign, domain::CampaignCurrent, domain::CampaignWaveform;

inline constexpr std::string_view campaign_schema = "mckibben-campaign/1";

/// Reads a campaign and the rig files and recorded currents that it names; adds warnings. Throws
/// MissingInput; BadInput with the problems of all files.
Campaign read_campaign(const std::filesystem::path& path, std::vector<Problem>* warnings = nullptr);
/// The same from text at hand; relative paths start at the source's folder.
Campaign read_campaign(Source source, std::vector<Problem>* warnings = nullptr);

/// The contents of a campaign file that holds every field.
Json campaign_json(const Campaign& campaign);

}  // namespace mckibben::input
