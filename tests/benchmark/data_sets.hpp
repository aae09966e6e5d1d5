// Which data sets a suite of the benchmark diagnoses.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hidden_effects.hpp"

namespace mckibben::diagnose {

struct DataSet {
  std::size_t kind = 0;
  std::uint64_t seed = 0;
  Surroundings surroundings{};
  bool advised = false;  ///< its advice is followed
};

std::string_view name_of(Bench bench);

/// What has a title that begins so, on one bench after another, as far off its data sheet as this says of
/// itself.
std::vector<DataSet> all_sets(std::uint64_t first, std::uint64_t seeds, const std::string& wanted);

/// Those in which nothing is hidden, on each bench, and on one that is off its data sheet.
std::vector<DataSet> nulls(std::uint64_t first, std::uint64_t seeds, const std::string& wanted);

/// Small effects made weaker or twice as large, and what has no name, in few runs.
std::vector<DataSet> weak_ones(std::uint64_t first, std::uint64_t seeds, const std::string& wanted);

/// Every kind on rigs of other sizes that are far off their sheets.
std::vector<DataSet> off_sheet(std::uint64_t first, std::uint64_t seeds, const std::string& wanted);

/// Nothing or a plain effect, beside each law that no catalogue has.
std::vector<DataSet> other_laws(std::uint64_t first, std::uint64_t seeds, const std::string& wanted);

/// So many data sets in which names may be open: little of an effect that has relatives (docs/effects.md), in
/// three or four short sines.
std::vector<DataSet> open_ones(std::uint64_t first, std::size_t count);

}  // namespace mckibben::diagnose
