// NetCDF-4 through the C API; see the header. A table's file is made in memory. Of many runs chunks of HDF5
// are whole pieces, so each is deflated and written once.
//
// Where a disk is full, libnetcdf 4.9 and HDF5 1.10 crash: in nc_close, nc_abort and an exit handler. So a
// file on disk is synchronised and then closed below libnetcdf; one that failed is left as it is, and its
// memory goes with the program.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <sim/formats/netcdf.hpp>

namespace mckibben::formats {
namespace netcdf {
namespace {

/// The library is not safe in threads (nor is HDF5 below it): whoever calls it holds this.
std::mutex& library() {
  static std::mutex mutex;
  [[maybe_unused]] static const herr_t no_exit_handler = H5dont_atexit();
  return mutex;
}

/// Throws BadFile if a call failed, with what the system objected to where that is known.
void check(int status) {
  if (status != NC_NOERR)
    throw BadFile(fmt::format("libnetcdf: {}", errno != 0 ? std::strerror(errno) : nc_strerror(status)));
}

/// To be held for each piece of work.
class Alone {
 public:
  Alone() : lock_(library()) { errno = 0; }

 private:
  std::lock_guard<std::mutex> lock_;
};

/// What is open of these kinds: of a file, or of all.
std::vector<hid_t> open_in(hid_t file, unsigned kinds) {
  std::vector<hid_t> ids(static_cast<std::size_t>(std::max<ssize_t>(0, H5Fget_obj_count(file, kinds))));
  H5Fget_obj_ids(file, kinds, ids.size(), ids.data());
  return ids;
}

/// Closes a file, and first what is open of it. libnetcdf must not be asked for it again.
bool close_file(const std::string& path) {
  for (const hid_t file : open_in(H5F_OBJ_ALL, H5F_OBJ_FILE)) {
    std::string name(path.size() + 1, '\0');
    if (H5Fget_name(file, name.data(), name.size()) != static_cast<ssize_t>(path.size()) ||
        name.c_str() != path)
      continue;
    for (const hid_t object : open_in(file, H5F_OBJ_ALL & ~H5F_OBJ_FILE))
      while (H5Iis_valid(object) > 0 && H5Idec_ref(object) > 0) continue;
    return H5Fclose(file) >= 0;
  }
  return false;
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
  const netcdf::Alone alone;
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
    : path_(path.string()), rows_(layout.time_s.size()) {
  const netcdf::Alone alone;
  check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
  define(layout);
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

void NetcdfRuns::put_of_run(std::size_t k, std::span<const double> values) {
  const netcdf::Alone alone;
  const std::size_t start = first_, count = values.size();
  check(nc_put_vara_double(id_, of_run_[k], &start, &count, values.data()));
}

void NetcdfRuns::put_of_row(std::size_t k, std::span<const float> values) {
  const netcdf::Alone alone;
  const std::array<std::size_t, 2> start{first_, 0}, count{values.size() / rows_, rows_};
  check(nc_put_vara_float(id_, of_row_[k], start.data(), count.data(), values.data()));
}

void NetcdfRuns::finish() {
  const netcdf::Alone alone;
  check(nc_sync(id_));
  if (!netcdf::close_file(path_)) check(NC_EHDFERR);
}

}  // namespace mckibben::formats
