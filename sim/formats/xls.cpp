// Excel 97 to 2003 by libfreexl, which reads files by their path, in a process of its own; see sheet.hpp.
#include <memory>

#include <fmt/format.h>
#include <freexl.h>

#include <sim/formats/isolated.hpp>
#include <sim/formats/sheet.hpp>
#include <sim/formats/sheet_text.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

struct CloseXls {
  void operator()(const void* handle) const { freexl_close(handle); }
};

/// What a cell shows; whether it is a number.
std::pair<std::string, bool> shown(const FreeXL_CellValue& cell) {
  switch (cell.type) {
    case FREEXL_CELL_INT:
      return {std::to_string(cell.value.int_value), true};
    case FREEXL_CELL_DOUBLE:
      return {fmt::format("{}", cell.value.double_value), true};
    case FREEXL_CELL_TEXT:
    case FREEXL_CELL_SST_TEXT:
    case FREEXL_CELL_DATE:
    case FREEXL_CELL_DATETIME:
    case FREEXL_CELL_TIME:
      return {cell.value.text_value == nullptr ? "" : cell.value.text_value,
              cell.type != FREEXL_CELL_TEXT && cell.type != FREEXL_CELL_SST_TEXT};
    default:
      return {"", false};
  }
}

/// Of each sheet name, text and how many numbers.
std::vector<std::string> parts_of_xls(const std::string& path) {
  const void* opened = nullptr;
  if (const int status = freexl_open(path.c_str(), &opened); status != FREEXL_OK)
    throw BadFile(
        status == FREEXL_BIFF_OBFUSCATED
            ? "it has a password; save it without, or save the sheet as CSV"
            : fmt::format("it cannot be read as .xls (libfreexl: {}); save the sheet as CSV", status));
  const std::unique_ptr<const void, CloseXls> handle(opened);
  unsigned count = 0;
  freexl_get_info(opened, FREEXL_BIFF_SHEET_COUNT, &count);
  std::vector<std::string> parts;
  for (unsigned i = 0; i < count; ++i) {
    const char* name = nullptr;
    unsigned rows = 0;
    unsigned short columns = 0;
    if (freexl_get_worksheet_name(opened, static_cast<unsigned short>(i), &name) != FREEXL_OK ||
        freexl_select_active_worksheet(opened, static_cast<unsigned short>(i)) != FREEXL_OK ||
        freexl_worksheet_dimensions(opened, &rows, &columns) != FREEXL_OK)
      continue;
    std::size_t numbers = 0;
    SheetText text;
    for (unsigned row = 0; row < rows; ++row) {
      text.begin_row(row + 1);
      for (unsigned short column = 0; column < columns; ++column) {
        FreeXL_CellValue cell{};
        if (freexl_get_cell_value(opened, row, column, &cell) != FREEXL_OK) continue;
        const auto [value, number] = shown(cell);
        text.add(column, value);
        numbers += number ? 1 : 0;
      }
    }
    parts.insert(parts.end(), {name == nullptr ? "" : name, text.take(), std::to_string(numbers)});
  }
  return parts;
}

}  // namespace

std::vector<Sheet> sheets_of_xls(const std::string& path) {
  const std::vector<std::string> parts = isolated([&] { return parts_of_xls(path); });
  std::vector<Sheet> sheets;
  for (std::size_t i = 0; i < parts.size(); i += 3)
    sheets.push_back({parts[i], parts[i + 1], std::stoul(parts[i + 2])});
  return sheets;
}

}  // namespace mckibben::formats
