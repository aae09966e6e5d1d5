// NetCDF-4 files, written with Unidata's library: a table each; or many runs in one, written in chunks as
// they come, so that it may be larger than the memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <sim/formats/table.hpp>

namespace mckibben::formats {

/// What such a file holds: variables along `run`, and others along `run` and `time`. Values of the columns do
/// not matter.
struct RunsLayout {
  std::string title;
  std::vector<Attribute> attributes;
  std::size_t runs = 0, in_chunk = 1;  ///< runs that are written at once
  std::vector<double> time_s;          ///< of the rows; empty if there are none
  std::vector<Column> of_run, of_row;
};

/// Written in the same pieces, the same numbers give the same bytes. Numbers of rows are kept as floats,
/// shuffled and deflated. Safe beside other writers of NetCDF. Throws BadFile, and what was written then is
/// no file.
class NetcdfRuns {
 public:
  NetcdfRuns(const std::filesystem::path& path, const RunsLayout& layout);
  NetcdfRuns(const NetcdfRuns&) = delete;
  NetcdfRuns& operator=(const NetcdfRuns&) = delete;

  /// Column k of the next `count` runs: of each a number, or its rows one run after the other.
  void put_of_run(std::size_t k, std::span<const double> values);
  void put_of_row(std::size_t k, std::span<const float> values);
  /// The next runs begin after these.
  void next(std::size_t count) { first_ += count; }

  /// All of it is in the file.
  void finish();

 private:
  void define(const RunsLayout& layout);

  std::string path_;
  int id_ = 0;
  std::size_t first_ = 0, rows_;
  std::vector<int> of_run_, of_row_;
};

/// A NetCDF-4 file (CF-1.8) with a variable for each column, all along the first one, each with `units` and
/// `long_name`; title and attributes are global attributes. The same table gives the same bytes. Safe to call
/// from several threads. Throws BadFile.
std::string netcdf_of(const Table& table);

}  // namespace mckibben::formats
