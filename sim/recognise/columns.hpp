// Which column of tables that look alike is what.
#pragma once

#include <vector>

#include <sim/recognise/numbers.hpp>
#include <sim/recognise/recognise.hpp>

namespace mckibben::recognise {

/// The map of tables whose columns have the same names.
MapGuess map_of(const std::vector<const UnknownTable*>& tables);

/// The numbers of a column as they stand in the file; null if there is none of that name.
const Values* column_of(const UnknownTable& table, const std::string& name);

/// What commands the muscle in such tables, or its pressure as an input; null if nothing.
const ColumnGuess* drive_of(const MapGuess& map);

}  // namespace mckibben::recognise
