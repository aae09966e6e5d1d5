// The files of runs, in the formats that are asked for, and `datapackage.json`, which says what their columns
// are (Frictionless Data, Tabular Data Package 1).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/rig.hpp>
#include <sim/formats/table.hpp>
#include <sim/run/recording.hpp>

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

/// What was wanted of a run: the key of a signal, and its value at each row, in the unit of its column; none
/// if empty.
using Targets = std::vector<std::pair<std::string_view, std::vector<double>>>;

/// The columns of a recording's file. Without rows, what they are.
std::vector<formats::Column> columns_of(const run::Recording& recording, const plant::Rig& rig,
                                        const Targets& targets = {});

/// Of these what a laboratory records, as the columns of a data set.
std::vector<formats::Column> measured_columns(const run::Recording& recording, const plant::Rig& rig);

/// Every column of every rig as a Markdown table: `mckibben schema columns`.
std::string table_of_signals();

/// Columns of one length as CSV.
std::string csv_of(const std::vector<formats::Column>& columns);

/// The thesis's file: current [mA], contraction ratio, its speed [1/s] and acceleration [1/s2], pressure
/// [bar], separated by blanks. All but the current are calculated: ratio from counts, speed and acceleration
/// from differences of counts over the last tick and the last two,
/// pressure from the current by the valve's line.
std::string thesis_ascii(const run::Recording& recording, const plant::Rig& rig, double load_kg);

}  // namespace mckibben::output
