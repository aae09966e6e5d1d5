// Units of a column map; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/data/ranges.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/text_layout.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view counts_unit = "count";

std::string contraction_problem(const std::string& unit) {
  if (unit == "1" || unit == "%" || unit == counts_unit) return "";
  if (unit_problem(unit, "m").empty() || unit_problem(unit, "rad").empty()) return "";
  return fmt::format(
      "{0} is not a unit of contraction; wanted is 1, %, count, an angle (deg) or a length (mm): of a sensor "
      "in "
      "another write unit: mm, and factor: how many mm are 1 {0}",
      unit);
}

/// Brings numbers in `unit` to ratios; units that are none have been refused.
void to_ratio(std::vector<double>& values, const std::string& unit, const plant::Rig& rig) {
  double ratio = 1.0;
  if (unit == "1") return;
  if (unit == counts_unit) {
    ratio = plant::count_height_m(rig) / rig.muscle.rest_length_m;
  } else if (unit == "%") {
    for (double& value : values) value /= 100.0;
    return;
  } else if (unit_problem(unit, "m").empty()) {
    convert_units(values, unit, "m");
    ratio = 1.0 / rig.muscle.rest_length_m;
  } else {
    convert_units(values, unit, "rad");
    ratio = rig.joint.wheel_radius_m / rig.muscle.rest_length_m;
  }
  for (double& value : values) value *= ratio;
}

/// The unit at the end of a heading, as in t_ms, `p [kPa]`; empty if none can be told.
std::string unit_at_end(std::string_view heading) {
  const bool closed = heading.ends_with(']') || heading.ends_with(')');
  std::size_t from = heading.find_last_of(closed ? "[(" : "_");
  if (heading.ends_with("))") && from != std::string_view::npos && from > 0)  // of psi(g)
    from = heading.find_last_of('(', from - 1);
  if (from == std::string_view::npos || from == 0) return "";
  std::string_view unit = heading.substr(from + 1);
  if (closed) unit.remove_suffix(1);
  return unit_word(unit);
}

/// A bare letter behind _ may be anything, but for seconds of a time.
std::string unit_in_heading(std::string_view heading, const domain::Quantity& quantity) {
  std::string unit = unit_at_end(heading);
  const bool closed = heading.ends_with(']') || heading.ends_with(')');
  return !closed && unit.size() < 2 && !(quantity.key == "time" && unit == "s") ? "" : unit;
}

/// Whether a heading that says a unit of another kind means it: in brackets, or volts and amperes of a
/// sensor. A 1 is a channel; behind _ all else may be a word, as in p_in.
bool means_its_unit(std::string_view heading, const std::string& unit) {
  if (heading.ends_with(']') || heading.ends_with(')')) return unit != "1";
  return unit_problem(unit, "V").empty() || unit_problem(unit, "mA").empty();
}

/// Which of them the rig's valve takes is asked once the rig is known.
std::string command_problem(const std::string& unit) {
  for (const auto& [each, name] : names(plant::CommandUnit{}))
    if (unit_problem(unit, name).empty()) return "";
  return fmt::format("{} is not a unit of commands; wanted is mA, V or bar{}", unit,
                     unit == "%" ? ": of a duty the valve's V, unit: V with factor and zero" : "");
}

std::string problem_of(const domain::Quantity& quantity, const std::string& unit) {
  if (quantity.is_command() && (quantity.key != "current" || unit == "%")) return command_problem(unit);
  if (quantity.key == "contraction") return contraction_problem(unit);
  if (quantity.key == "angle" && unit == counts_unit) return "";
  if (quantity.key == "time" && unit == date_unit) return "";
  return unit_problem(unit, quantity.unit());
}

}  // namespace

std::string fitting_unit(std::string_view heading, const domain::Quantity& quantity) {
  std::string unit = unit_at_end(heading);
  return unit.empty() || !problem_of(quantity, unit).empty() ? std::string(quantity.unit()) : unit;
}

