// See the header.
#include <algorithm>
#include <cctype>
#include <string_view>

#include <sim/input/scalar_place.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {

Place place_in(const Source& source, const Node& scalar, std::size_t offset) {
  // What is read holds the same characters as what is written, but for blanks, line ends and quotes.
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const std::size_t end = std::min(offset, scalar.text.size());
  auto left = std::count_if(scalar.text.begin(), scalar.text.begin() + static_cast<std::ptrdiff_t>(end),
                            [&](char c) { return !is_blank(c); });
  std::size_t line = scalar.place.line, byte = 0;
  for (std::size_t column = 1; byte < source.line(line).size() && column < scalar.place.column; ++byte)
    if (byte + 1 >= source.line(line).size() || !is_utf8_continuation(source.line(line)[byte + 1])) ++column;
  if (scalar.quoted && byte < source.line(line).size()) {
    const char first = source.line(line)[byte];
    if (first == '|' || first == '>') {
      ++line;
      byte = 0;
    } else if (first == '"' || first == '\'') {
      ++byte;
    }
  }
  for (; line <= source.lines(); ++line, byte = 0) {
    const std::string_view text = source.line(line);
    for (; byte < text.size(); ++byte) {
      if (is_blank(text[byte])) continue;
      if (left-- == 0) return source.place(line, byte);
    }
    if (left == 0 && offset >= scalar.text.size()) return source.place(line, text.size());
  }
  return scalar.place;
}

}  // namespace mckibben::input
