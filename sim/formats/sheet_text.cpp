// See the header.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <sim/formats/sheet_text.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t most_rows = 1U << 20U, most_columns = 1U << 14U, most_bytes = 1U << 28U;

}  // namespace

void SheetText::begin_row(std::size_t number) {
  if (row_ > 0) text_ += '\n';
  ++row_;
  if (number > most_rows || row_ > most_rows)
    throw BadFile("it has more rows than a sheet can have: it is damaged");
  for (; row_ < number; ++row_) text_ += '\n';
  column_ = 0;
}

void SheetText::add(std::optional<std::size_t> column, std::string_view value) {
  const std::size_t at = column.value_or(column_);
  if (at >= most_columns || text_.size() > most_bytes)
    throw BadFile("it has more cells than are read: save the sheet as CSV");
  for (; column_ < at; ++column_) text_ += '\t';
  for (const char c : value) text_ += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  text_ += '\t';
  ++column_;
}

std::string SheetText::take() {
  if (row_ > 0) text_ += '\n';
  // Each line gets as many cells: what is empty at its end is not in the file.
  std::size_t most = 0;
  for (std::size_t at = 0; at < text_.size();) {
    const std::size_t end = text_.find('\n', at);
    most = std::max(
        most, static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at),
                                                  text_.begin() + static_cast<std::ptrdiff_t>(end), '\t')));
    at = end + 1;
  }
  std::string padded;
  for (std::size_t at = 0; at < text_.size();) {
    const std::size_t end = text_.find('\n', at);
    const std::string_view line = std::string_view(text_).substr(at, end - at);
    const auto cells = static_cast<std::size_t>(std::ranges::count(line, '\t'));
    padded.append(line);
    if (cells > 0) padded.append(most - cells, '\t');
    padded += '\n';
    if (padded.size() > most_bytes) throw BadFile("it has more cells than are read: save the sheet as CSV");
    at = end + 1;
  }
  return padded;
}

std::string date_of_serial(double days) {
  constexpr double most_days = 2958466.0;  // of the year 9999
  if (!(days >= 0.0) || days >= most_days) return "";
  // To the microsecond, more than a double keeps of such a date.
  const auto microseconds = std::llround(days * 86400e6);
  const auto day = microseconds / 86'400'000'000, within = microseconds % 86'400'000'000;
  const auto second = within / 1'000'000, part = within % 1'000'000;
  const std::string time =
      fmt::format("{:02}:{:02}:{:02}.{:06}", second / 3600, second / 60 % 60, second % 60, part);
  if (day == 0) return time;
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::year{1899} / 12 / 30) +
                                         std::chrono::days(day)};
  return fmt::format("{:04}-{:02}-{:02} {}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), time);
}

}  // namespace mckibben::formats
