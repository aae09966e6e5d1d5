// Stamps of ISO 8601, and as Excel writes them in its languages; see the header.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <ctime>

#include <fmt/format.h>

#include <sim/input/dates.hpp>
#include <sim/input/number.hpp>

namespace mckibben::input {
namespace {

constexpr double hour_s = 3600.0, minute_s = 60.0, day_s = 86400.0;

struct Date {
  std::ptrdiff_t length;    ///< in letters
  std::optional<long> day;  ///< since 1970; none where day and month cannot be told apart
};

/// By the formats that fit; a day that does not exist tells which number is the month.
std::optional<Date> date_at(const char* text) {
  std::optional<Date> found;
  for (const char* format :
       {"%Y-%m-%d", "%Y/%m/%d", "%Y.%m.%d", "%d.%m.%Y", "%d/%m/%Y", "%m/%d/%Y", "%d-%m-%Y", "%m-%d-%Y"}) {
    std::tm read{};
    const char* const end = strptime(text, format, &read);
    const std::chrono::year_month_day date{std::chrono::year(read.tm_year + 1900),
                                           std::chrono::month(static_cast<unsigned>(read.tm_mon + 1)),
                                           std::chrono::day(static_cast<unsigned>(read.tm_mday))};
    constexpr std::chrono::year first_of_four_digits{1000};
    if (end == nullptr || date.year() < first_of_four_digits || !date.ok()) continue;
    const long day = std::chrono::sys_days(date).time_since_epoch().count();
    if (!found)
      found = {end - text, day};
    else if (found->day != day)
      found->day.reset();
  }
  return found;
}

/// Takes 14:22, 14:22:01.120 or 2:22:01,5 PM from the beginning of a text; none if it is no time of the day.
std::optional<double> second_of_day(const char*& text) {
  std::tm read{};
  const char* end = strptime(text, "%H:%M", &read);
  double second = 0.0;
  if (end != nullptr && *end == ':') {
    end = strptime(end, ":%S", &read);
    second = read.tm_sec;
    if (end != nullptr && (*end == '.' || *end == ',')) {
      const std::size_t digits = std::strspn(end + 1, "0123456789");
      second += parse_number("0." + std::string(end + 1, digits)).value_or(0.0);
      end += 1 + digits;
    }
  }
  if (end == nullptr || second >= 61.0) return std::nullopt;
  const std::string_view half(end, std::min<std::size_t>(3, std::strlen(end)));
  if (half == " AM" || half == " am" || half == " PM" || half == " pm") {
    if (read.tm_hour > 12) return std::nullopt;
    read.tm_hour = read.tm_hour % 12 + (half[1] == 'P' || half[1] == 'p' ? 12 : 0);
    end += half.size();
  }
  text = end;
  return read.tm_hour * hour_s + read.tm_min * minute_s + second;
}

}  // namespace

std::optional<ClockReader::Stamp> ClockReader::stamp_of(std::string_view cell) {
  const std::string text(cell);
  const char* at = text.c_str();
  Stamp stamp{.day = 0};
  if (const auto date = date_at(at)) {
    stamp.date = text.substr(0, static_cast<std::size_t>(date->length));
    stamp.day = date->day;
    at += date->length;
    if (*at != 'T' && *at != ' ') return std::nullopt;
    ++at;
  }
  const auto second = second_of_day(at);
  if (!second) return std::nullopt;
  std::tm zone{};  // Z or +02:00
  if (const char* const end = strptime(at, "%z", &zone)) at = end;
  stamp.second = *second - static_cast<double>(zone.tm_gmtoff);
  if (!trimmed(at).empty()) return std::nullopt;
  return stamp;
}

std::optional<double> ClockReader::read(std::string_view name, const Cell& cell, std::string& problem) {
  problem.clear();
  const std::string_view shown = cell.text.substr(0, 40);
  std::optional<Stamp> stamp;
  if (cell.text.empty())
    problem = fmt::format("{} is missing here", name);
  else if (stamp = stamp_of(cell.text); !stamp)
    problem = fmt::format(
        "{}: {} is not a date and time, such as 2024-05-03 14:22:01.120{}", name, shown,
        parse_number(cell.text) ? "; a number has another unit: s, ms, or d for Excel's days" : "");
  if (!stamp) return std::nullopt;
  if (!first_) first_ = stamp;
  if (stamp->date.empty() && first_->date.empty()) {  // a time of the day that falls is of the next one
    constexpr double half_day_s = 0.5 * day_s, goes_on_s = 60.0;
    if (stamp->second < last_ - half_day_s)
      passed_s_ += day_s;
    else if (const double late_s = stamp->second + half_day_s - last_; late_s >= 0.0 && late_s < goes_on_s)
      passed_s_ += half_day_s;  // a clock of 12 hours that does not say which half of the day it is
    last_ = stamp->second;
    return passed_s_ + stamp->second - first_->second;
  }
  if (stamp->date == first_->date) return stamp->second - first_->second;
  if (!stamp->day || !first_->day) {
    problem = fmt::format("{}: {} is another day than {}, and which number is the month is ambiguous", name,
                          shown, first_->date);
    return std::nullopt;
  }
  return static_cast<double>(*stamp->day - *first_->day) * day_s + stamp->second - first_->second;
}

bool is_day(std::string_view text) {
  const std::string whole(text);
  const auto date = date_at(whole.c_str());
  return date && date->length == static_cast<std::ptrdiff_t>(whole.size());
}

}  // namespace mckibben::input
