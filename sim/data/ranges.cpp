// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/units.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnMap, domain::ColumnPlace, domain::line_of, domain::write_number;
using Series = std::vector<double>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double lowest_ratio = -0.2, highest_ratio = 1.0, hardly_contracts = 0.02;
constexpr double lowest_read_bar = -2.0, lowest_given_bar = -1.0, highest_bar = 100.0;  // noise; a vacuum
constexpr double largest_angle_rad = 10.0, largest_force_N = 1e6;
constexpr double slack_mA = 1e-9;          // shortest digits of a sum of DAC steps
constexpr std::ptrdiff_t few_numbers = 3;  // numbers out of range that are told one by one

/// Readings that are missing lie anywhere.
bool within(const Series& values, double lowest, double highest) {
  return std::none_of(values.begin(), values.end(), [&](double v) { return v < lowest || v > highest; });
}

/// Of those that are not missing.
double largest_read(const Series& values) {
  double most = -infinite;
  for (const double value : values) most = std::fmax(most, value);
  return most;
}

/// The unit of a clock whose rows, read in unit `said`, are so many ticks apart; empty if it is none.
std::string clock_unit(double ticks, std::string_view said) {
  constexpr std::array<std::pair<std::string_view, double>, 5> units{
      {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"min", 60.0}}};
  const auto of = std::ranges::find(units, said, &std::pair<std::string_view, double>::first);
  if (of == units.end()) return "";
  for (const auto& [unit, size_s] : units)  // a step of 0.2 ms of a tick of 12 ms is no minute
    if (unit != said && unit != "min" && std::abs(ticks * size_s / of->second - 1.0) < 1e-3)
      return std::string(unit);
  return "";
}

/// The step [s] of a clock that goes evenly; 0 if it does not.
double even_step_s(const Series& time_s) {
  if (time_s.size() < 3) return 0.0;
  const double step_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  for (std::size_t k = 1; k < time_s.size(); ++k)
    if (std::abs(time_s[k] - time_s[k - 1] - step_s) > 1e-3 * std::abs(step_s)) return 0.0;
  return step_s;
}

/// The last contraction on the way from 0 to `far` where the braid's laws hold, by bisection.
double end_of_laws(const plant::Braid& braid, double far) {
  double inside = 0.0;
  while (std::abs(far - inside) > 1e-9) {
    const double middle = 0.5 * (inside + far);
    (braid.in_domain(middle) ? inside : far) = middle;
  }
  return inside;
}

class Ranges {
 public:
  Ranges(std::span<const ReadColumn> columns, const ColumnMap& map, const plant::Rig& rig)
      : columns_(columns),
        commands_(!map[domain::command_key].absent()),
        map_(with_our_names(map, rig.command_unit())),
        rig_(rig) {}

  std::vector<WrongNumber> operator()() {
    for (at_ = 0; at_ < columns_.size(); ++at_) {
      const auto& all = domain::quantities(rig_.command_unit());
      const auto found = std::ranges::find(all, columns_[at_].name, &domain::Quantity::column);
      if (found == all.end()) continue;
      const domain::Quantity& quantity =
          found->is_old_current && commands_ ? domain::quantity_of(domain::command_key) : *found;
      const std::string& key = quantity.key;
      const ColumnPlace& place = map_[quantity];
      given_ = quantity.is_command() || place.as == domain::Role::input;
      if (quantity.is_command())
        command(quantity, place);
      else if (key == "contraction")
        contraction(place);
      else if (quantity.unit() == plant::units::bar.name)
        pressure(quantity, place);
      else if (key == "angle")
        look(-largest_angle_rad, largest_angle_rad, "what a joint can turn", other(key, place));
      else if (quantity.unit() == plant::units::N.name)
        look(-largest_force_N, largest_force_N, "what a cord can bear", other(key, place));
      else if (quantity.unit() == plant::units::N_m.name)
        look(-largest_force_N, largest_force_N, "what a joint can bear", other(key, place));
    }
    return std::move(found_);
  }

 private:
  const Series& values() const { return *columns_[at_].values; }
  const Series* values_of(std::string_view name) const {
    const auto found = std::ranges::find(columns_, name, &ReadColumn::name);
    return found != columns_.end() ? found->values : nullptr;
  }
  static std::string other(const std::string& key, const ColumnPlace& place) {
    return fmt::format("it is read as {{{}}}: is that its column, and are unit, zero and factor right?",
                       line_of(key, place));
  }

