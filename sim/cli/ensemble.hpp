// What `dataset` does with a campaign that draws its rigs.
#pragma once

#include <sim/cli/options.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/run/ensemble.hpp>

namespace mckibben::cli {

int make_ensemble(const Options& options, const domain::Campaign& campaign, run::Keep keep);

}  // namespace mckibben::cli
