// Cells and their numbers; see the header.
#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::size_t longest_shown = 40;

bool is_number_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_sign(char c) {
  return c == '.' || c == ',';
}

/// Of what nearly all numbers are made of; asked of every character of a table.
bool is_plain(char c) {
  return is_number_digit(c) || is_sign(c) || c == '+' || c == '-' || c == 'e' || c == 'E';
}

/// One decimal sign, groups of three digits, or a date such as 03.05.2024; "1,2,3" are three numbers.
bool signs_fit(std::string_view digits) {
  const auto points = std::ranges::count(digits, '.'), commas = std::ranges::count(digits, ',');
  if (digits.find("..") != std::string_view::npos) return false;  // a range
  if (points <= 1 && commas <= 1) return true;
  if (points == 2 && commas <= 1) return true;
  if (points > 1 && commas > 1) return false;
  const char sign = points > 1 ? '.' : ',';
  for (std::size_t at = digits.find(sign); at != std::string_view::npos; at = digits.find(sign, at + 1))
    if (const std::size_t next = std::min(digits.find_first_of(".,", at + 1), digits.size()); next - at != 4)
      return false;
  return true;
}

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// 20 000, 20'000: groups of three digits, as with a point or a comma between them.
std::string without_groups(const std::string& text) {
  std::string digits = text;
  for (const char* space : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", " "}) replace_all(digits, space, "'");
  if (digits.find('\'') == std::string::npos) return text;
  const std::size_t whole = std::min(digits.find_first_of(".,"), digits.size());
  std::size_t group = 0;
  bool fits = true;
  for (std::size_t at = digits.front() == '-' ? 1 : 0; at < whole; ++at) {
    const bool mark = digits[at] == '\'';
    fits = fits &&
           (mark ? group > 0 && group <= 3 && (group == 3 || digits.rfind('\'', at - 1) == std::string::npos)
                 : is_number_digit(digits[at]));
    group = mark ? 0 : group + 1;
  }
  if (!fits || group != 3 || digits.find('\'', whole) != std::string::npos) return text;
  std::erase(digits, '\'');
  return digits;
}

/// A number as it is read here, where a program writes another sign, no 0 before the point, D for E, 0x of
/// counts, spaces between thousands, a spread or a remark behind it; none where it is plain, or no number.
std::optional<std::string> respelt(std::string_view cell) {
  const bool plain = std::ranges::all_of(cell, is_plain);
  const std::size_t begin = !cell.empty() && (cell[0] == '-' || cell[0] == '+') ? 1 : 0;
  const bool bare_point = begin + 1 < cell.size() && is_sign(cell[begin]) && is_number_digit(cell[begin + 1]);
  const bool padded = begin + 1 < cell.size() && cell[begin] == '0' && is_number_digit(cell[begin + 1]);
  if (cell.size() > longest_shown || (plain && !bare_point && !padded)) return std::nullopt;
  std::string text(cell);
  for (const char* end : {" #", "\t#", "\xC2\xB1", "+/-", "+-"})
    if (const std::size_t at = text.find(end); at != std::string::npos && at > 0)
      text = trimmed(std::string_view(text).substr(0, at));
  for (const char* minus : {"\xE2\x88\x92", "\xE2\x80\x93"})
    if (text.starts_with(minus)) text = "-" + text.substr(3);
  if (text.empty()) return std::nullopt;
  const std::size_t first = text[0] == '-' || text[0] == '+' ? 1 : 0;
  if (padded)
    while (first + 1 < text.size() && text[first] == '0' && is_number_digit(text[first + 1]))
      text.erase(first, 1);
  if (first + 1 < text.size() && is_sign(text[first]) && is_number_digit(text[first + 1]))
    text.insert(first, "0");
  if (!is_number_digit(text[std::min(first, text.size() - 1)])) return std::nullopt;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    std::uint64_t counts = 0;
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), counts, 16);
    if (error == std::errc{} && end == text.data() + text.size()) text = std::to_string(counts);
  }
  if (const std::size_t at = text.find_first_of("Dd");
      at != std::string::npos && at + 1 < text.size() &&
      text.find_first_not_of("0123456789+-", at + 1) == std::string::npos)
    text[at] = 'E';
  text = without_groups(text);
  if (text == cell) return std::nullopt;
  return text;
}

