// NetCDF-4 through the C API; see the header. The library is not safe in threads (nor is HDF5 below it), so
// calls are serialised. The file is made in memory.
#include <cstdlib>
#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <sim/formats/netcdf_file.hpp>

namespace mckibben::formats {
namespace {

void check(int status) {
  if (status != NC_NOERR)
    throw BadFile(fmt::format("libnetcdf could not make the file: {}", nc_strerror(status)));
}

/// A file that is being made; given up unless it is finished.
class Making {
 public:
  Making() { check(nc_create_mem("run.nc", NC_NETCDF4, 0, &id_)); }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;
  ~Making() {
    if (!finished_) nc_abort(id_);
  }
  int id() const { return id_; }

  void put(int variable, const char* name, const std::string& text) const {
    check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
  }

  std::string finish() {
    NC_memio memory{};
    finished_ = true;
    check(nc_close_memio(id_, &memory));
    const std::unique_ptr<void, void (*)(void*)> owner(memory.memory, std::free);
    return {static_cast<const char*>(memory.memory), memory.size};
  }

 private:
  int id_ = 0;
  bool finished_ = false;
};

}  // namespace

std::string netcdf_of(const Table& table) {
  static std::mutex library;
  const std::lock_guard lock(library);
  Making file;
  file.put(NC_GLOBAL, "Conventions", "CF-1.8");
  file.put(NC_GLOBAL, "title", table.title);
  for (const auto& [name, value] : table.attributes) {
    if (const auto* number = std::get_if<double>(&value))
      check(nc_put_att_double(file.id(), NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, number));
    else
      file.put(NC_GLOBAL, name.c_str(), std::get<std::string>(value));
  }
  int dimension = 0;
  const std::string& along = table.columns.front().name;
  check(nc_def_dim(file.id(), along.c_str(), table.columns.front().values.size(), &dimension));
  std::vector<int> variables(table.columns.size());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Column& column = table.columns[i];
    check(nc_def_var(file.id(), column.name.c_str(), NC_DOUBLE, 1, &dimension, &variables[i]));
    file.put(variables[i], "units", column.unit);
    file.put(variables[i], "long_name", column.meaning);
  }
  check(nc_enddef(file.id()));
  for (std::size_t i = 0; i < variables.size(); ++i)
    check(nc_put_var_double(file.id(), variables[i], table.columns[i].values.data()));
  return file.finish();
}

}  // namespace mckibben::formats
