// The file of a table as text, whatever it is: UTF-16, old line ends and code pages become UTF-8 in lines; a
// spreadsheet becomes lines with tabs between the cells. What cannot be read says what it is and what to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sim/input/source.hpp>

namespace mckibben::input {

/// Throws MissingInput; BadInput for what is no table. MAT-files stay as they are. `sheet`: of a spreadsheet
/// that has several with numbers. `together`: as of load_thinned.
Source load_table(const std::filesystem::path& path, const std::string& sheet = "",
                  std::uintmax_t together = 0);

/// All of those, of a spreadsheet; else one without a name. Throws as load_table.
struct LoadedSheet {
  std::string name;
  Source source;
};
std::vector<LoadedSheet> load_tables(const std::filesystem::path& path, std::uintmax_t together = 0);

}  // namespace mckibben::input
