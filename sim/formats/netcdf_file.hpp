// NetCDF-4 files, written with Unidata's library.
#pragma once

#include <string>

#include <sim/formats/table.hpp>

namespace mckibben::formats {

/// A NetCDF-4 file (CF-1.8) with a variable for each column, all along the first one, each with `units` and
/// `long_name`; title and attributes are global attributes. The same table gives the same bytes. Safe to call
/// from several threads. Throws BadFile.
std::string netcdf_of(const Table& table);

}  // namespace mckibben::formats
