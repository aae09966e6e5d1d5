// NetCDF-4 through the C API; see the header. The file is made in memory.
#include <cstdlib>
#include <memory>
#include <mutex>

#include <netcdf.h>
#include <netcdf_mem.h>

#include <sim/formats/netcdf_calls.hpp>
#include <sim/formats/netcdf_file.hpp>

namespace mckibben::formats {
namespace {

using netcdf::check;

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
    netcdf::put(id_, variable, name, text);
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
  const std::lock_guard lock(netcdf::library());
  Making file;
  file.put(NC_GLOBAL, "Conventions", "CF-1.8");
  file.put(NC_GLOBAL, "title", table.title);
  netcdf::put(file.id(), table.attributes);
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
