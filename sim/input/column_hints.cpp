// See the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <sim/input/column_hints.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

using Values = std::vector<double>;
using domain::quantities, domain::Quantity;

constexpr const char* own_clock =
    "if the recorder had a clock of its own, the data set says start: settled, or start: moving";

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Numbers out of range up to which each is told by itself.
constexpr std::ptrdiff_t few = 3;

/// The unit at the end of a heading, as in U_mA, `I [A]` or t(ms); ours if there is none that fits.
std::string unit_in(std::string_view heading, const Quantity& quantity) {
  if (heading.ends_with(']') || heading.ends_with(')')) heading.remove_suffix(1);
  const std::string_view unit = heading.substr(std::min(heading.find_last_of("_[( ") + 1, heading.size()));
  if (unit.size() == heading.size() || quantity.unit == "1" || !unit_problem(unit, quantity.unit).empty())
    return std::string(quantity.unit);
  return std::string(unit);
}

/// Readings that are missing lie anywhere.
bool within(const Values& values, double lowest, double highest) {
  return std::none_of(values.begin(), values.end(), [&](double v) { return v < lowest || v > highest; });
}

/// The unit of a clock whose rows are so many ticks of our seconds apart; empty if it is none.
std::string clock_unit(double ticks) {
  for (const auto& [factor, unit] : {std::pair{1e3, "ms"}, {1e6, "us"}, {1e9, "ns"}, {1.0 / 60.0, "min"}})
    if (std::abs(ticks / factor - 1.0) < 1e-3) return unit;
  return "";
}

/// The step [s] of a clock that goes evenly; 0 if it does not.
double even_step_s(const Values& time_s) {
  if (time_s.size() < 3) return 0.0;
  const double step_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  for (std::size_t k = 1; k < time_s.size(); ++k)
    if (std::abs(time_s[k] - time_s[k - 1] - step_s) > 1e-3 * std::abs(step_s)) return 0.0;
  return step_s;
}

ColumnMap with_our_names(ColumnMap map) {
  for (const Quantity& quantity : quantities)
    if (ColumnPlace& place = map.*quantity.place; place.absent())
      place = {std::string(quantity.column), std::string(quantity.unit)};
  return map;
}

}  // namespace

std::string hint_of_missing(const WantedColumn& column, std::span<const std::string_view> found) {
  const auto quantity = std::find_if(quantities.begin(), quantities.end(),
                                     [&](const Quantity& each) { return each.column == column.in_file; });
  if (quantity == quantities.end()) return "";  // a map has named it
  const auto meant = nearest(column.in_file, found);
  const ColumnPlace place{std::string(meant.value_or("NAME")),
                          meant ? unit_in(*meant, *quantity) : std::string(quantity->unit)};
  return fmt::format("; where it stands under another name, write columns: {{{}}}",
                     line_of(quantity->key, place));
}

ColumnChecks::ColumnChecks(const Table& table, const ColumnMap& map, TableProblems& problems)
    : table_(table),
      has_own_command_(!map.command.absent()),
      map_(with_our_names(map)),
      problems_(problems) {}

void ColumnChecks::time(double tick_s) {
  const Table::Column* column = table_.find("time_s");
  const double step_s = column == nullptr || problems_.count() > 0 ? 0.0 : even_step_s(column->values);
  const bool right = std::abs(step_s / tick_s - 1.0) < 1e-3;
  ColumnPlace meant = map_.time;
  if (const std::string unit = clock_unit(step_s / tick_s); !unit.empty() && meant.unit == "s") {
    meant = {meant.column, unit, meant.zero, meant.factor};
    problems_.add(
        table_, *column, 1,
        fmt::format("time_s = {}: its rows are {:.6g} s apart, the rig's ticks {:.6g} s; this looks "
                    "like {}, not s; write columns: {{{}}}",
                    write_number(column->values[1]), step_s, tick_s, unit, line_of("time", meant)));
  } else if (right && column->values.front() != 0.0 && meant.unit == "s" && meant.factor == 1.0) {
    meant.zero += column->values.front();
    problems_.add(table_, *column, 0,
                  fmt::format("time_s = {} is not the beginning: expected is 0; if the run begins there, "
                              "write columns: {{{}}}",
                              write_number(column->values.front()), line_of("time", meant)));
  } else if (step_s > 0.0 && !right) {
    problems_.add(
        table_, *column, 1,
        fmt::format("time_s = {} is not a tick of {} ms: all rows are {:.6g} ms apart; if that is "
                    "the rig's tick, its file must say so: tick: {:.6g} ms; {}",
                    write_number(column->values[1]), 1e3 * tick_s, 1e3 * step_s, 1e3 * step_s, own_clock));
  } else {
    check_ticks(table_, tick_s, problems_, std::string("; ") + own_clock);
  }
}

