// NetCDF-4 through the C API; see the header. A table's file is made in memory. Of many runs chunks of HDF5
// are whole pieces, so each is deflated and written once.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <sim/formats/netcdf.hpp>

namespace mckibben::formats {
namespace netcdf {
namespace {

/// The library is not safe in threads (nor is HDF5 below it): whoever calls it holds this.
std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

/// Throws BadFile if a call failed.
void check(int status) {
  if (status != NC_NOERR)
    throw BadFile(fmt::format("libnetcdf could not make the file: {}", nc_strerror(status)));
}

/// A text attribute of a variable, and attributes of the file.
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

}  // namespace
}  // namespace netcdf

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

namespace {

constexpr std::size_t runs_in_long_chunk = 4096;  // of numbers along runs only
// Kept in memory of each variable: the chunk that is being filled, and no more of what was written.
constexpr std::size_t chunks_in_memory = 2;

/// A variable along these dimensions, in chunks.
template <std::size_t N>
int variable(int file, const Column& column, nc_type type, const std::array<int, N>& along,
             const std::array<std::size_t, N>& chunk) {
  int id = 0;
  check(nc_def_var(file, column.name.c_str(), type, N, along.data(), &id));
  check(nc_def_var_chunking(file, id, NC_CHUNKED, chunk.data()));
  std::size_t bytes = type == NC_FLOAT ? sizeof(float) : sizeof(double);
  for (const std::size_t length : chunk) bytes *= length;
  check(nc_set_var_chunk_cache(file, id, chunks_in_memory * bytes, chunks_in_memory, 1.0F));
  netcdf::put(file, id, "units", column.unit);
  netcdf::put(file, id, "long_name", column.meaning);
  return id;
}

}  // namespace

NetcdfRuns::NetcdfRuns(const std::filesystem::path& path, const RunsLayout& layout)
    : rows_(layout.time_s.size()) {
  const std::lock_guard lock(netcdf::library());
  check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
  try {
    define(layout);
  } catch (const BadFile&) {
    nc_abort(std::exchange(id_, -1));
    throw;
  }
}

void NetcdfRuns::define(const RunsLayout& layout) {
  netcdf::put(id_, NC_GLOBAL, "Conventions", "CF-1.8");
  netcdf::put(id_, NC_GLOBAL, "title", layout.title);
  netcdf::put(id_, layout.attributes);
  int run = 0, time = 0, times = 0;
  check(nc_def_dim(id_, "run", layout.runs, &run));
  const std::size_t in_long_chunk = std::min(layout.runs, runs_in_long_chunk);
  for (const Column& column : layout.of_run)
    of_run_.push_back(variable<1>(id_, column, NC_DOUBLE, {run}, {in_long_chunk}));
  if (rows_ > 0) {
    check(nc_def_dim(id_, "time", rows_, &time));
    check(nc_def_var(id_, "time", NC_DOUBLE, 1, &time, &times));
    netcdf::put(id_, times, "units", "s");
    netcdf::put(id_, times, "long_name", "time since the run began");
    for (const Column& column : layout.of_row) {
      of_row_.push_back(
          variable<2>(id_, column, NC_FLOAT, {run, time}, {std::min(layout.runs, layout.in_chunk), rows_}));
      check(nc_def_var_deflate(id_, of_row_.back(), 1, 1, 1));
    }
  }
  check(nc_enddef(id_));
  if (rows_ > 0) check(nc_put_var_double(id_, times, layout.time_s.data()));
}

NetcdfRuns::~NetcdfRuns() {
  const std::lock_guard lock(netcdf::library());
  if (id_ >= 0) nc_abort(id_);
}

void NetcdfRuns::put_of_run(std::size_t k, std::span<const double> values) {
  const std::lock_guard lock(netcdf::library());
  const std::size_t start = first_, count = values.size();
  check(nc_put_vara_double(id_, of_run_[k], &start, &count, values.data()));
}

void NetcdfRuns::put_of_row(std::size_t k, std::span<const float> values) {
  const std::lock_guard lock(netcdf::library());
  const std::array<std::size_t, 2> start{first_, 0}, count{values.size() / rows_, rows_};
  check(nc_put_vara_float(id_, of_row_[k], start.data(), count.data(), values.data()));
}

void NetcdfRuns::close() {
  const std::lock_guard lock(netcdf::library());
  check(nc_close(std::exchange(id_, -1)));
}

}  // namespace mckibben::formats
