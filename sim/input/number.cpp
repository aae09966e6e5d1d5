// Strict numbers on top of std::from_chars; see the header.
#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include <sim/input/number.hpp>

namespace mckibben::input {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t digits_at(std::string_view text, std::size_t start) {
  std::size_t end = start;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - start;
}

}  // namespace

std::size_t number_length(std::string_view text) {
  std::size_t end = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  std::size_t digits = digits_at(text, end);
  if (digits == 0) return 0;
  if (text[end] == '0') digits = 1;
  end += digits;
  if (end < text.size() && text[end] == '.') {
    const std::size_t decimals = digits_at(text, end + 1);
    if (decimals > 0) end += 1 + decimals;
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const bool is_signed = end + 1 < text.size() && (text[end + 1] == '+' || text[end + 1] == '-');
    const std::size_t exponent = end + (is_signed ? 2 : 1);
    const std::size_t exponent_digits = digits_at(text, exponent);
    if (exponent_digits > 0) end = exponent + exponent_digits;
  }
  return end;
}

std::optional<double> parse_number(std::string_view text) {
  if (text.empty() || number_length(text) != text.size()) return std::nullopt;
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string why_no_number(std::string_view text) {
  const std::size_t length = number_length(text);
  if (text.empty()) return "the number is missing";
  if (length == text.size()) return fmt::format("{} is too large or too small for a number", text);
  const std::string_view rest = text.substr(length);
  if (length == 0 && text.front() == '.') return fmt::format("{} is not a number: write 0{}", text, text);
  if (length == 0) return fmt::format("{} is not a number", text);
  if (rest.front() == ',') return fmt::format("{} is not a number: the decimal sign is a point", text);
  if (rest.front() == '.') return fmt::format("{} is not a number: digits must follow the point", text);
  if (is_digit(rest.front())) return fmt::format("{} is not a number: it must not begin with 0", text);
  return fmt::format("{} is not a number: {} follows it", text, trimmed(rest));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

}  // namespace mckibben::input
