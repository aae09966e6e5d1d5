// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/column_units.hpp>
#include <sim/input/quantity.hpp>
#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {
namespace {

constexpr double held_share = 0.01;

/// A column, and what its heading says.
struct Named {
  const UnknownColumn* column;
  Heading heading;
};

/// Millipascals, which nobody measures with.
bool is_misspelt(const std::string& unit) {
  return unit.starts_with("mPa");
}

std::string_view unit_of_example(const Heading& heading) {
  if (heading.is_voltage) return "V";
  return heading.quantity->key == "contraction" ? "mm" : heading.quantity->unit();
}

/// What can stand there, also of an ADC's numbers.
std::string example_of(const Heading& heading) {
  return fmt::format(
      "write one, as {0}; of numbers of an ADC {0} with factor: the {0} of one step, and zero: what it reads "
      "at 0 {0}",
      unit_of_example(heading));
}

Told unit_told(const Heading& heading) {
  if (!heading.other_unit.empty()) return two_units(heading);
  if (is_misspelt(heading.unit)) return left_open("the table says mPa, a thousandth of a pascal: MPa?");
  if (heading.unit_fits) return {heading.unit, fmt::format("the table says {}", heading.unit)};
  if (!heading.unknown.empty())
    return left_open(
        fmt::format("the table says ({}), which is no unit that is known here", heading.unknown));
  if (heading.unit.empty()) return left_open("the table says no unit: " + example_of(heading));
  if (is_of_a_sensor(heading.unit) && !heading.quantity->is_command() && heading.quantity->key != "time")
    return left_open(fmt::format(
        "the table says {0}, which its sensor gives: write unit: {1}, factor: the {1} of one {0}, and zero: "
        "what it reads at 0 {1}",
        heading.unit, unit_of_example(heading)));
  return left_open(
      fmt::format("the table says {}, which is none of {}: write unit, zero and factor of the sensor",
                  heading.unit, heading.quantity->key));
}

/// What is asked of a column's factor, or must be written where its unit contradicts a heading.
std::optional<Told> factor_told(const Named& of) {
  if (!of.column->either.empty()) return decimals_or_thousands(of.column->either);
  if (!of.heading.times.empty())
    return left_open(fmt::format("its heading says {}: what one of its numbers is in its unit, 0.1, 10 or 1",
                                 of.heading.times));
  if (!of.heading.other_unit.empty() || is_misspelt(of.heading.unit)) return unit_of_the_map();
  return std::nullopt;
}

/// The key under which a data set names it.
const domain::Quantity* quantity_for(const domain::Quantity& quantity, const Told& unit) {
  const bool is_current = quantity.key == "command" && !unit.open() && input::is_current(unit.value);
  return is_current ? &domain::quantity_of("current") : &quantity;
}

/// `others`: columns that no word names.
ColumnGuess guess_of(const domain::Quantity& quantity, const std::vector<const Named*>& candidates,
                     const std::string& others) {
  std::vector<std::string> names;
  for (const Named* each : candidates) {
    if (each->column->name == quantity.column || candidates.size() == 1) {
      const Told unit = unit_told(each->heading);
      return {quantity_for(quantity, unit),
              {each->column->name, each->heading.reason},
              unit,
              {},
              factor_told(*each),
              {},
              {}};
    }
    names.push_back(each->column->where.empty() ? each->column->name : "where: " + each->column->where);
  }
  const bool duties =
      std::ranges::all_of(candidates, [](const Named* each) { return each->heading.is_duty; });
  const std::string why = !names.empty()
                              ? fmt::format("it may be any of: {}{}", fmt::join(names, "; "),
                                            names.size() == 2 ? of_two(quantity, duties) : std::string())
                          : others.empty() ? "no column seems to hold it"
                                           : "no heading names it; perhaps one of: " + others;
  return {&quantity, left_open(why), left_open("the unit of the column that you write"), {}, {}, {}, {}};
}

/// Whether a bench holds the muscle at a length in each table.
bool is_held(const ColumnGuess& contraction, const std::vector<const UnknownTable*>& tables) {
  Range all{1e300, -1e300};
  double widest = 0.0;
  for (const UnknownTable* table : tables) {
    const Values* values = column_of(*table, contraction.column.value);
    if (values == nullptr) return false;
    const Range own = range_of(*values);
    all = {std::min(all.low, own.low), std::max(all.high, own.high)};
    widest = std::max(widest, own.high - own.low);
  }
  return widest <= held_share * (all.high - all.low);
}

/// Lengths that a bench gives go along with nothing.
void given_length(ColumnGuess& contraction, bool is_length) {
  contraction.input = Told{"input", "it stays the same in each table: a bench holds the muscle at it"};
  contraction.zero = left_open("what it reads with the muscle at its rest length");
  contraction.factor = is_length ? Told{"-1", "a length falls as the muscle contracts"}
                                 : left_open("1 if it grows as the muscle contracts, else -1");
}

/// What a gauge of absolute pressure reads at rest [kPa].
constexpr double atmosphere_kPa = 101.325, least_atmosphere_kPa = 95.0, most_atmosphere_kPa = 105.0;

/// Gauge or absolute: by its words, else asked where it rests near one atmosphere.
void zero_of_pressure(ColumnGuess& pressure, const std::vector<const UnknownTable*>& tables) {
  if (pressure.column.open()) return;
  if (pressure.unit.open()) {
    if (is_absolute(pressure.column.value))
      pressure.zero = left_open("its heading says absolute: what its gauge reads in open air, in its unit");
    return;
  }
  double lowest = 1e300;
  for (const UnknownTable* table : tables)
    if (const Values* values = column_of(*table, pressure.column.value))
      lowest = std::min(lowest, range_of(*values).low);
  Values in_kPa{lowest}, atmosphere{atmosphere_kPa};
  if (!input::unit_problem(pressure.unit.value, "kPa").empty()) return;
  input::convert_units(in_kPa, pressure.unit.value, "kPa");
  input::convert_units(atmosphere, "kPa", pressure.unit.value);
  const bool said = is_absolute(pressure.column.value) || is_absolute(pressure.unit.value);
  if (said)
    pressure.zero = Told{fmt::format("{:.6g}", atmosphere.front()),
                         "its heading says absolute: the atmosphere is taken off"};
  else if (in_kPa.front() > least_atmosphere_kPa && in_kPa.front() < most_atmosphere_kPa)
    pressure.zero =
        left_open(fmt::format("its lowest is {:.4g} {}: {:.6g} if it is absolute, 0 if it is gauge", lowest,
                              pressure.unit.value, atmosphere.front()));
}

/// A column that holds the numbers of another before they were scaled.
const UnknownColumn* scaled_of(const UnknownColumn& raw, const std::vector<Named>& named) {
  constexpr double same = 0.999;
  if (!names_raw(raw.name) && raw.unit != "count") return nullptr;
  for (const Named& each : named)
    if (each.column != &raw && each.heading.quantity != nullptr && each.heading.unit_fits &&
        each.heading.unit != "count" && each.heading.quantity->key != "time" &&
        std::abs(together({&each.column->values}, {&raw.values}).correlation) > same)
      return each.column;
  return nullptr;
}

/// A command that is on or off.
bool is_switch(const Named& of) {
  return of.heading.quantity != nullptr && of.heading.quantity->is_command() && of.heading.unit.empty() &&
         std::ranges::all_of(of.column->values,
                             [](double value) { return value == 0.0 || value == 1.0 || std::isnan(value); });
}

/// Row numbers and raw readings are nothing that is compared.
void leave_out_others(const TimeGuess& time, std::vector<Named>& named) {
  for (Named& each : named) {
    if (each.heading.quantity == nullptr || each.heading.quantity->key == "time") continue;
    if (each.column == time.row_numbers || (time.guess && each.column->name == time.guess->column.value) ||
        (names_rows(each.column->name) && counts_rows(each.column->values)))
      each.heading = {nullptr, "", false, "it counts the rows"};
    else if (is_switch(each))
      each.heading = {nullptr, "", false, "it holds 0 and 1 alone: a valve that is on or off"};
    else if (const UnknownColumn* scaled = scaled_of(*each.column, named))
      each.heading = {nullptr, "", false, fmt::format("the raw reading of {}", scaled->name)};
  }
}

/// The clock that stands before a quantity's column, where each has its own.
void own_clock(const UnknownTable& table, const TimeGuess& time, ColumnGuess& guess) {
  if (time.clocks.empty() || guess.column.open()) return;
  const UnknownColumn* const column = table.find(guess.column.value);
  const UnknownColumn* clock = nullptr;
  for (const UnknownColumn* each : time.clocks)
    if (each < column) clock = each;
  if (clock != nullptr && clock != time.clocks.front())
    guess.time = Told{clock->name, "it stands behind that clock"};
}

std::string range_in_words(const Named& of) {
  const Range range = range_of(of.column->values);
  return fmt::format("{:.4g} to {:.4g}{}{}", range.low, range.high, of.heading.unit.empty() ? "" : " ",
                     of.heading.unit);
}

/// Columns that may be anything.
std::string nameless(const TimeGuess& time, const std::vector<Named>& named) {
  std::vector<std::string> list;
  for (const Named& each : named)
    if (each.heading.quantity == nullptr && each.heading.reason == no_word &&
        each.column != time.row_numbers && !(time.guess && each.column->name == time.guess->column.value))
      list.push_back(fmt::format(
          "{} ({})", each.column->where.empty() ? each.column->name : "where: " + each.column->where,
          range_in_words(each)));
  return fmt::format("{}", fmt::join(list, "; "));
}

/// In a long table a quantity is the rows that hold it.
void say_rows(const UnknownTable& table, ColumnGuess& guess) {
  if (table.columns.size() < 2 || table.columns[1].where.empty()) return;
  const UnknownColumn* column = table.find(guess.column.value);
  guess.in_file = table.columns[1].in_file;
  guess.where = column != nullptr ? column->where
                                  : table.columns[1].where.substr(0, table.columns[1].where.find(": ")) +
                                        ": " + std::string(domain::fill_in) + "}";
}

/// Words that come again, and lines above the table.
void remark_on(const UnknownTable& table, MapGuess& map) {
  if (!table.note.empty()) map.remarks.push_back(table.note);
  if (!table.has_headings)
    map.remarks.emplace_back("no line names the columns: they are called 1, 2, 3, ... from the left");
  std::vector<std::string> said;
  constexpr std::size_t most_said = 12;
  for (const Remark& each : table.settings)
    if (said.size() < most_said) said.push_back(each.key + " " + each.value);
  if (!said.empty()) map.remarks.push_back(fmt::format("the file says: {}", fmt::join(said, "; ")));
  for (const UnknownColumn& column : table.texts) {
    constexpr std::size_t most_shown = 5;
    const std::size_t count = column.texts.size();
    std::vector<std::string> shown(
        column.texts.begin(),
        column.texts.begin() + static_cast<std::ptrdiff_t>(std::min(count, most_shown)));
    map.remarks.push_back(fmt::format(
        "not used: {0}: words, {1}{2}{3}", column.name, fmt::join(shown, ", "),
        count > most_shown ? ", ..." : "",
        count > 1
            ? fmt::format("; where they are runs, write where: {{{}: {}}} of each, or cut: and segment:",
                          domain::yaml_scalar(column.name), domain::yaml_scalar(shown.front()))
            : ""));
  }
}

}  // namespace

