// A sheet as it becomes text, cell by cell.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mckibben::formats {

class SheetText {
 public:
  /// Rows count from 1, ascending; 0: the next one. Throws BadFile where there are too many.
  void begin_row(std::size_t number);
  /// Columns count from 0, ascending; none: the next one.
  void add(std::optional<std::size_t> column, std::string_view value);
  std::string take();

 private:
  std::string text_;
  std::size_t row_ = 0, column_ = 0;
};

/// Excel's days since the end of 1899 as `2024-05-03 14:22:01.120`; below one day the time alone.
std::string date_of_serial(double days);

}  // namespace mckibben::formats
