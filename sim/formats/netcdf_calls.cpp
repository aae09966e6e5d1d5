// See the header.
#include <fmt/format.h>
#include <netcdf.h>

#include <sim/formats/netcdf_calls.hpp>

namespace mckibben::formats::netcdf {

std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

void check(int status) {
  if (status != NC_NOERR)
    throw BadFile(fmt::format("libnetcdf could not make the file: {}", nc_strerror(status)));
}

void put(int file, int variable, const char* name, const std::string& text) {
  check(nc_put_att_text(file, variable, name, text.size(), text.data()));
}

void put(int file, const std::vector<Attribute>& attributes) {
  for (const auto& [name, value] : attributes) {
    if (const auto* number = std::get_if<double>(&value))
      check(nc_put_att_double(file, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, number));
    else
      put(file, NC_GLOBAL, name.c_str(), std::get<std::string>(value));
  }
}

}  // namespace mckibben::formats::netcdf