  // Commands in volts or bar no DAC of ours made: a whole range outside they are of another valve.
  void command(const domain::Quantity& quantity, const ColumnPlace& place) {
    const plant::CommandUnit unit = rig_.command_unit();
    if (unit == plant::CommandUnit::mA)
      return look(rig_.dac.lowest_command, rig_.dac.largest_command + slack_mA, "range of the rig's DAC",
                  other(quantity.key, place));
    const plant::Valve& valve = quantity.channel.muscle == 2 ? rig_.pair()->opposite.valve : rig_.valve;
    const double zero = valve.zero_command, span = valve.span_command;
    look(2.0 * zero - span, 2.0 * span - zero,
         fmt::format("the rig's valve takes {:g} to {:g} {}", zero, span, name_of(unit)),
         other(quantity.key, place));
  }

  void contraction(ColumnPlace meant) {
    if (meant.as == domain::Role::input) return held(std::move(meant));
    const Series* current =
        commands_ ? nullptr : values_of(plant::Channel{&plant::command_of(rig_.command_unit())}.name());
    const Series* pressure = values_of("muscle_pressure_bar");
    std::string hint;
    const auto exchanged_with = [&](std::string_view quantity, ColumnPlace other_place) {
      std::swap(meant.column, other_place.column);
      hint = fmt::format("it looks exchanged with {}; write columns: {{{}, {}}}", quantity,
                         line_of("contraction", meant), line_of(quantity, other_place));
    };
    if (current != nullptr && within(*current, lowest_ratio, highest_ratio) &&
        within(values(), rig_.dac.lowest_command, rig_.dac.largest_command)) {
      exchanged_with(plant::command_key(rig_), map_["current"]);
    } else if (within(values(), -thresholds.column.beyond_reach * most_ratio(), hardly_contracts)) {
      hint = with_the_other_sign(meant);  // whatever else its numbers would be as well
    } else if (pressure != nullptr && could_be_exchanged(*pressure, map_["muscle_pressure"], meant)) {
      exchanged_with("muscle_pressure", map_["muscle_pressure"]);
    } else if (within(values(), -infinite, hardly_contracts)) {
      hint = with_the_other_sign(meant);
    } else if (meant.unit != "1" && meant.zero == 0.0 && within(values(), highest_ratio, infinite)) {
      hint = fmt::format(
          "does it read something else than 0 at rest length? Then columns: {{{}}} says so with zero: and "
          "that "
          "reading, and with factor: -1 if it falls as the muscle contracts",
          line_of("contraction", meant));
    } else if (std::abs(meant.factor) != 1.0) {  // a reading in V, whose unit nothing else would be
      hint = fmt::format(
          "zero is the reading at rest length, factor the {} for each unit of the column: are both right in "
          "columns: {{{}}}?",
          meant.unit == "1" ? "contraction ratio" : meant.unit, line_of("contraction", meant));
    } else {
      const std::string rig = divided_by_length(meant)
                                  ? fmt::format(". Or is the rig's rest_length wrong, {:.4g} mm?",
                                                1e3 * rig_.muscle.rest_length_m)
                                  : "";
      meant.unit = likely_unit(meant.unit);
      hint = fmt::format(
          "is it in another unit (\"%\", mm, deg, count), or its zero elsewhere? Then write so, "
          "as in columns: {{{}}}{}",
          line_in_unit("contraction", meant), rig);
    }
    look(lowest_ratio, highest_ratio, "what a muscle can do", hint);
  }

  static std::string with_the_other_sign(ColumnPlace meant) {
    meant.factor = -meant.factor;
    return fmt::format(
        "if it falls as the muscle contracts, its sign is the other one; write columns: {{{}}}",
        line_of("contraction", meant));
  }
  double most_ratio() const { return plant::Braid(rig_.muscle).largest_contraction_ratio(); }

  /// Whether either column would do as the other: as a contraction that is one, and a pressure of the supply.
  bool could_be_exchanged(const Series& pressure_bar, const ColumnPlace& as_pressure,
                          const ColumnPlace& as_contraction) const {
    const auto per_number = [](const std::vector<Unit>& units, const ColumnPlace& place) {
      const Unit* const unit = find_unit(units, place.unit);
      return place.factor * (unit != nullptr ? unit->size : 1.0);
    };
    const double ratio = per_number(units_of_contraction(rig_), as_contraction);
    const double bar = per_number(units_of_pressure(), as_pressure) / plant::Pa_per_bar;
    const double most_bar =
        thresholds.plausible.beyond_supply * rig_.valve.supply_pressure_Pa / plant::Pa_per_bar;
    const auto would_do = [&](double zero, double lowest_bar) {
      Series contractions = pressure_bar, seem_bar = values();
      for (double& value : contractions) value = (value / bar - zero) * ratio;
      for (double& value : seem_bar) value = (value / ratio + zero) * bar;
      return within(contractions, lowest_ratio, highest_ratio) &&
             largest_read(contractions) > hardly_contracts && within(seem_bar, lowest_bar, most_bar);
    };
    return would_do(0.0, -infinite) ||  // whatever was said of the zeros
           would_do(as_contraction.zero - as_pressure.zero, lowest_read_bar);
  }

