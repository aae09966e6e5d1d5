// Formats of runs; see the header.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/arranged.hpp>
#include <sim/input/column_hints.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/readable.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/run_file.hpp>
#include <sim/input/stamped_run.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

/// What is looked for in a run's file.
std::vector<WantedColumn> wanted_of(const ColumnMap& map, const Dataset& dataset, const Run& run,
                                    Format format) {
  std::vector<WantedColumn> wanted;
  const auto add = [&](const domain::Quantity& quantity, bool needed, bool may_miss) {
    const ColumnPlace& place = map[quantity];
    CellKind kind = CellKind::number;
    if (quantity.key == "time" && place.zero == 0.0) kind = CellKind::stamp;
    if (quantity.key == "time" && place.unit == date_unit) kind = CellKind::date;
    if (place.absent())
      wanted.push_back({quantity.column, quantity.column, needed, may_miss, kind});
    else
      wanted.push_back({quantity.column, place.column, true, may_miss, kind, !place.time.empty()});
  };
  const domain::Quantity& time = domain::quantity_of("time");
  if (map.rows_are_ticks && format != Format::lvm)
    wanted.push_back({time.column, time.column, false});
  else if (format == Format::lvm && map["time"].absent() && map.settled.absent() && !map.rows_are_ticks)
    wanted.push_back({time.column, "", true});
  else if (map.settled.absent() && !map.rows_are_ticks)
    add(time, true, dataset.own_clock);
  const plant::CommandUnit commands = dataset.rig.command_unit();
  if (dataset.own_clock) {
    for (const Wish& wish : stamped_quantities(map, dataset.rig))
      if (wish.quantity->key != "time") add(*wish.quantity, wish.drives, true);
  } else {
    for (const char* key : {"current", "contraction", "muscle_pressure"})
      add(domain::quantity_of(key, commands), key != std::string_view("muscle_pressure"), false);
  }
  for (WantedColumn& besides : wanted_besides(map, run)) wanted.push_back(std::move(besides));
  return wanted;
}

/// Numbers where texts are looked for.
void label_numbers(Table& table) {
  for (Table::Column& column : table.columns)
    if (column.kind == CellKind::label)
      for (double& value : column.values) value = column.label(domain::write_number(value));
}

Table read_as(Format format, const Source& source, const std::vector<WantedColumn>& wanted, const Run& run,
              TableProblems& problems) {
  if (format == Format::text) return read_text(source, wanted, problems, hint_of_missing);
  Table table = format == Format::lvm
                    ? read_lvm(source, wanted, static_cast<std::size_t>(run.segment), problems)
                    : read_mat_table(source, wanted, problems);
  for (Table::Column& column : table.columns)
    if (const auto asked = std::ranges::find(wanted, column.name, &WantedColumn::name); asked != wanted.end())
      column.kind = asked->kind;
  label_numbers(table);
  return table;
}

/// What every row counts for, so that none may be left out.
bool needs_all_rows(const ColumnMap& map, const Dataset& dataset, const Run& run) {
  return !dataset.own_clock || map.rows_are_ticks || !map.settled.absent() || !run.cut.empty() ||
         map["time"].as == domain::Role::interval;
}

/// A duty that only fills, beside another one that nobody reads: of two valves it is half of the command.
void look_for_venting(const Table& table, const Table::Column& command, const plant::Valve& valve,
                      TableProblems& found) {
  if (!valve.is_on_off() || valve.ports != plant::Ports::two || !names_duty(command.in_file)) return;
  const auto other = std::ranges::find_if(table.others, [](const auto& name) { return names_duty(name); });
  const double rests = std::lerp(valve.zero_command, valve.span_command, 0.5),
               slack = 1e-6 * (valve.span_command - valve.zero_command);
  if (other == table.others.end() || table.lines.empty() ||
      std::ranges::any_of(command.values, [&](double value) { return value < rests - slack; }))
    return;
  found.note({table.lines.front(), 1},
             fmt::format("{0} never vents, and {1} is not read: if that one vents, write into the table one "
                         "column duty of both, {0} less {1}",
                         command.in_file, *other));
}

