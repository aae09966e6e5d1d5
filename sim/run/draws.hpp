// What is drawn for each repeat of a campaign. A draw depends on the seed, the repeat and the place of the
// number in `vary`, and on nothing else: not on threads, not on other draws; none is kept.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>

namespace mckibben::run {

/// The numbers of repeat 1, 2, ... of so many [SI], in the order of `variation`.
std::vector<double> draws(const domain::Variation& variation, std::uint64_t seed, int repeats, int repeat);
std::vector<double> draws(const domain::Campaign& campaign, int repeat);

/// A rig with these numbers.
plant::Rig with_numbers(plant::Rig rig, const domain::Variation& variation,
                        const std::vector<double>& values);
/// The campaign's rig with its own.
plant::Rig drawn_rig(const domain::Campaign& campaign, int repeat);

/// Why a run on this rig means nothing: a rule between its numbers that they break, or a load that its taut
/// threads cannot bear; empty if none.
std::string unfit(const plant::Rig& rig, double load_kg);

/// Where `value` of 0 ... count - 1 goes in a permutation that `key` stands for.
std::uint64_t permuted(std::uint64_t value, std::uint64_t count, std::uint64_t key);

/// The x below which a standard normal number lies with this probability, between 0 and 1.
double normal_quantile(double probability);

}  // namespace mckibben::run