  /// In which its numbers would be contractions of this muscle; a guess where they are in none.
  std::string likely_unit(const std::string& said) const {
    const std::vector<Unit> units = units_of_contraction(rig_);
    const Unit* const own = find_unit(units, said);
    const double most = most_ratio();
    for (const Unit& unit : units) {
      const double ratio = own != nullptr ? largest_read(values()) / own->size * unit.size : 0.0;
      if (unit.name != said && ratio > hardly_contracts && ratio < thresholds.column.beyond_reach * most)
        return unit.name;
    }
    return said == "mm" ? "count" : "mm";
  }

  /// A length that is given: no muscle can be held where its laws end.
  void held(ColumnPlace meant) {
    const plant::Braid braid(rig_.muscle);
    const double lowest = end_of_laws(braid, lowest_ratio - 1.0), highest = end_of_laws(braid, highest_ratio);
    look(lowest, highest, "what this muscle can be held at",
         within(values(), -highest, -lowest) ? with_the_other_sign(meant) : other("contraction", meant));
  }

  void pressure(const domain::Quantity& quantity, ColumnPlace meant) {
    const bool given = meant.as == domain::Role::input;
    const char* can = quantity.channel.signal->key == "muscle_pressure" ? "what a muscle can be given"
                                                                        : "what a valve can give";
    std::string hint;
    if (const Series* force_N = values_of("force_N");
        force_N != nullptr && could_be_exchanged_with_force(*force_N, meant)) {
      ColumnPlace force = map_["force"];
      std::swap(meant.column, force.column);
      hint = fmt::format("it looks exchanged with force; write columns: {{{}, {}}}",
                         line_of(quantity.key, meant), line_of("force", force));
    } else {
      meant.unit = likely_unit_of_pressure(meant.unit);
      hint = fmt::format("is it in another unit (kPa, mbar, Pa, psi)? Then write so, as in columns: {{{}}}",
                         line_in_unit(quantity.key, meant));
    }
    look(given ? lowest_given_bar : lowest_read_bar, highest_bar, given ? can : "what a gauge can show",
         hint);
  }

  /// Whether either column would do as the other: as a pressure of the supply, and as what it has the braid
  /// pull.
  bool could_be_exchanged_with_force(const Series& force_N, const ColumnPlace& as_pressure) const {
    const std::vector<Unit> units = units_of_pressure();
    const Unit* const unit = find_unit(units, as_pressure.unit);
    if (unit == nullptr || map_["force"].unit != "N") return false;
    const double bar = as_pressure.factor * unit->size / plant::Pa_per_bar, N = map_["force"].factor;
    const double most_Pa = thresholds.plausible.beyond_supply * rig_.valve.supply_pressure_Pa;
    const double seems_Pa = largest_read(force_N) / N * bar * plant::Pa_per_bar,
                 seems_N = largest_read(values()) / bar * N;
    return seems_Pa > thresholds.plausible.lifts_nothing_Pa && seems_Pa < most_Pa &&
           seems_N < plant::Braid(rig_.muscle).largest_force_N(most_Pa);
  }

  /// The largest in which its numbers are no more than the rig's supply; a guess where there is none.
  std::string likely_unit_of_pressure(const std::string& said) const {
    const std::vector<Unit> units = units_of_pressure();  // from the largest
    const Unit* const own = find_unit(units, said);
    const double most_Pa = largest_read(values()) * plant::Pa_per_bar;
    for (const Unit& unit : units)
      if (own != nullptr && unit.name != said &&
          most_Pa / own->size * unit.size <= rig_.valve.supply_pressure_Pa)
        return unit.name;
    return said == "kPa" ? "Pa" : "kPa";
  }

  /// Rows of a reading that is out of its range for a few of them, now and then; none where it is so for
  /// long or often, as in a wrong unit, or drives the simulation.
  std::vector<std::size_t> dropped_out(const auto& outside) const {
    std::vector<std::size_t> rows;
    const bool may_miss = columns_[at_].may_miss && !given_;
    std::size_t together = 0;
    for (std::size_t row = 0; row < values().size() && may_miss; ++row) {
      together = outside(values()[row]) ? together + 1 : 0;
      if (together > thresholds.reading.spike_ticks) return {};
      if (together > 0) rows.push_back(row);
    }
    const double most = thresholds.reading.not_read_share * static_cast<double>(values().size());
    return static_cast<double>(rows.size()) <= most ? rows : std::vector<std::size_t>{};
  }

