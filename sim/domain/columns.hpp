// Where a measured file holds what we ask for, and in which units: the map `columns` of a data set, from our
// quantities to the file's columns.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <plant/signals.hpp>

namespace mckibben::domain {

/// What a column is to a simulation.
enum class Role { reading, input, ignored };
constexpr auto names(Role) {
  using enum Role;
  return std::array{std::pair{reading, std::string_view{"reading"}},
                    std::pair{input, std::string_view{"input"}},
                    std::pair{ignored, std::string_view{"ignored"}}};
}

/// One quantity: where it stands and how its numbers are to be read.
struct ColumnPlace {
  std::string column;  ///< empty: not said
  std::string unit;
  double zero = 0.0, factor = 1.0;
  Role as = Role::reading;

  bool absent() const { return column.empty(); }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required(
        "column", self.column,
        "heading in a .csv, channel (or number) in an .lvm, variable, run.field or data(:,2) in a .mat, "
        "number from 1 in a .txt");
    visit.required(
        "unit", self.unit,
        "unit of its numbers; 1 for a ratio, count for encoder counts, date for times of the day in a .csv");
    visit("zero", self.zero, "1", -1e12, 1e12, "taken from each number, in that unit, first of all");
    visit("factor", self.factor, "1", -1e12, 1e12, "each is multiplied by it then: a gear, a sensor, a sign");
    visit("as", self.as,
          "a reading to be compared with, an input that drives the simulation (a given pressure or length; a "
          "command "
          "always is), or ignored");
  }

  template <class Report>
  void rules(Report& report) const {
    if (factor == 0.0) report("factor", "it must not be 0");
    if (column.empty() && !unit.empty()) report("column", "it must not be empty");
  }
};

/// A table of settled points: a row each, in the order in which they were measured.
struct SettledPoints {
  double each_s = 0.0;  ///< that each took; 0: rows are not settled points

  bool absent() const { return each_s == 0.0; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("each", self.each_s, "s", 0.1, 1e5,
                   "time that each point took: on the way there for half of it at most, read at its end");
  }
};

struct ColumnMap {
  ColumnPlace time, current, command, contraction, muscle_pressure, force;
  ColumnPlace command_1, command_2, angle, muscle_pressure_1, muscle_pressure_2;
  bool rows_are_ticks = false;
  SettledPoints settled;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("time", self.time, "time since the first row");
    visit("current", self.current, "current to the valve");
    visit("contraction", self.contraction,
          "height of the load: ratio, angle of the wheel, travel of the rope, or encoder counts");
    visit("muscle_pressure", self.muscle_pressure, "gauge pressure in the muscle, where it was measured");
    visit("rows_are_ticks", self.rows_are_ticks, "the file holds no time: its rows are one tick apart");
    visit("settled", self.settled, "the rows are settled points, in the order in which they were measured");
    visit("command", self.command, "command to the valve; current, in data with a clock of their own");
    visit("force", self.force, "force of the muscle's cord");
    visit("command_1", self.command_1, "of two muscles: command to the valve of muscle 1");
    visit("command_2", self.command_2, "of two muscles: command to the valve of muscle 2");
    visit("angle", self.angle, "of two muscles: joint angle, positive as muscle 1 contracts");
    visit("muscle_pressure_1", self.muscle_pressure_1, "of two muscles: gauge pressure in muscle 1");
    visit("muscle_pressure_2", self.muscle_pressure_2, "of two muscles: gauge pressure in muscle 2");
  }

  template <class Report>
  void rules(Report& report) const;
};

/// A quantity of the map: its key, and the name and unit that its column has where the map does not say
/// others, those of the signal (plant/signals.hpp).
struct Quantity {
  std::string key, column;
  std::string_view unit;
  ColumnPlace ColumnMap::*place;
  bool may_be_given;  ///< it may be an input
};

/// Of the signal of that key; of a pair's muscle, if one is named.
inline Quantity quantity_of_signal(std::string_view signal, ColumnPlace ColumnMap::*place,
                                   std::size_t muscle = 0) {
  const plant::Channel channel{&plant::signal_of(signal), muscle};
  return {channel.key_in_dataset(), channel.name(), channel.signal->unit.name, place,
          channel.signal->may_be_given};
}

inline const std::array<Quantity, 11> quantities{
    {quantity_of_signal("time", &ColumnMap::time),
     {"current", "current_mA", "mA", &ColumnMap::current, true},  // a command, in data without a clock
     quantity_of_signal("contraction_ratio", &ColumnMap::contraction),
     quantity_of_signal("muscle_pressure", &ColumnMap::muscle_pressure),
     quantity_of_signal("current", &ColumnMap::command),
     quantity_of_signal("force", &ColumnMap::force),
     quantity_of_signal("current", &ColumnMap::command_1, 1),
     quantity_of_signal("current", &ColumnMap::command_2, 2),
     quantity_of_signal("angle", &ColumnMap::angle),
     quantity_of_signal("muscle_pressure", &ColumnMap::muscle_pressure_1, 1),
     quantity_of_signal("muscle_pressure", &ColumnMap::muscle_pressure_2, 2)}};

template <class Report>
void ColumnMap::rules(Report& report) const {
  if (rows_are_ticks && !time.absent()) report("rows_are_ticks", "and yet a column of time is named");
  if (!settled.absent() && (rows_are_ticks || !time.absent()))
    report("settled", "and yet the file's rows are said to be ticks, or to have times");
  for (const Quantity& quantity : quantities)
    for (const Quantity* other = quantities.data(); other->key != quantity.key; ++other)
      if (const ColumnPlace& place = this->*quantity.place;
          !place.absent() && place.column == (this->*other->place).column)
        report(quantity.key, std::string("it stands in the same column as ").append(other->key));
}

/// A text as YAML takes it: in quotes, unless it is letters, digits and _.
std::string yaml_scalar(const std::string& text);

/// `QUANTITY: {column: C, unit: U, ...}`, as a data set's file says it.
std::string line_of(std::string_view quantity, const ColumnPlace& place);

/// `own` where it says something, otherwise `shared`.
ColumnMap merged(const ColumnMap& shared, const ColumnMap& own);

}  // namespace mckibben::domain
