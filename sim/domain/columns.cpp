// Maps of a data set and of its runs; see the header.
#include <algorithm>
#include <cctype>

#include <sim/domain/columns.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::domain {
std::string yaml_scalar(const std::string& text) {
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
  if (plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string line_of(std::string_view quantity, const ColumnPlace& place) {
  std::string line(quantity);
  line += ": {column: " + yaml_scalar(place.column) + ", unit: " + yaml_scalar(place.unit);
  if (place.zero != 0.0) line += ", zero: " + write_number(place.zero);
  if (place.factor != 1.0) line += ", factor: " + write_number(place.factor);
  return line + '}';
}

ColumnMap merged(const ColumnMap& shared, const ColumnMap& own) {
  ColumnMap map = own;
  for (const Quantity& quantity : quantities)
    if (ColumnPlace& place = map.*quantity.place; place.absent()) place = shared.*quantity.place;
  if (own.rows_are_ticks) map.time = own.time;
  if (map.settled.absent() && !own.rows_are_ticks && own.time.absent()) map.settled = shared.settled;
  if (!map.settled.absent()) map.time = own.time;
  map.rows_are_ticks =
      own.rows_are_ticks || (shared.rows_are_ticks && own.time.absent() && own.settled.absent());
  return map;
}

}  // namespace mckibben::domain
