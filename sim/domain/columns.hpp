// Where a measured file holds what we ask for, and in which units: the map `columns` of a data set, from our
// quantities to the file's columns.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/rig.hpp>
#include <plant/signals.hpp>

namespace mckibben::domain {

/// What a column is to a simulation.
enum class Role { reading, input, ignored, interval };
constexpr auto names(Role) {
  using enum Role;
  return std::array{
      std::pair{reading, std::string_view{"reading"}}, std::pair{input, std::string_view{"input"}},
      std::pair{ignored, std::string_view{"ignored"}}, std::pair{interval, std::string_view{"interval"}}};
}

/// Which rows of a table count: those with these texts in these columns.
struct RowFilter {
  std::map<std::string, std::string> cells;

  bool absent() const { return cells.empty(); }
};

/// One quantity: where it stands and how its numbers are to be read.
struct ColumnPlace {
  std::string column;  ///< empty: not said
  std::string unit;
  double zero = 0.0, factor = 1.0;
  std::string missing{};  ///< a number that stands for none, such as -9999; empty: there is none
  Role as = Role::reading;
  std::string time{};   ///< the column of its own stamps; empty: those of all
  double late_s = 0.0;  ///< its stamps are too late by this
  RowFilter where{};

  bool absent() const { return column.empty(); }
  /// Its stamps are not the rows'.
  bool has_own_clock() const { return !time.empty() || !where.absent() || late_s != 0.0; }

  static void fields(auto& self, auto& visit) {
    visit.required(
        "column", self.column,
        "heading in a .csv, channel (or number) in an .lvm, variable, run.field or data(:,2) in a .mat, "
        "number from 1 in a .txt");
    visit.required(
        "unit", self.unit,
        "unit of its numbers; 1 for a ratio, count for encoder counts, date for times of the day in a .csv");
    visit("zero", self.zero, "1", -1e12, 1e12, "taken from each number, in that unit, first of all");
    visit("factor", self.factor, "1", -1e12, 1e12, "each is multiplied by it then: a gear, a sensor, a sign");
    visit("missing", self.missing, "a number that stands where nothing was read, such as -9999");
    visit(
        "as", self.as,
        "a reading to be compared with, an input that drives the simulation (a given pressure or length; "
        "commands, and forces and torques from outside, always are), or ignored; of time also interval: each "
        "number is the time since the row before");
    visit("time", self.time,
          "column of its own stamps, where it has a clock of its own; in the unit of `time`");
    visit("late", self.late_s, "s", -100.0, 100.0, "by which its stamps are too late");
    visit("where", self.where,
          "a table with one reading a row: the rows that hold this one, as {sensor: laser}");
  }

  void rules(auto& report) const {
    if (factor == 0.0) report("factor", "it must not be 0");
    if (column.empty() && !unit.empty()) report("column", "it must not be empty");
  }
};

/// A table of settled points: a row each, in the order in which they were measured.
struct SettledPoints {
  double each_s = 0.0;  ///< that each took; 0: rows are not settled points

  bool absent() const { return each_s == 0.0; }

  static void fields(auto& self, auto& visit) {
    visit.required("each", self.each_s, "s", 0.1, 1e5,
                   "time that each point took: on the way there for half of it at most, read at its end");
  }
};

inline constexpr std::string_view command_key = "command";

/// A quantity that a data set's columns may hold: its key, and the name and unit that its column has where
/// the map does not say others, those of the signal (plant/signals.hpp).
struct Quantity {
  plant::Channel channel;
  std::string key, column, words;
  std::size_t at = 0;  ///< its place in a map
  bool is_old_current =
      false;  ///< `current`: a command in mA, and the only name of it in data without a clock

  std::string_view unit() const { return channel.signal->unit.name; }
  bool may_be_given() const { return channel.signal->may_be_given; }
  /// An input always drives.
  bool is_input() const { return channel.signal->kind == plant::Kind::input; }
  bool is_command() const { return channel.signal->in_dataset == command_key; }
  /// Of two muscles, or of one; of a joint whose angle is read, or a load's height; time is of all.
  bool belongs(bool pair, bool angle) const;
  bool belongs(const plant::Rig& rig) const { return belongs(rig.pair() != nullptr, rig.has_angle()); }
};

/// One for each signal that has a key in data sets, and for each muscle of two; of rigs that are commanded in
/// that unit, which the columns of commands are called by.
const std::vector<Quantity>& quantities(plant::CommandUnit commands = plant::CommandUnit::mA);
/// Null if there is none of that key.
const Quantity* find_quantity(std::string_view key, plant::CommandUnit commands = plant::CommandUnit::mA);
/// Throws std::invalid_argument if there is none.
const Quantity& quantity_of(std::string_view key, plant::CommandUnit commands = plant::CommandUnit::mA);

struct ColumnMap {
  std::vector<ColumnPlace> places = std::vector<ColumnPlace>(quantities().size());  ///< by Quantity::at
  bool rows_are_ticks = false;
  SettledPoints settled;

  ColumnPlace& operator[](const Quantity& quantity) { return places[quantity.at]; }
  const ColumnPlace& operator[](const Quantity& quantity) const { return places[quantity.at]; }
  ColumnPlace& operator[](std::string_view key) { return places[quantity_of(key).at]; }
  const ColumnPlace& operator[](std::string_view key) const { return places[quantity_of(key).at]; }
  /// That it names, and drives a simulation.
  bool gives(const Quantity& quantity) const {
    const ColumnPlace& place = (*this)[quantity];
    if (place.absent() || place.as == Role::ignored) return false;
    return place.as == Role::input || quantity.is_input();
  }
  bool gives(std::string_view key) const { return gives(quantity_of(key)); }
  /// What of a muscle's pressure it gives; 0: of one muscle.
  plant::GivenPressure given_pressure(std::size_t muscle) const;

  static void fields(auto& self, auto& visit) {
    for (const Quantity& quantity : quantities()) visit(quantity.key, self[quantity], quantity.words);
    visit("rows_are_ticks", self.rows_are_ticks, "the file holds no time: its rows are one tick apart");
    visit("settled", self.settled, "the rows are settled points, in the order in which they were measured");
  }

  void rules(auto& report) const {
    if (rows_are_ticks && !(*this)["time"].absent())
      report("rows_are_ticks", "and yet a column of time is named");
    if (!settled.absent() && (rows_are_ticks || !(*this)["time"].absent()))
      report("settled", "and yet the file's rows are said to be ticks, or to have times");
    if ((*this)["time"].late_s != 0.0) report("time", "late is written for a column that is stamped late");
    for (const Quantity& quantity : quantities())
      if (quantity.key != "time" && (*this)[quantity].as == Role::interval)
        report(quantity.key, "only time is read as intervals");
    for (const Quantity& quantity : quantities())
      for (const Quantity& other : quantities()) {
        if (other.at == quantity.at) break;
        if (const ColumnPlace& place = (*this)[quantity];
            !place.absent() && place.column == (*this)[other].column && place.where.absent())
          report(quantity.key, std::string("it stands in the same column as ").append(other.key));
      }
  }
};

/// A text as YAML takes it: in quotes, unless it is letters, digits and _.
std::string yaml_scalar(const std::string& text);

/// `QUANTITY: {column: C, unit: U, ...}`, as a data set's file says it.
std::string line_of(std::string_view quantity, const ColumnPlace& place);

/// `own` where it says something, otherwise `shared`.
ColumnMap merged(const ColumnMap& shared, const ColumnMap& own);

}  // namespace mckibben::domain