  void look(double lowest, double highest, std::string_view meaning, const std::string& hint) {
    const Series& values = *columns_[at_].values;
    const std::string_view name = columns_[at_].name;
    const auto outside = [&](double value) { return value < lowest || value > highest; };
    const auto count = std::ranges::count_if(values, outside);
    if (count == 0) return;
    const auto first = std::ranges::find_if(values, outside);
    const std::vector<std::size_t> not_read = dropped_out(outside);
    const bool marks =
        2 * count < static_cast<std::ptrdiff_t>(values.size()) &&
        std::ranges::all_of(values, [&](double value) { return !outside(value) || value == *first; });
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (!outside(values[row])) continue;
      std::string message = fmt::format("{} = {} is out of range: {:.6g} to {:.6g} ({})", name,
                                        write_number(values[row]), lowest, highest, meaning);
      if (!not_read.empty()) {
        found_.push_back({at_, row, std::move(message), false, not_read});
        return;
      }
      if (count > few_numbers) {
        double least = infinite, most = -infinite;
        for (const double value : values) {
          if (value < least) least = value;
          if (value > most) most = value;
        }
        if (marks)
          message +=
              ": does it stand for readings that are missing? Then write missing: and that number, as the "
              "file has it, in the place of its column";
        else
          message += fmt::format(", as in {} of {} rows, which go from {:.6g} to {:.6g}; {}", count,
                                 values.size(), least, most, hint);
      }
      found_.push_back({at_, row, std::move(message), count > few_numbers});
      if (count > few_numbers) return;
    }
  }

  std::span<const ReadColumn> columns_;
  bool commands_;  ///< the map has a command, in place of a current
  ColumnMap map_;  ///< with our own names where it says none
  const plant::Rig& rig_;
  std::size_t at_ = 0;
  bool given_ = false;  ///< its column drives the simulation
  std::vector<WrongNumber> found_;
};

}  // namespace

ColumnMap with_our_names(ColumnMap map, plant::CommandUnit commands) {
  for (const domain::Quantity& quantity : domain::quantities(commands))
    if (ColumnPlace& place = map[quantity]; place.absent())
      place = {quantity.column, std::string(quantity.unit())};
  return map;
}

bool divided_by_length(const ColumnPlace& contraction) {
  return contraction.unit != "1" && contraction.unit != "%";
}

std::string line_in_unit(std::string_view quantity, const ColumnPlace& meant) {
  std::string line = line_of(quantity, meant);
  const domain::Quantity* of = domain::find_quantity(quantity);
  const bool ours = of != nullptr && meant.column == of->column && meant.unit == of->unit();
  if (meant.factor == 1.0 && !ours) line.insert(line.size() - 1, ", factor: 1");
  return line;
}

std::vector<WrongNumber> check_ranges(std::span<const ReadColumn> columns, const ColumnMap& map,
                                      const plant::Rig& rig) {
  return Ranges(columns, map, rig)();
}

std::optional<WrongNumber> check_clock(const Series& time_s, const ColumnMap& map, const plant::Rig& rig) {
  const double step_s = even_step_s(time_s), tick_s = rig.tick_s;
  const bool right = std::abs(step_s / tick_s - 1.0) < 1e-3;
  ColumnPlace meant = with_our_names(map, rig.command_unit())["time"];
  for (const double factor : {1e-3, 1e-6, 1e3, 1e6})
    if (std::abs(step_s / tick_s / factor - 1.0) < 1e-3 && clock_unit(step_s / tick_s, meant.unit).empty()) {
      meant.factor /= factor;
      return WrongNumber{
          0, 1,
          fmt::format("time_s = {}: its rows are {:.6g} s apart, the rig's ticks {:.6g} s; if its stamps are "
                      "off by that factor, write columns: {{{}}}",
                      write_number(time_s[1]), step_s, tick_s, line_of("time", meant))};
    }
  if (const std::string unit = clock_unit(step_s / tick_s, meant.unit); !unit.empty()) {
    const std::string said = std::exchange(meant.unit, unit);
    return WrongNumber{
        0, 1,
        fmt::format("time_s = {}: its rows are {:.6g} s apart, the rig's ticks {:.6g} s; this looks "
                    "like {}, not {}; write columns: {{{}}}",
                    write_number(time_s[1]), step_s, tick_s, unit, said, line_in_unit("time", meant))};
  }
  if (right && time_s.front() != 0.0 && meant.unit == "s" && meant.factor == 1.0) {
    meant.zero += time_s.front();
    return WrongNumber{
        0, 0,
        fmt::format("time_s = {} is not the beginning: expected is 0; if the run begins there, "
                    "write columns: {{{}}}",
                    write_number(time_s.front()), line_of("time", meant))};
  }
  if (step_s > 0.0 && !right)
    return WrongNumber{
        0, 1,
        fmt::format("time_s = {} is not a tick of {} ms: all rows are {:.6g} ms apart; if that is "
                    "the rig's tick, its file must say so: tick: {:.6g} ms; {}",
                    write_number(time_s[1]), 1e3 * tick_s, 1e3 * step_s, 1e3 * step_s, own_clock)};
  return std::nullopt;
}

}  // namespace mckibben::data
