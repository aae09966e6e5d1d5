// Columns of runs with a clock of their own; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/clocks.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/arranged.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/stamped_run.hpp>

namespace mckibben::input {
namespace {

using domain::ColumnMap, domain::ColumnPlace, domain::Measurement, domain::Quantity, domain::Role;

constexpr long least_to_begin = 10;  // readings, for place, speed and acceleration of the first instant

/// What is wrong with the unit of a command to this valve, or nothing.
std::string unit_of_command_problem(const ColumnPlace& command, const plant::Valve& valve) {
  const std::string_view wanted = name_of(valve.command_unit);
  if (unit_problem(command.unit, wanted).empty()) return "";
  return fmt::format(
      "unit = {0}: the rig's valve is commanded in {1}; of another valve, write into the rig file "
      "valve: {{zero_command: 0 {0}, span_command: ... {0}, zero_pressure: 0 bar, span_pressure: ... bar}}",
      command.unit, wanted);
}

/// Whether the column must be there: what drives the rig must.
bool drives(const Quantity& quantity, const ColumnMap& map, const plant::Rig& rig) {
  if (quantity.key == "time" || map.gives(quantity)) return true;
  return quantity.is_command() && !rig.valve.seals() &&
         map.given_pressure(quantity.channel.muscle) == plant::GivenPressure::none;
}

}  // namespace

bool has_own_clock(const ColumnMap& map, const plant::Rig& rig) {
  if (!rig.lifts_a_load() || rig.has_angle() || rig.valve.seals() || !map.settled.absent()) return true;
  return std::ranges::any_of(domain::quantities(), [&](const Quantity& quantity) {
    const ColumnPlace& place = map[quantity];
    constexpr std::array ticked{"time", "current", "contraction", "muscle_pressure"};
    if (place.has_own_clock() || !place.missing.empty()) return true;
    return !place.absent() && (place.as != Role::reading ||
                               std::find(ticked.begin(), ticked.end(), quantity.key) == ticked.end());
  });
}

std::vector<Wish> stamped_quantities(const ColumnMap& map, const plant::Rig& rig) {
  const bool pair = rig.pair() != nullptr;
  std::vector<Wish> wishes;
  for (const Quantity& quantity : domain::quantities(rig.command_unit())) {
    const ColumnPlace& place = map[quantity];
    if (!quantity.belongs(rig) || (!place.absent() && place.as == Role::ignored)) continue;
    if (place.absent() && quantity.channel.signal->must_be_named) continue;
    const bool needed = drives(quantity, map, rig), of_one = quantity.is_command() && !pair;
    const bool under_the_other_name =
        of_one && (quantity.is_old_current ? !map[domain::command_key].absent() : place.absent());
    if (!under_the_other_name && (needed || !quantity.is_command())) wishes.push_back({&quantity, needed});
  }
  return wishes;
}

std::vector<domain::Contradiction> wrong_command_units(const ColumnMap& map, const plant::Rig& rig) {
  std::vector<domain::Contradiction> found;
  for (const Quantity& quantity : domain::quantities()) {
    if (!quantity.is_command() || !quantity.belongs(rig) || !map.gives(quantity)) continue;
    const std::string why = unit_of_command_problem(
        map[quantity], quantity.channel.muscle == 2 ? rig.pair()->opposite.valve : rig.valve);
    if (!why.empty()) found.push_back({quantity.key, why});
  }
  return found;
}

namespace {

/// The columns of a table as a measurement, checked one by one.
class Assembling {
 public:
  Assembling(Table& table, const ColumnMap& map, const plant::Rig& rig, TableProblems& problems)
      : table_(table), map_(map), rig_(rig), problems_(problems) {}

  Measurement operator()(const domain::Recorded& recorded) {
    measured_.recorded = recorded;
    time();
    check_numbers(table_, map_, rig_, problems_);
    for (const Wish& wish : stamped_quantities(map_, rig_)) take(*wish.quantity);
    if (rig_.holds_a_length() && !measured_.gives_length())  // only pressures are asked for: at rest length
      measured_.give("contraction").assign(measured_.time_s.size(), 0.0);
    // What is judged first, pressures last.
    std::stable_partition(measured_.columns.begin(), measured_.columns.end(),
                          [](const auto& column) { return !column.channel.is_pressure(); });
    measured_.angle_in_degrees = map_["angle"].unit == "deg";
    measured_.counted = map_[rig_.has_angle() ? "angle" : "contraction"].unit == "count";
    measured_.own_clocks = has_own_clocks(map_);
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
      problems_.add(
          table_, *column, k,
          fmt::format("time_s = {} runs backwards: stamps must ascend", domain::write_number(now_s)));
      return;  // all later rows would repeat it
    }
  }

