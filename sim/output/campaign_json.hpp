// A campaign's documents: what stands in its folders as JSON, or as YAML made of it.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/run/campaign.hpp>

namespace mckibben::output {

/// Of everything that the bytes of its runs depend on, but for the program.
std::string digest_of(const domain::Campaign& campaign);

/// A run's entry in campaign.json, and the run of a job whose entry was written.
input::Json entry_json(const domain::Campaign& campaign, const run::EndedRun& run);
run::EndedRun ended_run(const run::CampaignJob& job, const input::Json& entry);

/// What dataset.yaml says of the columns of measured tables. A load cell or a second muscle makes a data set
/// one with a clock of its own, whose contraction or angle says that it is counted; else there is nothing to
/// say.
input::Json columns_json(const plant::Rig& rig);

/// dataset.yaml, on a rig that is given by its name or path.
input::Json dataset_json(const plant::Rig& rig, const std::string& name,
                         const std::vector<run::EndedRun>& runs);

/// truth.yaml: what the data set's owner does not know.
input::Json truth_json(const domain::Campaign& campaign, const std::vector<run::EndedRun>& runs);

}  // namespace mckibben::output
