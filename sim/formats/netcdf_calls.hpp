// Calls of libnetcdf that both writers make. The library is not safe in threads (nor is HDF5 below it), so
// whoever calls it holds `library`.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include <sim/formats/table.hpp>

namespace mckibben::formats::netcdf {

std::mutex& library();

/// Throws BadFile if a call failed.
void check(int status);

/// A text attribute of a variable, and attributes of the file.
void put(int file, int variable, const char* name, const std::string& text);
void put(int file, const std::vector<Attribute>& attributes);

}  // namespace mckibben::formats::netcdf
