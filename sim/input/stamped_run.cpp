// Columns of runs with a clock of their own; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/stamped_run.hpp>

namespace mckibben::input {
namespace {

using domain::ColumnMap, domain::ColumnPlace, domain::Measurement, domain::Quantity, domain::Role;

constexpr long least_to_begin = 10;  // readings, for place, speed and acceleration of the first instant

bool is_input(const ColumnPlace& place) {
  return !place.absent() && place.as == Role::input;
}

/// What runs on a rig with so many muscles can be made of.
bool belongs(const Quantity& quantity, bool pair) {
  constexpr std::array of_one{"current", "command", "contraction", "force", "muscle_pressure"};
  constexpr std::array of_two{"command_1", "command_2", "angle", "muscle_pressure_1", "muscle_pressure_2"};
  const auto is = [&](const char* key) { return quantity.key == key; };
  return quantity.key == "time" || (pair ? std::any_of(of_two.begin(), of_two.end(), is)
                                         : std::any_of(of_one.begin(), of_one.end(), is));
}

/// The side of a muscle, from 0: what commands it, and its pressure.
const ColumnPlace& command_of(const ColumnMap& map, bool pair, std::size_t side) {
  if (pair) return side == 0 ? map.command_1 : map.command_2;
  return map.command.absent() ? map.current : map.command;
}
const ColumnPlace& pressure_of(const ColumnMap& map, bool pair, std::size_t side) {
  if (pair) return side == 0 ? map.muscle_pressure_1 : map.muscle_pressure_2;
  return map.muscle_pressure;
}

const plant::Valve& valve_of(const plant::Rig& rig, std::size_t side) {
  return side == 0 ? rig.valve : rig.pair()->opposite.valve;
}

/// What is wrong with the unit of a command to this valve, or nothing.
std::string unit_of_command_problem(const ColumnPlace& command, const plant::Valve& valve) {
  if (is_current(command.unit)) return "";
  if (!valve.has_own_command())
    return fmt::format(
        "unit = {}: the rig's valve is commanded with a current; if it is not, its "
        "zero_command and span_command must be said",
        command.unit);
  const std::string_view wanted = plant::name_of(valve.zero_command.unit);
  return unit_problem(command.unit, wanted).empty()
             ? ""
             : fmt::format("unit = {}: the rig's valve is commanded in {}", command.unit, wanted);
}

/// Whether the column must be there: what drives the rig must.
bool drives(const Quantity& quantity, const ColumnMap& map, bool pair) {
  const auto commands = [&](std::size_t side) { return !is_input(pressure_of(map, pair, side)); };
  if (quantity.key == "time") return true;
  if (quantity.key == "current" || quantity.key == "command" || quantity.key == "command_1")
    return commands(0);
  if (quantity.key == "command_2") return commands(1);
  return is_input(map.*quantity.place);
}

}  // namespace

bool has_own_clock(const ColumnMap& map, const plant::Rig& rig) {
  if (!rig.lifts_a_load() || !map.settled.absent()) return true;
  return std::any_of(domain::quantities.begin(), domain::quantities.end(), [&](const Quantity& quantity) {
    const ColumnPlace& place = map.*quantity.place;
    constexpr std::array ticked{"time", "current", "contraction", "muscle_pressure"};
    return !place.absent() && (place.as != Role::reading ||
                               std::find(ticked.begin(), ticked.end(), quantity.key) == ticked.end());
  });
}

std::vector<Wish> stamped_quantities(const ColumnMap& map, const plant::Rig& rig) {
  const bool pair = rig.pair() != nullptr;
  std::vector<Wish> wishes;
  for (const Quantity& quantity : domain::quantities) {
    const ColumnPlace& place = map.*quantity.place;
    if (!belongs(quantity, pair) || (!place.absent() && place.as == Role::ignored)) continue;
    const bool is_command = quantity.unit == "mA", needed = drives(quantity, map, pair);
    const bool under_the_other_name =
        quantity.key == "command" ? place.absent() : quantity.key == "current" && !map.command.absent();
    if (!under_the_other_name && (needed || !is_command)) wishes.push_back({&quantity, needed});
  }
  return wishes;
}

void check_roles(const YamlFile& file, const Node& run, const ColumnMap& map, const plant::Rig& rig,
                 Problems& problems) {
  const bool pair = rig.pair() != nullptr;
  const auto complain = [&](std::string_view key, const std::string& message) {
    const Node *own = run.find("columns"), *shared = file.root.find("columns");
    const Node* said = own != nullptr ? own->find(key) : nullptr;
    if (said == nullptr && shared != nullptr) said = shared->find(key);
    problems.error(file.source, said != nullptr ? said->place : run.place,
                   fmt::format("{}: {}", key, message));
  };
  for (const Quantity& quantity : domain::quantities) {
    const ColumnPlace& place = map.*quantity.place;
    if (place.absent()) continue;
    if (!belongs(quantity, pair))
      complain(quantity.key, pair
                                 ? "the rig has two muscles: command_1, command_2, angle, muscle_pressure_1, "
                                   "muscle_pressure_2"
                                 : "the rig has one muscle: command, contraction, force, muscle_pressure");
    else if (place.as == Role::input && !quantity.may_be_given)
      complain(quantity.key, "it can only be a reading");
  }
  if (!pair && !map.current.absent() && !map.command.absent())
    complain("command", "current is a command in mA; give one of the two");
  for (std::size_t side = 0; side < (pair ? 2 : 1); ++side) {
    const ColumnPlace& command = command_of(map, pair, side);
    const char* single = map.command.absent() ? "current" : "command";
    const char* key = !pair ? single : side == 0 ? "command_1" : "command_2";
    if (is_input(pressure_of(map, pair, side)) && !command.absent() && command.as != Role::ignored)
      complain(
          key,
          "the muscle's pressure is the input, so that there is no valve to be commanded; say as: ignored");
    else if (!is_input(pressure_of(map, pair, side)) && !command.absent() && command.as == Role::ignored)
      complain(key, "nothing else drives the muscle");
    else if (!command.absent() && command.as != Role::ignored)
      if (const std::string why = unit_of_command_problem(command, valve_of(rig, side)); !why.empty())
        complain(key, why);
  }
  if (rig.holds_a_length() && !is_input(map.contraction))
    complain("contraction",
             "the rig's muscle is held (mechanics: {kind: held_length}): say which length, as: input");
}

namespace {

/// The columns of a table as a measurement, checked one by one.
class Assembling {
 public:
  Assembling(const Table& table, const ColumnMap& map, const plant::Rig& rig, TableProblems& problems)
      : table_(table), map_(map), rig_(rig), problems_(problems), pair_(rig.pair() != nullptr) {}