void read_table_of(const Source& source, const ColumnMap& map, const Dataset& dataset, Run& run,
                   const std::function<bool(std::string_view)>& says_factor, Problems& problems) {
  problems.opened(source);
  const Format format = format_of(run.file, source.text());
  TableProblems found(source, problems);
  if (source.thinned().step > 1 && (format != Format::text || needs_all_rows(map, dataset, run)))
    return found.add(
        {}, fmt::format("larger than {} MB or {} rows, so that only some rows are read; rows without stamps, "
                        "intervals and cut: need all: put each run into a file of its own",
                        most_text_bytes >> 20U, most_rows));
  Table table = read_as(format, source, wanted_of(map, dataset, run, format), run, found);
  Run chosen = run;  // an .lvm has found its segment
  if (format == Format::lvm && run.cut.empty()) chosen.segment = 0;
  if (found.count() == 0) drop_missing(table, map, dataset.rig.command_unit(), found);
  if (found.count() == 0) keep_where(table, run, found);
  if (found.count() == 0 && dataset.own_clock) order_rows(table, map, found);
  if (found.count() == 0) keep_segment(table, map, chosen, found);
  if (found.count() > 0 && table.columns.empty()) return;
  if (dataset.own_clock && found.count() == 0)
    if (const std::string done = spread_stamps(table, map); !done.empty())
      found.note(table.lines.empty() ? nowhere : Place{table.lines.front(), 1}, done);
  const std::string command = plant::Channel{&plant::command_of(dataset.rig.command_unit())}.name();
  Table::Column *current = table.find(command), *contraction = table.find("contraction_ratio");
  if (!dataset.own_clock && (current == nullptr || contraction == nullptr)) return;
  if (const Table::Column* time = table.find("time_s"); time != nullptr && map.rows_are_ticks)
    found.add(table, *time, 0, "rows_are_ticks is said, and yet the file holds time_s");
  check_said_units(table, map, dataset.rig, says_factor, found);
  if (dataset.own_clock && (found.count() > 0 || table.columns.empty())) return;
  convert_columns(table, map, dataset.rig);
  current = table.find(command);
  if (current != nullptr) look_for_venting(table, *current, dataset.rig.valve, found);
  if (found.count() == 0) merge_clocks(table, map, dataset.rig);
  if (found.count() == 0) keep_window(table, run, found);
  if (Table::Column* time = table.find("time_s"); time != nullptr && !dataset.own_clock && run.from_s > 0.0)
    for (double& at_s : time->values) at_s -= run.from_s;  // its first row is tick 0
  current = table.find(command), contraction = table.find("contraction_ratio");
  if (contraction != nullptr) run.ratio_per_unit = ratio_per_unit(map["contraction"], dataset.rig);
  if (dataset.own_clock) {
    run.measured = measurement_of(table, map, dataset.rig, dataset.recorded, found);
    run.rest_length_m = dataset.rig.muscle.rest_length_m;
    return;
  }
  check_clock(table, map, dataset.rig, found);
  check_numbers(table, map, dataset.rig, found);
  run.current_mA = std::move(current->values);
  run.read("contraction", std::move(contraction->values));
  if (Table::Column* pressure = table.find("muscle_pressure_bar"))
    for (double& value : run.read("muscle_pressure", std::move(pressure->values)).values)
      value *= plant::Pa_per_bar;
}

}  // namespace

void read_run_file(const YamlFile& file, const Node& node, const Dataset& dataset, Run& run,
                   std::uintmax_t together, Problems& problems) {
  const Place place = node.find("file")->place;
  const ColumnMap map = merged(dataset.columns, run.columns);
  const auto says_factor = [&](std::string_view quantity) {
    for (const Node* said : {node.find("columns"), file.root.find("columns")})
      if (const Node* place_of = said ? said->find(quantity) : nullptr)
        return place_of->find("factor") != nullptr;
    return false;
  };
  try {
    const fs::path file_of_run = (file.source.folder() / run.file).lexically_normal();
    const bool all_rows = needs_all_rows(map, dataset, run);
    read_table_of(load_table(file_of_run, run.sheet, all_rows ? 0 : together), map, dataset, run, says_factor,
                  problems);
  } catch (const MissingInput& missing) {
    problems.missing_file(file.source, place, missing.what());
  } catch (const BadInput& bad) {
    problems.adopt(bad.problems());
  }
}

}  // namespace mckibben::input