const domain::Quantity* named_quantity(std::string_view column, const ColumnMap& map,
                                       plant::CommandUnit commands) {
  for (const domain::Quantity& each : domain::quantities(commands))
    if (each.column == column && !map[each].absent()) return &each;
  return nullptr;
}

void check_units(const Source& source, const Node& map, Problems& problems) {
  for (const Node& entry : map.children) {
    const Node *unit = entry.find("unit"), *as = entry.find("as");
    const domain::Quantity* quantity = domain::find_quantity(entry.key);
    if (quantity == nullptr) continue;
    if (as != nullptr && quantity->is_input() && as->text == plant::name_of(domain::Role::reading))
      problems.error(source, as->place,
                     fmt::format("as = reading: {} always drives the simulation; leave out as, or write as: "
                                 "ignored",
                                 entry.key));
    if (unit == nullptr || unit->kind != Node::Kind::scalar) continue;
    const std::string problem = problem_of(*quantity, unit->text);
    if (!problem.empty()) problems.error(source, unit->place, "unit = " + problem);
  }
}

void check_said_units(const Table& table, const ColumnMap& map, const plant::Rig& rig,
                      const std::function<bool(std::string_view quantity)>& says_factor,
                      TableProblems& problems) {
  for (const domain::Quantity& quantity : domain::quantities(rig.command_unit())) {
    const Table::Column* column = table.find(quantity.column);
    const ColumnPlace& place = map[quantity];
    if (column == nullptr || column->kind == CellKind::date) continue;
    const bool in_heading = column->unit.empty();
    const std::string said = in_heading ? unit_in_heading(column->in_file, quantity) : column->unit;
    if (said.empty()) continue;
    const bool is_command_of_another_name = place.absent() && quantity.is_command() &&
                                            (!map["current"].absent() || !map[domain::command_key].absent());
    if (is_command_of_another_name || (says_factor(quantity.key) && place.factor != -1.0) ||
        (!place.absent() && place.column != column->in_file))
      continue;
    const std::string taken = place.absent() ? std::string(quantity.unit()) : place.unit;
    std::vector<double> one{1.0};
    const bool of_mass = quantity.unit() == "N" && unit_problem(said, "kg").empty() && taken.ends_with('f');
    const bool fits = taken == said || unit_problem(said, taken).empty();
    if (of_mass) continue;                                                        // a load cell that shows kg
    if (in_heading && !fits && !means_its_unit(column->in_file, said)) continue;  // it may be no unit at all
    if (taken == said || (fits && (convert_units(one, said, taken), one.front() == 1.0))) continue;
    const std::string what = fmt::format("{} says {}, and it is read in {}; ",
                                         in_heading ? "its heading" : "the table", said, taken);
    if (!problem_of(quantity, said).empty())
      problems.add(
          table, *column, 0,
          fmt::format("{0}write factor: how many {1} are 1 {2}, also if it is 1, and zero: the {2} at {3}",
                      what, taken, said, quantity.key == "contraction" ? "rest length" : "0 " + taken),
          true);
    else {
      // Of what falls, -1 says no unit: then the heading's, and what one of ours is of it.
      const bool falls = place.factor == -1.0;
      std::vector<double> of_ours{place.factor};
      if (falls) convert_units(of_ours, taken, said);
      const ColumnPlace right{column->in_file, said, place.zero, place.factor},
          wrong{column->in_file, said, place.zero, of_ours.front()};
      problems.add(table, *column, 0,
                   fmt::format("{}write columns: {{{}}}, if {} is right{}", what,
                               line_of(quantity.key, right), in_heading ? "it" : "the table",
                               !in_heading ? ""
                               : falls     ? ", or " + line_of(quantity.key, wrong) + " if it is not"
                                           : ", or factor: 1 if it is not"),
                   true);
    }
  }
}

bool is_current(std::string_view unit) {
  return unit_problem(unit, "mA").empty();
}

