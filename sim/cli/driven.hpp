// What `run` and `replay` do where no controller drives one muscle under a load: pairs under given currents,
// and data with a clock of their own.
#pragma once

#include <string>
#include <vector>

#include <sim/cli/options.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::cli {

/// `formats`: of runs, besides CSV.
int run_pair(const Options& options, const std::string& path, const std::vector<std::string>& formats);
int replay_stamped(const Options& options, const std::string& path, const domain::Dataset& dataset,
                   const std::vector<std::string>& formats);

}  // namespace mckibben::cli