const Values* column_of(const UnknownTable& table, const std::string& name) {
  const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                  [&](const UnknownColumn& each) { return each.name == name; });
  return found == table.columns.end() ? nullptr : &found->values;
}

const ColumnGuess* drive_of(const MapGuess& map) {
  for (const char* key : {"current", "command", "muscle_pressure"})
    if (const ColumnGuess* guess = map.find(key); guess != nullptr && !guess->column.open()) return guess;
  return nullptr;
}

namespace {

/// Rows without stamps; whether a rig that is known has such ticks, nobody has said.
Setting rows_of_ticks(const UnknownTable& table, bool rig_is_known) {
  std::string why =
      "no column seems to hold time; of settled points write settled: {each: 5 s} in its place, "
      "with what one took";
  if (!rig_is_known) return {"rows_are_ticks", {"true", why}};
  const SaidStep said = said_step(table);
  return {"rows_are_ticks", left_open(fmt::format("{}; true if rows are the rig's tick apart{}", why,
                                                  said.reason.empty() ? "" : ": " + said.reason))};
}

constexpr double follows = 0.5, changes_by = 0.1, stays_within = 0.3;

/// The muscle's pressure follows the command; one that drives the muscle changes. Others may be a supply's.
void doubt_pressures(MapGuess& map, const std::vector<const UnknownTable*>& tables) {
  const ColumnGuess* drive = drive_of(map);
  for (ColumnGuess& guess : map.columns) {
    if (guess.quantity->key != "muscle_pressure" || guess.column.open() || drive == nullptr) continue;
    const auto drives = readings_of(tables, drive->column.value),
               readings = readings_of(tables, guess.column.value);
    if (!drives || !readings) return;
    const Range& range = readings->range;
    const bool changes = drives->range.high > drives->range.low,
               steady = range.high - range.low < stays_within * std::abs(range.high);
    const double correlation = together(drives->values, readings->values).correlation;
    if (drive == &guess && range.high - range.low < changes_by * std::abs(range.high))
      guess.column =
          left_open(fmt::format("{} changes by {:.2g} of {:.4g} only: is it the muscle's, or a supply's?",
                                guess.column.value, range.high - range.low, range.high));
    else if (drive != &guess && changes && correlation < follows && steady)
      guess.column = left_open(
          fmt::format("{} does not follow {} (correlation {:.2f}): is it the muscle's, or a supply's?",
                      guess.column.value, drive->column.value, correlation));
  }
}

}  // namespace

