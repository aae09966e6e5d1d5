// LabVIEW Measurement files (.lvm), after National Instruments' specification of versions 1 and 2: a header,
// then segments, each with a header of its own, a row of channel names, and rows with a tab (or a comma)
// between the cells and perhaps a remark at the end.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <sim/input/table.hpp>

namespace mckibben::input {

/// Reads the wanted channels. `in_file` is a channel's name, or its column's number from 1; left empty, it is
/// the time of the other channels: their X column, or X0 and Delta_X where there is none. `segment`: which
/// one, from 1; 0 for all of them, one after the other.
Table read_lvm(const Source& source, std::span<const WantedColumn> wanted, std::size_t segment,
               TableProblems& problems);

/// The channels of the first segment, without those of time and of remarks; none if it cannot be read.
std::vector<std::string> lvm_channels(const Source& source);

}  // namespace mckibben::input
