// Lines of JSON; see the header.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

#include <controllers/line.hpp>
#include <controllers/utf8.hpp>

namespace mckibben::controllers {

namespace {

void append_digits(std::string& text, auto value) {
  char digits[32];
  text.append(std::begin(digits), std::to_chars(std::begin(digits), std::end(digits), value).ptr);
}

}  // namespace

void append(std::string& text, double value) {
  if (std::isfinite(value))
    append_digits(text, value);
  else
    text += "null";
}

void append(std::string& text, std::int64_t value) {
  append_digits(text, value);
}

void LineWriter::open(std::string_view key) {
  if (text_.size() > 1) text_ += ',';
  text_ += '"';
  text_ += key;
  text_ += "\":";
}

std::optional<double> number_in(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return std::nullopt;
  line = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || end != line.data() + line.size()) return std::nullopt;
  return value;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 120;
  std::string shown = shortened(text, longest);
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      ' ');
  return '"' + printable(shown) + '"';
}

}  // namespace mckibben::controllers
