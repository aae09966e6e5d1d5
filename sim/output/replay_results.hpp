// Results of a replay, as JSON and as text.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::output {

/// The run.json of a results folder, and what --json prints. Holds nothing that differs between two runs of
/// the same input.
std::string json_of(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                    const std::vector<std::string>& warnings);

/// What is printed, and table.txt.
std::string table_of(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                     const std::vector<std::string>& warnings);

/// Whether it is of the load's height, which is told in millimetres.
inline bool is_height(const run::Gap& gap) {
  return gap.reading == "contraction";
}

/// A gap's numbers with as many digits as it deserves.
std::string gap_number(double value, bool sign = false);

}  // namespace mckibben::output