std::vector<Cell> split_at_blanks(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t;", at), line.size());
    cells.push_back({line.substr(at, end - at), at});
    at = line.find_first_not_of(blanks, end);
    if (at != std::string_view::npos && line[at] == ';') at = line.find_first_not_of(blanks, at + 1);
  }
  return cells;
}

/// Digits in groups of three between `mark`: 12,345.
bool in_groups(std::string_view digits, char mark) {
  std::size_t group = 0, groups = 0;
  for (std::size_t i = digits.starts_with('-') || digits.starts_with('+') ? 1 : 0; i < digits.size(); ++i) {
    if (digits[i] != mark) {
      if (!is_number_digit(digits[i]) || (groups == 0 && group == 0 && digits[i] == '0')) return false;
      ++group;
      continue;
    }
    if (group == 0 || group > 3 || (groups > 0 && group != 3)) return false;
    ++groups;
    group = 0;
  }
  return groups > 0 && group == 3;
}

char other_sign(char sign) {
  return sign == ',' ? '.' : ',';
}

/// How a number without its sign, exponent and unit is spelled.
enum class Spelled { digits, decimal_point, decimal_comma, group_after_comma, group_after_point };
std::optional<Spelled> spelled(std::string_view number) {
  const std::size_t at = number.find_last_of(".,");
  if (at == std::string_view::npos) return Spelled::digits;
  const char sign = number[at];
  const bool point = sign == '.';
  if (in_groups(number, sign)) {
    if (number.find(sign) != at) return point ? Spelled::decimal_comma : Spelled::decimal_point;
    return point ? Spelled::group_after_point : Spelled::group_after_comma;
  }
  const std::string_view whole = number.substr(0, at);
  const bool plain = whole.find_first_of(".,") == std::string_view::npos;
  if (!plain && !in_groups(whole, other_sign(sign))) return std::nullopt;
  return point ? Spelled::decimal_point : Spelled::decimal_comma;
}

/// As most cells are: a sign, digits, one decimal sign and digits, an exponent.
bool is_plain_number(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t from = at;
    while (at < text.size() && is_number_digit(text[at])) ++at;
    return at > from;
  };
  const auto skip = [&](auto wanted) { return at < text.size() && wanted(text[at]) ? ++at : 0; };
  const auto plus_or_minus = [](char c) { return c == '+' || c == '-'; };
  skip(plus_or_minus);
  if (!digits() || (skip(is_sign) && !digits())) return false;
  if (!skip([](char c) { return c == 'e' || c == 'E'; })) return at == text.size();
  skip(plus_or_minus);
  return digits() && at == text.size();
}

}  // namespace

bool is_number_like(std::string_view text) {
  if (text.empty()) return false;
  if (is_plain_number(text)) return true;
  const std::optional<std::string> other = respelt(text);
  if (other) text = *other;
  std::string_view bare = text;
  if (bare.front() == '+' || bare.front() == '-') bare.remove_prefix(1);
  const bool begins =
      !bare.empty() && (is_number_digit(bare.front()) ||
                        (bare.size() > 1 && is_sign(bare.front()) && is_number_digit(bare[1])));
  if (!begins || bare.ends_with(',')) return false;
  const auto end = static_cast<std::size_t>(
      std::ranges::find_if_not(bare, [](char c) { return is_number_digit(c) || is_sign(c) || c == '\''; }) -
      bare.begin());
  if (!signs_fit(bare.substr(0, end))) return false;
  std::string_view rest = bare.substr(end);
  if (rest.starts_with('e') || rest.starts_with('E')) {
    const std::size_t from = rest.size() > 1 && (rest[1] == '+' || rest[1] == '-') ? 2 : 1;
    if (rest.size() > from && is_number_digit(rest[from]))
      rest.remove_prefix(std::min(rest.find_first_not_of("0123456789", from), rest.size()));
  }
  if (rest.empty()) return true;
  constexpr std::size_t longest_stamp = 40;
  if (text.size() <= longest_stamp &&
      text.find_first_not_of("0123456789:-/., +TZAPMapm") == std::string_view::npos &&
      text.find_first_of(":-/") != std::string_view::npos)
    return true;
  return std::ranges::none_of(rest, is_number_digit) && !unit_word(trimmed(rest)).empty();
}

