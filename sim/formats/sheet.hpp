// Spreadsheets, and what is like them, as text: a line for each row, tabs between its cells. Dates are ISO
// 8601.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mckibben::formats {

struct Sheet {
  std::string name, text;
  std::size_t numbers = 0;  ///< cells that hold one
  bool hidden = false;      ///< its author keeps it from readers
};

/// The sheets of an .xlsx (ECMA-376). Throws BadFile.
std::vector<Sheet> sheets_of_xlsx(std::string_view bytes);

/// The sheets of an .xls of Excel 97 to 2003, by libfreexl. Throws BadFile.
std::vector<Sheet> sheets_of_xls(const std::string& path);

/// The groups of channels of a .tdms, each as a sheet with a line of names and one of units. Throws BadFile.
std::vector<Sheet> sheets_of_tdms(std::string_view bytes);

}  // namespace mckibben::formats