  Measurement operator()(const domain::Recorded& recorded) {
    measured_.recorded = recorded;
    time();
    check_numbers(table_, map_, rig_, problems_);
    for (std::size_t side = 0; side < (pair_ ? 2 : 1); ++side) drive(side);
    measured_.length_is_given = is_input(map_.contraction);
    measured_.contraction_ratio = take("contraction_ratio");
    measured_.angle_rad = take("angle_rad");
    measured_.force_N = take("force_N");
    measured_.angle_in_degrees = map_.angle.unit == "deg";
    measured_.counted = (pair_ ? map_.angle : map_.contraction).unit == "count";
    beginning();
    return std::move(measured_);
  }

 private:
  void time() {
    const Table::Column* column = table_.find("time_s");
    measured_.point_s = map_.settled.each_s;
    if (column == nullptr || measured_.point_s > 0.0) {
      const double row_s = measured_.point_s > 0.0 ? measured_.point_s : rig_.tick_s;
      for (std::size_t k = 0; k < table_.columns.front().values.size(); ++k)
        measured_.time_s.push_back(static_cast<double>(k) * row_s);
      return;
    }
    measured_.time_s = column->values;
    for (std::size_t k = 1; k < measured_.time_s.size(); ++k) {
      const double now_s = measured_.time_s[k], before_s = measured_.time_s[k - 1];
      if (now_s > before_s || std::isnan(now_s) || std::isnan(before_s)) continue;
      problems_.add(table_, *column, k,
                    fmt::format("time_s = {} {}: stamps must ascend", domain::write_number(now_s),
                                now_s == before_s ? "is repeated" : "runs backwards"));
      return;  // all later rows would repeat it
    }
  }

  /// What is judged, and what a first state is told from.
  void beginning() {
    const double lasting_s = measured_.time_s.back() - measured_.time_s.front();
    if (measured_.recorded.skip_s > 0.0 && measured_.recorded.skip_s >= lasting_s)
      problems_.add({}, fmt::format("skip = {} s leaves nothing of this run, which lasts {:.3f} s",
                                    domain::write_number(measured_.recorded.skip_s), lasting_s));
    const auto& read = measured_.contraction_ratio;
    const auto known = std::count_if(read.begin(), read.end(), [](double e) { return !std::isnan(e); });
    if (measured_.recorded.start == domain::Start::moving && known < least_to_begin)
      problems_.add({}, fmt::format("start = moving needs at least {} readings of contraction; there are {}",
                                    least_to_begin, known));
  }

  void drive(std::size_t side) {
    Measurement::Side& into = measured_.sides[side];
    const std::string number = pair_ ? (side == 0 ? "_1" : "_2") : "";
    into.pressure_is_given = is_input(pressure_of(map_, pair_, side));
    into.muscle_pressure_Pa = take("muscle_pressure" + number + "_bar");
    for (double& value : into.muscle_pressure_Pa) value *= plant::Pa_per_bar;
    into.current_mA = take("current" + number + "_mA");
  }

  std::vector<double> take(std::string_view name) const {
    const Table::Column* column = table_.find(name);
    return column != nullptr ? column->values : std::vector<double>{};
  }

  const Table& table_;
  const ColumnMap& map_;
  const plant::Rig& rig_;
  TableProblems& problems_;
  bool pair_;
  Measurement measured_;
};

}  // namespace

Measurement measurement_of(Table& table, const ColumnMap& map, const plant::Rig& rig,
                           const domain::Recorded& recorded, TableProblems& problems) {
  return Assembling(table, map, rig, problems)(recorded);
}

}  // namespace mckibben::input