void ColumnChecks::current(double largest_mA) {
  constexpr double slack_mA = 1e-9;  // shortest digits of a sum of DAC steps
  range(*table_.find("current_mA"), 0.0, largest_mA + slack_mA, "range of the rig's DAC",
        fmt::format("is it in another unit or another column? columns: {{{}}} would say so",
                    line_of("current", map_.current)));
}

// No DAC of ours made it; what lies a whole range outside is of another valve, or in another unit.
void ColumnChecks::command(const Table::Column& column, const std::string& key, const ColumnPlace& place,
                           const plant::Valve& valve) {
  constexpr double digits = 1e9;  // those of a table come back
  const double zero = valve.zero_command.value, span = valve.span_command.value;
  Table::Column commands = column;
  commands.name = key;
  for (double& value : commands.values) value = std::round(digits * valve.command_for(value)) / digits;
  range(commands, 2.0 * zero - span, 2.0 * span - zero,
        fmt::format("the rig's valve takes {:g} to {:g} {}", zero, span,
                    plant::name_of(valve.zero_command.unit)),
        fmt::format("is it in another unit or another column? columns: {{{}}} would say so",
                    line_of(key, place)));
}

void ColumnChecks::contraction(double lowest, double highest, double largest_mA) {
  const Table::Column& column = *table_.find("contraction_ratio");
  const Table::Column* current = has_own_command_ ? nullptr : table_.find("current_mA");
  const Table::Column* pressure = table_.find("muscle_pressure_bar");
  ColumnPlace meant = map_.contraction;
  std::string hint;
  const auto exchanged_with = [&](std::string_view quantity, ColumnPlace other) {
    std::swap(meant.column, other.column);
    hint = fmt::format("it looks exchanged with {}; write columns: {{{}, {}}}", quantity,
                       line_of("contraction", meant), line_of(quantity, other));
  };
  if (current != nullptr && within(current->values, lowest, highest) &&
      within(column.values, 0.0, largest_mA)) {
    exchanged_with("current", map_.current);
  } else if (pressure != nullptr && within(pressure->values, lowest, highest)) {
    exchanged_with("muscle_pressure", map_.muscle_pressure);
  } else if (within(column.values, -infinite, 0.02)) {
    meant.factor = -meant.factor;
    hint =
        fmt::format("if it falls as the muscle contracts, its sign is the other one; write columns: {{{}}}",
                    line_of("contraction", meant));
  } else if (meant.unit != "1" && meant.zero == 0.0 && within(column.values, highest, infinite)) {
    hint = fmt::format(
        "does it read something else than 0 at rest length? Then columns: {{{}}} says so with zero: and that "
        "reading, and with factor: -1 if it falls as the muscle contracts",
        line_of("contraction", meant));
  } else {
    if (meant.unit == "1") meant = {meant.column, "mm", meant.zero, meant.factor};
    hint = fmt::format(
        "is it in another unit (\"%\", mm, deg, count), or its zero elsewhere? Then write so, "
        "as in columns: {{{}}}",
        line_of("contraction", meant));
  }
  range(column, lowest, highest, "what a muscle can do", hint);
}

void ColumnChecks::pressure(double lowest_bar, double highest_bar) {
  const Table::Column* column = table_.find("muscle_pressure_bar");
  if (column == nullptr) return;
  ColumnPlace meant = map_.muscle_pressure;
  if (meant.unit == "bar") meant = {meant.column, "kPa", meant.zero, meant.factor};
  range(*column, lowest_bar, highest_bar, "what a gauge can show",
        fmt::format("is it in another unit (kPa, mbar, Pa, psi)? Then write so, as in columns: {{{}}}",
                    line_of("muscle_pressure", meant)));
}

void ColumnChecks::range(const Table::Column& column, double lowest, double highest, std::string_view meaning,
                         const std::string& hint) {
  const auto outside = [&](double value) { return value < lowest || value > highest; };
  const Values& values = column.values;
  const auto count = std::count_if(values.begin(), values.end(), outside);
  if (count <= few) {
    check_range(table_, column, lowest, highest, meaning, problems_);
    return;
  }
  const auto first = std::find_if(values.begin(), values.end(), outside);
  double least = infinite, most = -infinite;
  for (const double value : values) {
    if (value < least) least = value;
    if (value > most) most = value;
  }
  problems_.add(table_, column, static_cast<std::size_t>(first - values.begin()),
                fmt::format("{} = {} is out of range: {:.6g} to {:.6g} ({}), as in {} of {} rows, which go "
                            "from {:.6g} to {:.6g}; {}",
                            column.name, write_number(*first), lowest, highest, meaning, count, values.size(),
                            least, most, hint));
}

}  // namespace mckibben::input
