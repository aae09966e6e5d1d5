// Maps of a data set and of its runs; see the header.
#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <sim/domain/columns.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::domain {
namespace {

std::vector<Quantity> all_quantities(plant::CommandUnit unit) {
  std::vector<Quantity> all;
  const auto add = [&](const plant::Channel& channel) {
    Quantity quantity{channel, channel.key_in_dataset(), channel.name(), channel.words_in_dataset(),
                      all.size()};
    if (!quantity.belongs(false, false))
      quantity.words.insert(
          0, quantity.belongs(false, true) ? "of two muscles or a lever: " : "of two muscles: ");
    all.push_back(std::move(quantity));
  };
  for (const plant::Signal& signal : plant::signals) {
    if (signal.in_dataset.empty() || signal.of_commands_in.value_or(unit) != unit) continue;
    if (signal.in_dataset == command_key)
      all.push_back({{&signal},
                     "current",
                     plant::Channel{&signal}.name(),
                     "current to the valve, of one that takes mA",
                     all.size(),
                     true});
    add({&signal});
    if (signal.part == plant::Part::muscle)
      for (const std::size_t muscle : {1U, 2U}) add({&signal, muscle});
  }
  return all;
}

}  // namespace

bool Quantity::belongs(bool pair, bool angle) const {
  using plant::Needs;
  const plant::Signal& signal = *channel.signal;
  if (signal.part == plant::Part::muscle) return pair == (channel.muscle > 0);
  if (signal.needs == Needs::one_muscle || signal.needs == Needs::outer_force) return !angle;
  if (signal.needs == Needs::angle || signal.needs == Needs::outer_torque) return angle;
  return pair || signal.needs != Needs::pair;
}

plant::GivenPressure ColumnMap::given_pressure(std::size_t muscle) const {
  const std::string number = muscle == 0 ? "" : muscle == 1 ? "_1" : "_2";
  if (gives("muscle_pressure" + number)) return plant::GivenPressure::muscle;
  return gives("valve_pressure" + number) ? plant::GivenPressure::valve : plant::GivenPressure::none;
}

const std::vector<Quantity>& quantities(plant::CommandUnit commands) {
  static const auto all = [] {
    std::map<plant::CommandUnit, std::vector<Quantity>> of;
    for (const auto& [unit, name] : names(plant::CommandUnit{})) of.emplace(unit, all_quantities(unit));
    return of;
  }();
  return all.at(commands);
}

const Quantity* find_quantity(std::string_view key, plant::CommandUnit commands) {
  const auto found = std::ranges::find(quantities(commands), key, &Quantity::key);
  return found == quantities(commands).end() ? nullptr : &*found;
}

const Quantity& quantity_of(std::string_view key, plant::CommandUnit commands) {
  if (const Quantity* found = find_quantity(key, commands)) return *found;
  throw std::invalid_argument("no data set has columns of " + std::string(key));
}

std::string yaml_scalar(const std::string& text) {
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
  if (plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string line_of(std::string_view quantity, const ColumnPlace& place) {
  std::string line(quantity);
  line += ": {column: " + yaml_scalar(place.column) + ", unit: " + yaml_scalar(place.unit);
  if (place.zero != 0.0) line += ", zero: " + write_number(place.zero);
  if (place.factor != 1.0) line += ", factor: " + write_number(place.factor);
  if (!place.missing.empty()) line += ", missing: " + place.missing;
  if (place.as != Role::reading) line += ", as: " + std::string(plant::name_of(place.as));
  if (!place.time.empty()) line += ", time: " + yaml_scalar(place.time);
  if (place.late_s != 0.0) line += ", late: " + write_number(significant(1e3 * place.late_s, 9)) + " ms";
  if (!place.where.absent()) {
    std::string cells;
    for (const auto& [column, text] : place.where.cells)
      cells += (cells.empty() ? "" : ", ") + yaml_scalar(column) + ": " + yaml_scalar(text);
    line += ", where: {" + cells + '}';
  }
  return line + '}';
}

ColumnMap merged(const ColumnMap& shared, const ColumnMap& own) {
  ColumnMap map = own;
  for (const Quantity& quantity : quantities())
    if (map[quantity].absent()) map[quantity] = shared[quantity];
  const bool own_time = !own["time"].absent();
  if (own.rows_are_ticks) map["time"] = own["time"];
  if (map.settled.absent() && !own.rows_are_ticks && !own_time) map.settled = shared.settled;
  if (!map.settled.absent()) map["time"] = own["time"];
  map.rows_are_ticks = own.rows_are_ticks || (shared.rows_are_ticks && !own_time && own.settled.absent());
  return map;
}

}  // namespace mckibben::domain