MapGuess map_of(const std::vector<const UnknownTable*>& tables, bool rig_is_known, const KnownRig& rig) {
  const UnknownTable& table = *tables.front();
  std::vector<Named> named;
  for (const UnknownColumn& column : table.columns) named.push_back({&column, heading_of(column)});
  const TimeGuess time = time_of(table);
  leave_out_others(time, named);
  const auto candidates = [&](std::string_view key) {
    std::vector<const Named*> list;
    for (const Named& each : named)
      if (each.heading.quantity != nullptr && (each.heading.quantity->key == key ||
                                               (key == "command" && each.heading.quantity->key == "current")))
        list.push_back(&each);
    return list;
  };
  MapGuess map;
  const std::string others = nameless(time, named);
  remark_on(table, map);
  const bool has_pressure = !candidates("muscle_pressure").empty(), has_force = !candidates("force").empty();
  if (time.guess) map.columns.push_back(*time.guess);
  for (const char* key : {"command", "contraction", "muscle_pressure", "force"}) {
    const std::string_view quantity = key;
    const auto found = candidates(quantity);
    // Without a length, given or read, nothing can be judged.
    const bool may_lack =
        (quantity == "command" && has_pressure) || quantity == "muscle_pressure" || quantity == "force";
    if (!found.empty() || !may_lack)
      map.columns.push_back(guess_of(domain::quantity_of(quantity), found, others));
    if (!found.empty()) own_clock(table, time, map.columns.back());
    if (quantity == "command")
      for (const Named* each : found)
        if (each->column->name == map.columns.back().column.value)
          command_of_share(map.columns.back(), each->heading, tables, rig);
    const bool duties = std::ranges::any_of(found, [](const Named* each) { return each->heading.is_duty; });
    if (duties && map.columns.back().column.open()) unit_of_either_duty(map.columns.back(), rig);
    if (quantity == "muscle_pressure" && !found.empty()) zero_of_pressure(map.columns.back(), tables);
  }
  if (time.row_numbers != nullptr)
    map.ignored.push_back(
        {time.row_numbers->name, "it counts the rows; " + range_in_words({time.row_numbers, {}})});
  for (const Named& each : named)
    if (each.heading.quantity == nullptr && each.column != time.row_numbers &&
        !(time.guess && each.column->name == time.guess->column.value))
      map.ignored.push_back(
          {each.column->name, fmt::format("{}; {}", each.heading.reason, range_in_words(each))});
  for (ColumnGuess& guess : map.columns)
    if (guess.quantity->key != "time") say_rows(table, guess);
  for (ColumnGuess& guess : map.columns)
    for (const UnknownTable* each : tables)
      if (const UnknownColumn* column = each->find(guess.column.value);
          column != nullptr && !column->missing.empty())
        guess.missing =
            Told{column->missing, "it comes again, far beyond all others: nothing was read there"};
  for (const ColumnGuess& guess : map.columns)
    if (const UnknownColumn* column = table.find(guess.column.value);
        column != nullptr && !column->odd.empty())
      map.remarks.push_back(fmt::format("{}: {}", column->name, column->odd));
  for (const std::string& words : table.words)
    map.ignored.push_back({words, "it holds no numbers, or not one for each row"});
  if (candidates("command").empty())
    for (ColumnGuess& guess : map.columns)
      if (guess.quantity->key == "muscle_pressure" && has_pressure)
        guess.input = Told{"input", "no command was recorded, so that the pressure drives the simulation"};
  doubt_pressures(map, tables);
  const ColumnGuess* drive = drive_of(map);
  bool held = false;
  for (ColumnGuess& guess : map.columns)
    if (guess.quantity->key == "contraction" && drive != nullptr && !guess.column.open()) {
      held = has_force && is_held(guess, tables);
      const Heading& heading = candidates("contraction").front()->heading;
      if (held)
        given_length(guess, heading.is_length);
      else
        sign_and_zero(guess, *drive, map.find("muscle_pressure"), tables, heading, rig);
    }
  if (!time.guess && !table.time_is_inside)
    map.rows = held
                   ? Setting{"settled",
                             left_open("no column seems to hold time, and each table stays at one length: "
                                       "its rows seem to be settled points; {each: 5 s}, with what one took")}
                   : rows_of_ticks(table, rig_is_known);
  return map;
}

}  // namespace mckibben::recognise
