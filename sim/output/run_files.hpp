// The files of runs, in the formats that are asked for, and `datapackage.json`, which says what their columns
// are (Frictionless Data, Tabular Data Package 1).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <sim/formats/table.hpp>

namespace mckibben::output {

/// CSV is always written: what else reads our folders (replay, diff, the report) reads that.
inline constexpr std::array<std::string_view, 3> run_formats{"csv", "mat", "netcdf"};

struct NamedFile {
  std::string name, content;
};

/// One run as STEM.csv, and STEM.mat and STEM.nc if these formats are asked for. Throws formats::BadFile.
std::vector<NamedFile> run_files(const std::string& stem, const formats::Table& table,
                                 const std::vector<std::string>& formats);

/// Every name that run_files can give.
std::vector<std::string> run_file_names(const std::string& stem);

/// A title, and for each run its stem and what it holds in words. Values of columns do not matter.
struct Package {
  struct Run {
    std::string stem, title;
    std::vector<formats::Column> columns{};  ///< its own; none: those of every run
  };
  std::string title;
  std::vector<formats::Column> columns;  ///< of every run that has none of its own
  std::vector<Run> runs;
};

inline constexpr const char* package_file = "datapackage.json";
std::string datapackage(const Package& package);

/// What made a result, for the attributes of its files: "mckibben 0.1.0".
std::string program_name();

}  // namespace mckibben::output
