// See the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/input/column_hints.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

using domain::Quantity;

/// The unit at the end of a heading, as in U_mA, `I [A]` or t(ms); ours if there is none that fits.
std::string unit_in(std::string_view heading, const Quantity& quantity) {
  if (heading.ends_with(']') || heading.ends_with(')')) heading.remove_suffix(1);
  const std::string_view unit = heading.substr(std::min(heading.find_last_of("_[( ") + 1, heading.size()));
  if (unit.size() == heading.size() || quantity.unit() == "1" || !unit_problem(unit, quantity.unit()).empty())
    return std::string(quantity.unit());
  return std::string(unit);
}

}  // namespace

std::string hint_of_missing(const WantedColumn& column, std::span<const std::string_view> found) {
  for (const auto& [commands, name] : names(plant::CommandUnit{}))
    for (const Quantity& quantity : domain::quantities(commands)) {
      if (quantity.column != column.in_file) continue;
      const auto meant = nearest(column.in_file, found);
      const ColumnPlace place{std::string(meant.value_or("NAME")),
                              meant ? unit_in(*meant, quantity) : std::string(quantity.unit())};
      return fmt::format("; where it stands under another name, write columns: {{{}}}",
                         line_of(quantity.key, place));
    }
  return "";  // a map has named it
}

}  // namespace mckibben::input