std::string unit_word(std::string_view text) {
  if (text.size() > 2 && std::string_view("[(<").find(text.front()) != std::string_view::npos) {
    text.remove_prefix(1);
    text.remove_suffix(1);
  }
  if (text.empty() || (text != "1" && text.find_first_of("0123456789+-.") == 0)) return "";
  if (text == "°" || text == "Grad" || text == "Winkelgrad") return "deg";
  if (text == "counts") return "count";
  constexpr std::array itself{"%", "count", "date", "1"};
  constexpr std::array measured{"s", "mA", "V", "bar", "N", "m", "rad", "kg", "K"};
  const bool known = std::find(itself.begin(), itself.end(), text) != itself.end() ||
                     std::any_of(measured.begin(), measured.end(),
                                 [&](const char* wanted) { return unit_problem(text, wanted).empty(); });
  return known ? std::string(text) : "";
}

std::vector<Cell> split_cells(std::string_view line, char separator) {
  if (separator == ' ') return split_at_blanks(line);
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    bool in_quotes = false;
    std::size_t end = start;
    for (; end < line.size() && (in_quotes || line[end] != separator); ++end)
      if (line[end] == '"') in_quotes = !in_quotes;
    if (in_quotes) return {};
    Cell cell{trimmed(line.substr(start, end - start)), start};
    if (!cell.text.empty()) cell.offset = static_cast<std::size_t>(cell.text.data() - line.data());
    if (cell.text.size() >= 2 && cell.text.front() == '"' && cell.text.back() == '"')
      cell.text = trimmed(cell.text.substr(1, cell.text.size() - 2));
    cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

bool is_missing(const Cell& cell) {
  if (cell.text.empty()) return true;
  static constexpr std::array<std::string_view, 32> none{
      "nan",     "-nan", "nan(ind)", "-nan(ind)", "1.#qnan",      "-1.#ind",      "na",   "n/a",
      "n.a.",    "#n/a", "#na",      "#nv",       "#n/d",         "null",         "none", "nil",
      "missing", "-",    "--",       "---",       "\xE2\x80\x93", "\xE2\x80\x94", ".",    "?",
      "ovld",    "ol",   "overload", "overflow",  "inf",          "-inf",         "+inf", "infinity"};
  constexpr std::size_t longest = 9, longest_error = 12;
  const bool ends_as_error = cell.text.back() == '!' || cell.text.back() == '?';
  if (cell.text.front() == '#' && ends_as_error && cell.text.size() <= longest_error &&
      cell.text.find(' ') == std::string_view::npos)
    return true;  // Excel's
  if (cell.text.size() > longest) return false;
  if (cell.text.find_first_not_of('*') == std::string_view::npos) return true;
  return is_number_digit(cell.text.back()) ? false : std::ranges::find(none, lower(cell.text)) != none.end();
}

bool take_unit(Cell& cell, std::string& unit) {
  const std::string_view text = cell.text;
  if (text.size() < 2 || is_number_digit(text.back()) ||
      !(is_number_digit(text[0]) || is_number_digit(text[1])))
    return true;
  const std::size_t end = text.find_last_of("0123456789") + 1;
  const std::string_view behind = trimmed(text.substr(end));
  if (text.find_first_of(":/") != std::string_view::npos || behind.empty() || behind.front() == '.' ||
      unit_word(behind).empty())
    return true;
  std::string number(text.substr(0, end));
  std::replace(number.begin(), number.end(), ',', '.');
  if (!parse_number(number)) return true;
  if (!unit.empty() && unit != behind) return false;
  unit = behind;
  cell.text = text.substr(0, end);
  return true;
}

std::optional<double> EpochReader::read(std::string_view name, const Cell& cell, NumberReader& numbers,
                                        std::string& problem) {
  constexpr std::size_t long_ago = 9;  // digits
  const std::string_view text = cell.text;
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  const bool counts = digits >= long_ago && digits <= 19 &&
                      (digits == text.size() || text[digits] == '.' || text[digits] == ',');
  const bool is_first = !began_ && !is_missing(cell);
  if (is_first) began_ = true;
  if (!counts || (!is_first && !first_text_)) {
    auto value = numbers.read(name, cell, problem);
    if (value && first_text_) *value -= static_cast<double>(first_);
    return value;
  }
  std::int64_t whole = 0;
  std::from_chars(text.data(), text.data() + digits, whole);
  double part = 0.0;
  if (digits < text.size()) {
    std::string decimals = "0" + std::string(text.substr(digits));
    const auto value = numbers.read(name, {decimals, cell.offset}, problem);
    if (!value) return std::nullopt;
    part = *value;
  }
  if (is_first) {
    first_ = whole;
    first_text_ = text;
  }
  return static_cast<double>(whole - first_) + part;
}

std::optional<double> NumberReader::read(std::string_view name, const Cell& cell, std::string& problem) {
  if (const auto other = respelt(cell.text)) return read(name, {*other, cell.offset}, problem);
  const std::string_view shown = cell.text.substr(0, longest_shown);
  problem.clear();
  if (cell.text.empty()) {
    problem = fmt::format("{} is missing here", name);
    return std::nullopt;
  }
  const std::size_t first = cell.text.find_first_of(".,"), last = cell.text.find_last_of(".,");
  if (sign_ == '\0' && last != std::string_view::npos) sign_ = cell.text[last];
  std::string plain(cell.text);
  if (const std::size_t whole = cell.text[std::min(last, plain.size() - 1)] == sign_ ? last : plain.size();
      first < whole && in_groups(cell.text.substr(0, whole), other_sign(sign_)))
    std::erase(plain, other_sign(sign_));
  if (sign_ == ',') {
    if (plain.find('.') != std::string::npos &&
        plain.find_first_not_of("0123456789.+-eE") == std::string::npos) {
      problem = fmt::format("{}: {} is not a number: the decimal sign of this file is a comma", name, shown);
      return std::nullopt;
    }
    std::replace(plain.begin(), plain.end(), ',', '.');
  }
  const auto value = parse_number(plain);
  if (!value) problem = fmt::format("{}: {}", name, why_no_number(shown));
  return value;
}

void Spelling::look_at(std::string_view text) {
  std::string unit;
  Cell cell{text, 0};
  take_unit(cell, unit);
  const std::optional<std::string> other = respelt(cell.text);
  std::string_view number = other ? std::string_view(*other) : cell.text;
  number = number.substr(0, number.find_first_of("eE"));
  if (number.empty() || number.find_first_not_of("0123456789.,+-") != std::string_view::npos) return;
  const auto how = spelled(number);
  if (!how) return;
  switch (*how) {
    case Spelled::digits:
      longest_ = std::max(longest_, number.size() - (is_number_digit(number.front()) ? 0 : 1));
      return;
    case Spelled::decimal_point:
      ++points_;
      return;
    case Spelled::decimal_comma:
      ++commas_;
      return;
    case Spelled::group_after_point:
    case Spelled::group_after_comma:
      if (group_.empty()) group_ = text.substr(0, longest_shown);
      mark_ = *how == Spelled::group_after_point ? '.' : ',';
  }
}

char Spelling::decimal() const {
  return points_ + commas_ == 0 ? '\0' : points_ >= commas_ ? '.' : ',';
}

char Spelling::goes_on() const {
  constexpr std::size_t of_a_group = 3;
  return longest_ == of_a_group && !group_.empty() ? other_sign(mark_) : '\0';
}

}  // namespace mckibben::input
