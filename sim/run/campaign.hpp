// The runs of a campaign: every load, or the pair, under every current, repeated, each with noise of its own;
// and what the instruments would have recorded of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {

/// One run that a campaign asks for.
struct CampaignJob {
  /// m<load>_<current>, with repeats m<load>_<current>_r<repeat>; loads and repeats from 1. Of a pair without
  /// the load.
  std::string id;
  double load_kg = 0.0;     ///< 0 of a pair
  std::size_t current = 0;  ///< place in the campaign's list
  int repeat = 1;
  std::uint64_t stream = 0;  ///< of its noise
};

/// One run that was made.
struct CampaignRun {
  CampaignJob job;
  Recording recording{};
};

/// What is kept of a run whose rows are on disk.
struct EndedRun {
  CampaignJob job;
  std::string failure{};  ///< as in Recording; then there is nothing else
  std::size_t rows = 0;
  double largest_contraction_ratio = 0.0;  ///< as counted; of one muscle
  Span angle_rad{};                        ///< as counted; of a pair
  engine::Counters solver{};
  std::vector<std::string> doubts{};  ///< of a pair: of what was simulated (run::doubts)
};

/// All runs of a campaign: loads in order, for each all currents, for each all repeats. Ids are unique.
std::vector<CampaignJob> jobs_of(const domain::Campaign& campaign);
/// The same jobs in the order in which they leave the fewest places empty at the end.
std::vector<CampaignJob> longest_first(const domain::Campaign& campaign, std::span<const CampaignJob> jobs);

/// How many there are, and one of them by its place: 0, 1, ...
std::size_t count_of_jobs(const domain::Campaign& campaign);
CampaignJob job_of(const domain::Campaign& campaign, std::size_t place);

/// What is to be simulated for a job, and what drives it.
Order order_of(const domain::Campaign& campaign, const CampaignJob& job);

EndedRun ended(const domain::Campaign& campaign, const CampaignRun& run);

/// What should not be believed of the runs, in words.
std::vector<std::string> warnings_of(const std::vector<EndedRun>& runs);

}  // namespace mckibben::run
