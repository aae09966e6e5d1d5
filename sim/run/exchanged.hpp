// Columns of two quantities that are each other's, before anything else is said of them.
#pragma once

#include <optional>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::run {

/// Two columns, of one muscle or the commands of two whose gauges were read, with which, exchanged, the rig
/// does what was read, and as they are said it does not: in all runs, or in single ones. Data before they
/// have rows; of others none.
std::optional<data::Finding> exchanged_columns(const domain::Dataset& data);

/// What can hardly be (data::implausible), or only that columns are exchanged: then nothing else is true of
/// them.
std::vector<data::Finding> asked_of(const domain::Dataset& data);

}  // namespace mckibben::run
