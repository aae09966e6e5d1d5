// Stamps of ISO 8601, and as Excel writes them in its languages; see the header.
#include <algorithm>
#include <charconv>
#include <chrono>

#include <fmt/format.h>

#include <sim/input/dates.hpp>
#include <sim/input/number.hpp>

namespace mckibben::input {
namespace {

constexpr double hour_s = 3600.0, minute_s = 60.0, day_s = 86400.0;

/// Takes a text apart from left to right.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  std::optional<int> digits(std::size_t least, std::size_t most) {
    std::size_t length = 0;
    while (length < rest_.size() && length < most && rest_[length] >= '0' && rest_[length] <= '9') ++length;
    int value = 0;
    if (length < least) return std::nullopt;
    std::from_chars(rest_.data(), rest_.data() + length, value);
    rest_.remove_prefix(length);
    return value;
  }
  /// The next letter, if it is one of these; 0 if not.
  char one_of(std::string_view letters) {
    if (rest_.empty() || letters.find(rest_.front()) == std::string_view::npos) return '\0';
    const char letter = rest_.front();
    rest_.remove_prefix(1);
    return letter;
  }
  bool word(std::string_view wanted) {
    if (!rest_.starts_with(wanted)) return false;
    rest_.remove_prefix(wanted.size());
    return true;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

std::optional<long> day_number(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// 2024-05-03, 2024/05/03. False if it is none.
bool year_first(Scanner& scan, std::optional<long>& number) {
  const auto year = scan.digits(4, 4);
  const char sign = scan.one_of("-/.");
  const auto month = scan.digits(1, 2);
  const bool same = sign != '\0' && scan.one_of({&sign, 1}) != '\0';
  const auto day = scan.digits(1, 2);
  if (!year || !month || !day || !same) return false;
  number = day_number(*year, *month, *day);
  return number.has_value();
}

/// 03.05.2024; 5/3/2024, where the larger number may tell which is the day.
bool year_last(Scanner& scan, std::optional<long>& number) {
  const auto one = scan.digits(1, 2);
  const char sign = scan.one_of("./-");
  const auto two = scan.digits(1, 2);
  const bool same = sign != '\0' && scan.one_of({&sign, 1}) != '\0';
  const auto year = scan.digits(4, 4);
  if (!one || !two || !year || !same) return false;
  const auto day_first = day_number(*year, *two, *one), month_first = day_number(*year, *one, *two);
  if (!day_first && !month_first) return false;
  if (sign == '.')
    number = day_first;
  else if (!day_first || !month_first || *one == *two)
    number = day_first ? day_first : month_first;
  return sign != '.' || number.has_value();
}

/// 14:22, 14:22:01.120, 2:22:01,5 PM; none if it is no time of the day.
std::optional<double> second_of_day(Scanner& scan) {
  const auto hour = scan.digits(1, 2);
  if (!hour || scan.one_of(":") == '\0') return std::nullopt;
  const auto minute = scan.digits(2, 2);
  double second = 0.0;
  if (scan.one_of(":") != '\0') {
    const auto whole = scan.digits(2, 2);
    if (!whole) return std::nullopt;
    second = *whole;
    if (scan.one_of(".,") != '\0') {
      std::string fraction = "0.";
      while (const char digit = scan.one_of("0123456789")) fraction += digit;
      second += parse_number(fraction).value_or(0.0);
    }
  }
  int added = 0;
  if (scan.word(" AM") || scan.word(" am")) added = *hour == 12 ? -12 : 0;
  if (scan.word(" PM") || scan.word(" pm")) added = *hour == 12 ? 0 : 12;
  if (!minute || *minute > 59 || second >= 61.0 || *hour + added > 23 || *hour + added < 0)
    return std::nullopt;
  return (*hour + added) * hour_s + *minute * minute_s + second;
}

/// Seconds of a zone behind a time, Z or +02:00, to be taken away.
double zone_s(Scanner& scan) {
  if (scan.word("Z")) return 0.0;
  const char sign = scan.one_of("+-");
  if (sign == '\0') return 0.0;
  const double hours = scan.digits(2, 2).value_or(0);
  scan.one_of(":");
  const double minutes = scan.digits(2, 2).value_or(0);
  return (sign == '-' ? -1.0 : 1.0) * (hours * hour_s + minutes * minute_s);
}

}  // namespace

std::optional<ClockReader::Stamp> ClockReader::stamp_of(std::string_view text) {
  Stamp stamp;
  Scanner scan(text);
  if (text.find(':') > std::min<std::size_t>(text.find_first_of("./-"), 2)) {  // a date comes first
    Scanner other(text);
    if (!year_first(scan, stamp.day)) {
      stamp.day.reset();
      if (!year_last(other, stamp.day)) return std::nullopt;
      scan = other;
    }
    stamp.date = text.substr(0, text.size() - scan.rest().size());
    if (scan.one_of("T ") == '\0') return std::nullopt;
  } else {
    stamp.day = 0;
  }
  const auto second = second_of_day(scan);
  if (!second) return std::nullopt;
  stamp.second = *second - zone_s(scan);
  if (!trimmed(scan.rest()).empty()) return std::nullopt;
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
  if (stamp->date == first_->date) return stamp->second - first_->second;
  if (!stamp->day || !first_->day) {
    problem = fmt::format("{}: {} is another day than {}, and it cannot be told which number is the month",
                          name, shown, first_->date);
    return std::nullopt;
  }
  return static_cast<double>(*stamp->day - *first_->day) * day_s + stamp->second - first_->second;
}

}  // namespace mckibben::input