double ratio_per_unit(const ColumnPlace& contraction, const plant::Rig& rig) {
  std::vector<double> one{1.0};
  if (!contraction.absent()) to_ratio(one, contraction.unit, rig);
  return one.front();
}

namespace {

/// Stamps of a quantity that has its own, in seconds as those of all.
void convert_own_clock(Table& table, const domain::Quantity& quantity, const ColumnPlace& time) {
  Table::Column* own = table.find("time of " + quantity.key);
  if (own == nullptr || time.absent()) return;  // under our name it is in seconds
  for (double& value : own->values) value = (value - time.zero) * time.factor;
  convert_units(own->values, time.unit, "s");
}

}  // namespace

void convert_columns(Table& table, const ColumnMap& map, const plant::Rig& rig) {
  for (Table::Column& column : table.columns) {
    const domain::Quantity* found = named_quantity(column.name, map, rig.command_unit());
    if (found == nullptr) continue;
    const ColumnPlace& place = map[*found];
    convert_own_clock(table, *found, map["time"]);
    if (place.zero != 0.0 || place.factor != 1.0)
      for (double& value : column.values) value = (value - place.zero) * place.factor;
    if (column.kind == CellKind::date) continue;  // was read in seconds
    if (found->key == "contraction") {
      to_ratio(column.values, place.unit, rig);
    } else if (place.unit == counts_unit) {  // of the joint's angle
      const double count_rad = plant::count_height_m(rig) / rig.joint.wheel_radius_m;
      for (double& value : column.values) value *= count_rad;
    } else {
      convert_units(column.values, place.unit, found->unit());
    }
  }
}

namespace {

/// A number of a converted column as its file has it.
double as_in_file(double value, const Table::Column& column, const ColumnMap& map, const plant::Rig& rig) {
  constexpr int digits = 9;
  Table line;
  line.columns.push_back({.name = column.name, .in_file = column.in_file, .values = {0.0, 1.0}});
  convert_columns(line, map, rig);
  const double zero = line.columns.front().values[0], one = line.columns.front().values[1];
  return domain::significant((value - zero) / (one - zero), digits);
}

}  // namespace

void check_numbers(Table& table, const ColumnMap& map, const plant::Rig& rig, TableProblems& problems) {
  std::vector<data::ReadColumn> columns;
  for (const Table::Column& column : table.columns)
    columns.push_back({column.name, &column.values, column.may_miss});
  for (const data::WrongNumber& wrong : data::check_ranges(columns, map, rig)) {
    Table::Column& column = table.columns[wrong.column];
    const double value = column.values[wrong.row];
    const std::vector<std::size_t>& rows = wrong.not_read;
    const auto same = [&](std::size_t row) { return column.values[row] == value; };
    std::string message = wrong.message;
    if (const std::size_t count = rows.size(); count > 0)
      message +=
          fmt::format("{}; taken as not read",
                      count > 1 ? fmt::format(", as {} of {} rows are", count, column.values.size()) : "");
    if (column.may_miss && !wrong.of_column && std::ranges::all_of(rows, same))
      message +=
          fmt::format("; if {0} stands for what was not read, write missing: {0} in the place of its column",
                      domain::write_number(as_in_file(value, column, map, rig)));
    if (rows.empty())
      problems.add(table, column, wrong.row, message, wrong.of_column);
    else
      problems.note(table, column, wrong.row, message);
    for (const std::size_t row : rows) column.values[row] = std::nan("");
  }
}

void check_clock(const Table& table, const ColumnMap& map, const plant::Rig& rig, TableProblems& problems) {
  const Table::Column* column = table.find("time_s");
  if (column != nullptr && problems.count() == 0)
    if (const auto wrong = data::check_clock(column->values, map, rig))
      problems.add(table, *column, wrong->row, wrong->message);
  check_ticks(table, rig.tick_s, problems, std::string("; ") + data::own_clock);
}

}  // namespace mckibben::input
