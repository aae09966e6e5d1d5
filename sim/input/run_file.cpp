// Formats of runs; see the header.
#include <charconv>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/input/column_hints.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/run_file.hpp>
#include <sim/input/stamped_run.hpp>

namespace mckibben::input {
namespace {

/// What is looked for; problems are those of the map, shown in the data set's file.
class Wanted {
 public:
  Wanted(const YamlFile& file, const Node& run, Format format, const ColumnMap& map, const Dataset& dataset,
         Problems& problems)
      : file_(file), run_(run), format_(format), commands_(dataset.rig.command_unit()), problems_(problems) {
    add_time(map);
    if (dataset.own_clock) {
      for (const Wish& wish : stamped_quantities(map, dataset.rig))
        if (wish.quantity->key != "time") add(*wish.quantity, map, wish.drives, !wish.drives);
      return;
    }
    for (const char* key : {"current", "contraction", "muscle_pressure"})
      add(domain::quantity_of(key, commands_), map, key != std::string_view("muscle_pressure"), false);
  }
  const std::vector<WantedColumn>& columns() const { return columns_; }

 private:
  void add_time(const ColumnMap& map) {
    if (!map.settled.absent()) return;
    if (map.rows_are_ticks) {
      if (format_ == Format::csv || format_ == Format::mat) columns_.push_back({"time_s", "time_s", false});
      return;
    }
    if (!map["time"].absent() || format_ == Format::csv || format_ == Format::mat)
      add(domain::quantity_of("time"), map, true, false);
    else if (format_ == Format::lvm)
      columns_.push_back({"time_s", "", true});
    else
      missing(domain::quantity_of("time"), " (or rows_are_ticks: true, if it holds no time)");
  }

  void add(const domain::Quantity& quantity, const ColumnMap& map, bool needed, bool may_miss) {
    const ColumnPlace& place = map[quantity];
    const std::string& name = quantity.column;
    if (!place.absent()) {
      const bool is_date = quantity.key == "time" && place.unit == date_unit;
      columns_.push_back({name, place.column, true, may_miss, is_date});
      if (is_date && format_ != Format::csv) no_dates(quantity.key);
      if (format_ == Format::ascii) check_number(quantity.key, place.column);
    } else if (format_ != Format::ascii) {
      columns_.push_back({name, name, needed, may_miss});
    } else if (needed) {
      missing(quantity, "");
    }
  }

  void missing(const domain::Quantity& quantity, const char* otherwise) {
    problems_.error(
        file_.source, run_.find("file")->place,
        fmt::format("{} has no headings: columns must say where {} stands, for example {}: {{column: 1, "
                    "unit: {}}}{}",
                    run_.find("file")->text, quantity.key, quantity.key, quantity.unit(), otherwise));
  }

  /// Where the map names the column of a quantity.
  const Node& said(std::string_view quantity) const {
    const Node* own = run_.find("columns");
    if (own == nullptr || own->find(quantity) == nullptr) own = file_.root.find("columns");
    return *own->find(quantity);
  }

  void no_dates(std::string_view quantity) {
    problems_.error(
        file_.source, said(quantity).find("unit")->place,
        fmt::format("unit = {}: only a .csv holds dates, not {}", date_unit, run_.find("file")->text));
  }

  void check_number(std::string_view quantity, const std::string& column) {
    std::size_t number = 0;
    const char* const last = column.data() + column.size();
    const auto [end, error] = std::from_chars(column.data(), last, number);
    if (error == std::errc{} && end == last && number >= 1 && number <= 100000) return;
    problems_.error(file_.source, said(quantity).find("column")->place,
                    fmt::format("column = {}: {} has no headings; give the column's number, from 1", column,
                                run_.find("file")->text));
  }

  const YamlFile& file_;
  const Node& run_;
  Format format_;
  plant::CommandUnit commands_;
  Problems& problems_;
  std::vector<WantedColumn> columns_;
};

Table read_as(Format format, const Source& source, const std::vector<WantedColumn>& wanted,
              std::size_t segment, TableProblems& problems) {
  switch (format) {
    case Format::csv:
      return read_csv(source, wanted, problems, hint_of_missing);
    case Format::lvm:
      return read_lvm(source, wanted, segment, problems);
    case Format::mat:
      return read_mat_table(source, wanted, problems);
    case Format::ascii:
      break;
  }
  return read_ascii(source, wanted, problems);
}

void read_table_of(Source source, Format format, const Wanted& wanted, const ColumnMap& map,
                   const Dataset& dataset, Run& run, const std::function<bool(std::string_view)>& says_factor,
                   Problems& problems) {
  problems.opened(source);
  const bool from_windows =
      format == Format::lvm || (format == Format::csv && source.text().find('\0') == std::string::npos);
  if (from_windows && source.first_bad_byte()) source.reread_as_latin1();
  TableProblems found(source, problems);
  Table table = read_as(format, source, wanted.columns(), static_cast<std::size_t>(run.segment), found);
  const std::string command = plant::Channel{&plant::command_of(dataset.rig.command_unit())}.name();
  Table::Column *current = table.find(command), *contraction = table.find("contraction_ratio");
  if (!dataset.own_clock && (current == nullptr || contraction == nullptr)) return;
  if (const Table::Column* time = table.find("time_s"); time != nullptr && map.rows_are_ticks)
    found.add(table, *time, 0, "rows_are_ticks is said, and yet the file holds time_s");
  check_said_units(table, map, dataset.rig, says_factor, found);
  if (dataset.own_clock && (found.count() > 0 || table.columns.empty())) return;
  convert_columns(table, map, dataset.rig);
  if (contraction != nullptr) run.ratio_per_unit = ratio_per_unit(map["contraction"], dataset.rig);
  if (dataset.own_clock) {
    run.measured = measurement_of(table, map, dataset.rig, dataset.recorded, found);
    run.rest_length_m = dataset.rig.muscle.rest_length_m;
    return;
  }
  check_clock(table, map, dataset.rig, found);
  check_numbers(table, map, dataset.rig, found);
  run.current_mA = std::move(current->values);
  run.contraction_ratio = std::move(contraction->values);
  if (Table::Column* pressure = table.find("muscle_pressure_bar")) {
    run.muscle_pressure_Pa = std::move(pressure->values);
    for (double& value : *run.muscle_pressure_Pa) value *= plant::Pa_per_bar;
  }
}

}  // namespace

void read_run_file(const YamlFile& file, const Node& node, const Dataset& dataset, Run& run,
                   Problems& problems) {
  const Place place = node.find("file")->place;
  const std::optional<Format> format = format_of(run.file);
  if (!format) {
    problems.error(file.source, place, fmt::format("file = {}: {}", run.file, format_rule));
    return;
  }
  if (run.segment != 0 && *format != Format::lvm)
    problems.error(file.source, node.find("segment")->place, "segment: only .lvm files have segments");
  const ColumnMap map = merged(dataset.columns, run.columns);
  const std::size_t errors = problems.errors();
  const Wanted wanted(file, node, *format, map, dataset, problems);
  if (problems.errors() > errors) return;
  const auto says_factor = [&](std::string_view quantity) {
    for (const Node* said : {node.find("columns"), file.root.find("columns")})
      if (const Node* place_of = said ? said->find(quantity) : nullptr)
        return place_of->find("factor") != nullptr;
    return false;
  };
  try {
    read_table_of(Source::load((file.source.folder() / run.file).lexically_normal(), most_text_bytes),
                  *format, wanted, map, dataset, run, says_factor, problems);
  } catch (const MissingInput& missing) {
    problems.missing_file(file.source, place, missing.what());
  }
}

}  // namespace mckibben::input
