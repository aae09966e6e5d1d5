// Writing of MAT-files; see mat_file.hpp. Layout: MathWorks, "MAT-File Format". The heading holds no date.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#include <sim/formats/mat_file.hpp>

namespace mckibben::formats {
namespace {

enum Type : std::uint32_t { bytes_8 = 1, integers = 5, words = 6, doubles = 9, array = 14, utf8 = 16 };
enum Class : std::uint32_t { of_fields = 2, of_text = 4, of_doubles = 6 };

std::string words_of(std::initializer_list<std::size_t> values) {
  std::string bytes;
  for (const std::size_t value : values)
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFFU);
  return bytes;
}

std::string element(Type type, std::string_view content) {
  return words_of({type, content.size()}).append(content).append((8 - content.size() % 8) % 8, '\0');
}

/// Up to four bytes stand in the tag itself.
std::string short_element(Type type, std::string_view content) {
  if (content.empty() || content.size() > 4) return element(type, content);
  return words_of({type | content.size() << 16U}).append(content).append(4 - content.size(), '\0');
}

std::string array_of(Class kind, std::size_t rows, std::size_t columns, std::string_view name,
                     std::string_view contents) {
  return element(array, element(words, words_of({kind, 0}))
                            .append(element(integers, words_of({rows, columns})))
                            .append(short_element(bytes_8, name))
                            .append(contents));
}

std::string numbers(std::string_view name, const std::vector<double>& values) {
  std::string bytes(values.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return array_of(of_doubles, values.size(), 1, name, element(doubles, bytes));
}

std::string text(std::string_view name, std::string_view value) {
  const auto letters = std::count_if(
      value.begin(), value.end(), [](char byte) { return (static_cast<unsigned>(byte) & 0xC0U) != 0x80U; });
  return array_of(of_text, value.empty() ? 0 : 1, static_cast<std::size_t>(letters), name,
                  element(utf8, value));
}

/// A struct with a text for each column.
std::string texts(std::string_view name, const std::vector<Column>& columns, std::string Column::*text_of) {
  std::size_t width = 0;
  for (const Column& column : columns) width = std::max(width, column.name.size() + 1);
  while (columns.size() * width % 8 != 0) ++width;
  std::string names, fields;
  for (const Column& column : columns) {
    names.append(column.name).append(width - column.name.size(), '\0');
    fields += text("", column.*text_of);
  }
  return array_of(of_fields, 1, 1, name,
                  short_element(integers, words_of({width})) + element(bytes_8, names) + fields);
}

}  // namespace

std::string mat_of(const Table& table) {
  std::string bytes = "MATLAB 5.0 MAT-file, written by mckibben";
  bytes.append(1, '\0').resize(124, ' ');
  bytes.append({'\0', '\1', 'I', 'M'});
  for (const Column& column : table.columns) bytes += numbers(column.name, column.values);
  bytes +=
      texts("units", table.columns, &Column::unit) + texts("descriptions", table.columns, &Column::meaning);
  bytes += text("title", table.title);
  for (const auto& [name, value] : table.attributes) {
    const auto* number = std::get_if<double>(&value);
    bytes += number != nullptr ? numbers(name, {*number}) : text(name, std::get<std::string>(value));
  }
  return bytes;
}

}  // namespace mckibben::formats
