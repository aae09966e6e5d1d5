// A measured table of which nobody has said what its columns are: all that can be read of it as numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sim/domain/input_file.hpp>

namespace mckibben::recognise {

struct UnknownColumn {
  std::string name;  ///< by which a data set names it: heading, channel, variable, number
  std::string unit;  ///< that a line below the headings says; empty: none
  bool is_date = false;
  std::vector<double> values;  ///< NaN where there is no number; of dates seconds since the first
};

struct UnknownTable {
  std::filesystem::path path;
  domain::InputFile input;
  std::vector<std::string> remarks;    ///< lines above the headings
  std::vector<UnknownColumn> columns;  ///< of numbers; `time_is_inside` of an .lvm comes without one
  std::vector<std::string> words;      ///< columns that hold none
  bool time_is_inside = false;         ///< an .lvm, which needs no column of time
  bool has_headings = true;
};

/// Throws MissingInput; BadInput for an ending that tells no format, and for a file without numbers.
UnknownTable read_unknown(const std::filesystem::path& path);

}  // namespace mckibben::recognise