  /// What is judged, and what a first state is told from.
  void beginning() {
    const double lasting_s = measured_.time_s.back() - measured_.time_s.front();
    const std::string short_run = data::too_short(measured_.time_s, map_["time"]);
    if (measured_.recorded.skip_s > 0.0 && measured_.recorded.skip_s >= lasting_s)
      problems_.add({},
                    fmt::format("skip = {} s leaves nothing of this run, which {}",
                                domain::write_number(measured_.recorded.skip_s),
                                short_run.empty() ? fmt::format("lasts {:.3f} s", lasting_s) : short_run));
    const auto& read = measured_.values("contraction");
    const auto known = std::count_if(read.begin(), read.end(), [](double e) { return !std::isnan(e); });
    if (measured_.recorded.start == domain::Start::moving && known < least_to_begin)
      problems_.add({}, fmt::format("start = moving needs at least {} readings of contraction; there are {}",
                                    least_to_begin, known));
  }

  /// What can be done about rows that lack what drives the rig.
  std::string way_out(std::size_t row, std::size_t next, double gap_s) const {
    const std::vector<double>& time_s = measured_.time_s;
    const auto since = [&](std::size_t k) { return domain::write_number(time_s[k] - time_s.front()); };
    if (measured_.point_s > 0.0 || (row == 0 && next == time_s.size())) return "";
    if (row == 0) return fmt::format("; the run could begin later: from: {} s", since(next));
    if (next == time_s.size()) return fmt::format("; the run could end before: to: {} s", since(row - 1));
    return fmt::format(", for {:.4g} s; up to {} s are bridged, and bridge: of the data set may say more",
                       gap_s, domain::write_number(measured_.recorded.bridge_s));
  }

  /// What is given goes on between its stamps as it is held; a longer gap, or one at an end, is a problem.
  void bridge(const Quantity& quantity, const Table::Column& column, std::vector<double>& values) {
    const bool stays = measured_.recorded.hold == domain::Hold::previous ||
                       (measured_.recorded.hold == domain::Hold::usual && quantity.is_command());
    const std::vector<double>& time_s = measured_.time_s;
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (!std::isnan(values[row])) continue;
      std::size_t next = row;
      while (next < values.size() && std::isnan(values[next])) ++next;
      const bool at_end = row == 0 || next == values.size();
      const double gap_s = at_end ? 0.0 : time_s[next] - time_s[row - 1];
      if (at_end || gap_s > measured_.recorded.bridge_s || measured_.point_s > 0.0) {
        problems_.add(
            table_, column, row,
            fmt::format("{} missing here{}", column.in_file == column.name ? column.name + " is" : "it is",
                        way_out(row, next, gap_s)));
        return;
      }
      for (std::size_t k = row; k < next; ++k)
        values[k] = stays ? values[row - 1]
                          : values[row - 1] +
                                (values[next] - values[row - 1]) * (time_s[k] - time_s[row - 1]) / gap_s;
      row = next;
    }
  }

  void take(const Quantity& quantity) {
    const Table::Column* column = quantity.key == "time" ? nullptr : table_.find(quantity.column);
    if (column == nullptr) return;
    const bool given = quantity.is_command() || map_.gives(quantity);
    measured_.columns.push_back({quantity.channel, given, column->values});
    if (given) bridge(quantity, *column, measured_.columns.back().values);
    if (const double size = quantity.channel.signal->unit.size; size != 1.0)
      for (double& value : measured_.columns.back().values) value *= size;
  }

  Table& table_;
  const ColumnMap& map_;
  const plant::Rig& rig_;
  TableProblems& problems_;
  Measurement measured_;
};

}  // namespace

Measurement measurement_of(Table& table, const ColumnMap& map, const plant::Rig& rig,
                           const domain::Recorded& recorded, TableProblems& problems) {
  return Assembling(table, map, rig, problems)(recorded);
}

}  // namespace mckibben::input
