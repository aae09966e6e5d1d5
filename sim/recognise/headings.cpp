// Words of headings; see the header.
#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include <fmt/format.h>

#include <sim/input/column_hints.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/text_layout.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {
namespace {

using input::words_of, input::Words;

struct Vocabulary {
  std::string_view key;
  Words words;
  Words stems{};              ///< that German begins or ends a word with: Sollspannung, Muskeldruck
  bool of_the_valve = false;  ///< a percentage there is of the valve's range, not of the muscle's length

  /// The first word that tells, and by which of these; empty if none does.
  std::string told_by(const Words& heading) const {
    for (const std::string& word : heading)
      if (std::ranges::find(words, word) != words.end()) return fmt::format("its word `{}`", word);
    for (const std::string& word : heading)
      for (const std::string& stem : stems)
        if (word.starts_with(stem) || word.ends_with(stem))
          return fmt::format("`{}` in its word `{}`", stem, word);
    return {};
  }
};

/// Of valves that a duty drives.
const Vocabulary& duties() {
  static const Vocabulary all{"command", input::duty_words, input::duty_stems, true};
  return all;
}

/// What is asked first wins: a set pressure is a command, whatever its unit.
const std::vector<Vocabulary>& vocabularies() {
  static const std::vector<Vocabulary> all{
      {"",
       {"supply",
        "tank",
        "versorgung",
        "speise",
        "ambient",
        "barometer",
        "barometric",
        "atmospheric",
        "mains",
        "reservoir",
        "temperature",
        "temperatur",
        "temp",
        "index",
        "error",
        "err",
        "fehler",
        "status",
        "flag",
        "kp",
        "ki",
        "kd",
        "seq",
        "battery",
        "humidity",
        "std",
        "stdev",
        "stddev",
        "sd",
        "sigma",
        "sem",
        "uncertainty",
        "model",
        "modelled",
        "sim",
        "estimated",
        "estimate",
        "est",
        "kalman",
        "observer",
        "peak",
        "limit",
        "threshold",
        "thr",
        "loss",
        "drop",
        "diameter",
        "durchmesser",
        "simulated",
        "predicted",
        "fit",
        "fitted",
        "theory",
        "theoretical",
        "rate",
        "velocity",
        "speed",
        "acceleration",
        "derivative",
        "geschwindigkeit",
        "beschleunigung",
        "power",
        "energy",
        "degc",
        "celsius"},
       {"versorgung", "speise", "netz", "luftdruck", "kessel", "umgebung", "temperatur", "geschwindigkeit"}},
      {"command",
       {"set",      "setpoint", "soll",    "sollwert", "ref",     "reference",  "command",
        "cmd",      "demand",   "desired", "des",      "target",  "stellgröße", "stellgroesse",
        "consigne", "ao0",      "ao1",     "dac",      "pd",      "pdes",       "pset",
        "psoll",    "pref",     "sp",      "goal",     "vorgabe", "commanded",  "wanted"},
       {"soll", "stell"}},
      {"time", input::time_words, {"zeit"}},
      {"force",
       {"f", "force", "kraft", "loadcell", "cell", "tension", "zugkraft", "seilspannung"},
       {"kraft"}},
      {"muscle_pressure",
       {"p", "pressure", "druck", "pm", "gauge", "manometer", "manometre", "pression", "pmuscle", "pact",
        "pist", "istdruck", "feedback", "pabs"},
       {"druck"}},
      {"contraction",
       {"contraction",  "kontraktion", "strain",        "eps",          "epsilon",     "laser",
        "distance",     "abstand",     "position",      "pos",          "weg",         "hub",
        "travel",       "length",      "länge",         "laenge",       "x",           "y",
        "stroke",       "encoder",     "counts",        "wheel",        "angle",       "theta",
        "phi",          "winkel",      "rope",          "height",       "höhe",        "lvdt",
        "poti",         "pot",         "potentiometer", "displacement", "stringpot",   "string",
        "wire",         "drawwire",    "cable",         "elongation",   "extension",   "extensometer",
        "verschiebung", "auslenkung",  "drehgeber",     "verkürzung",   "verkuerzung", "hoehe"},
       {"laser", "abstand", "weg", "winkel", "länge", "höhe", "position", "seil", "poti"}},
      {"command",
       {"u", "u1", "u2", "i", "i1", "i2", "current", "strom", "voltage", "spannung", "valve", "ventil"},
       {"strom", "spannung", "ventil"},
       true},
      duties()};
  return all;
}

/// What stands in brackets, or behind the last _, blank or slash; and what stands before.
struct Split {
  std::string_view before, behind;
  bool in_brackets = false;
  bool last = true;  ///< nothing stands behind it
};
Split split_unit(std::string_view name) {
  if (name.ends_with(']') || name.ends_with(')')) {
    std::size_t open = name.size(), depth = 0;  // brackets may stand in brackets: [kPa(a)]
    do {
      --open;
      if (name[open] == ']' || name[open] == ')') ++depth;
      if (name[open] == '[' || name[open] == '(') --depth;
    } while (open > 0 && depth > 0);
    if (depth == 0 && open > 0)
      return {name.substr(0, open), name.substr(open + 1, name.size() - open - 2), true};
  }
  constexpr std::string_view apart = "_ /";
  const std::size_t at = name.find_last_of(apart);
  if (at == std::string_view::npos || at == 0) {
    for (std::size_t hump = name.size(); hump-- > 1;)
      if (input::is_hump(name, hump)) return {name.substr(0, hump), name.substr(hump), false};
    return {name, {}, false};
  }
  const Split last{name.substr(0, at), name.substr(at + 1), false};
  if (!input::unit_word(last.behind).empty()) return last;
  // p_kPa_abs, p_bar_mean: one letter there is a name.
  const std::size_t before = last.before.find_last_of(apart);
  if (before == std::string_view::npos || before == 0) return last;
  const std::string_view unit = name.substr(before + 1, at - before - 1), whole = name.substr(before + 1);
  if (!input::unit_word(whole).empty()) return {name.substr(0, before), whole, false};
  if (unit.size() < 2 || unit == "in" || unit == "min" || input::unit_word(unit).empty()) return last;
  return {name.substr(0, before), unit, false, false};
}

/// A unit as it is written within a name: Sec, Psi.
std::string unit_of_part(std::string_view part) {
  const std::string lower = input::lower(part);
  if (lower == "bar" || lower == "mbar" || lower == "sec" || lower == "deg" || lower == "rad") return lower;
  return input::unit_word(part);
}

bool is_unit_of(std::string_view key, std::string_view unit) {
  const auto fits = [&](std::string_view wanted) { return input::unit_problem(unit, wanted).empty(); };
  if (unit.empty()) return false;
  if (key == "time") return unit == input::date_unit || fits("s");
  if (key == "command") return fits("mA") || fits("V") || fits("bar");
  if (key == "contraction") return unit == "1" || unit == "%" || unit == "count" || fits("m") || fits("rad");
  return fits(domain::quantity_of(key).unit());
}

/// What a unit alone tells; a voltage may be anything.
std::string_view key_of_unit(std::string_view unit) {
  const auto fits = [&](std::string_view wanted) { return input::unit_problem(unit, wanted).empty(); };
  if (unit.empty()) return "";
  if (unit == input::date_unit || fits("s")) return "time";
  if (fits("mA")) return "command";
  if (fits("bar")) return "muscle_pressure";
  if (fits("N")) return "force";
  return fits("m") || fits("rad") || unit == "count" ? "contraction" : "";
}

}  // namespace

namespace {

bool is_letter_or_digit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// What a word of time says of its unit.
std::string unit_of_time_word(const Words& words) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> units{{{"millis", "ms"},
                                                                                {"msec", "ms"},
                                                                                {"micros", "us"},
                                                                                {"usec", "us"},
                                                                                {"nsec", "ns"},
                                                                                {"sec", "s"},
                                                                                {"seconds", "s"},
                                                                                {"secs", "s"}}};
  for (const auto& [word, unit] : units)
    if (std::ranges::find(words, word) != words.end()) return std::string(unit);
  return "";
}

/// A command word beside a position or a force.
bool is_target_of_another(std::string_view unit, const Words& words) {
  if (!unit.empty() && (is_unit_of("contraction", unit) || is_unit_of("force", unit))) return unit != "1";
  if (!unit.empty()) return false;
  return std::ranges::any_of(vocabularies(), [&](const Vocabulary& each) {
    return (each.key == "contraction" || each.key == "force") && !each.told_by(words).empty();
  });
}

/// What a load cell that shows a mass has as its unit of force.
std::string force_of_mass(const std::string& unit) {
  if (unit == "kg" || unit == "g") return unit + "f";
  return unit == "lb" || unit == "lbs" ? "lbf" : unit;
}

/// The unit of a heading, if the line below it says another one of the same kind.
std::string contradicting(const std::string& unit, bool in_brackets, const std::string& below) {
  const bool may_be_a_name =
      !in_brackets && (unit == "in" || unit == "min" || (unit.size() < 2 && unit != "s"));
  if (unit.empty() || may_be_a_name || !input::unit_problem(unit, below).empty()) return "";
  std::vector<double> one{1.0};
  input::convert_units(one, unit, below);
  return one.front() == 1.0 ? "" : unit;
}

/// `x10`, `*10`, `/10` in a heading: its numbers are so many times what its unit says, or a part of it.
std::string times_in(const std::string& heading) {
  for (std::size_t at = 0; at + 2 < heading.size(); ++at) {
    const bool sign = heading[at] == '*' || heading[at] == '/' ||
                      (heading[at] == 'x' && (at == 0 || !is_letter_or_digit(heading[at - 1])));
    const std::size_t one = std::min(heading.find_first_not_of(' ', at + 1), heading.size() - 1);
    const std::size_t end = std::min(heading.find_first_not_of('0', one + 1), heading.size());
    if (sign && heading[one] == '1' && end > one + 1 &&
        (end == heading.size() || !is_letter_or_digit(heading[end])))
      return heading.substr(at, end - at);
  }
  return "";
}

/// 10 ms in "Time in 10 ms": its numbers are so many. Nothing where no number stands before the unit.
std::string number_of_unit(const Split& split) {
  if (split.in_brackets || split.behind.empty()) return "";
  const std::size_t end = split.before.find_last_not_of(' ');
  if (end == std::string_view::npos || std::isdigit(static_cast<unsigned char>(split.before[end])) == 0)
    return "";
  const std::size_t begin = split.before.find_last_not_of("0123456789.,", end) + 1;
  if (begin == 0 || split.before[begin - 1] != ' ') return "";  // p1 bar
  return fmt::format("{} {}", split.before.substr(begin, end + 1 - begin), split.behind);
}

/// Seconds of day, percent of 10 bar, turns per s: the unit is not the last word.
bool is_of_something(const Split& split) {
  const Words words = words_of(split.before);
  return !split.in_brackets && std::ranges::any_of(words, [](const std::string& word) {
    return word == "of" || word == "per" || word == "percent" || word == "von" || word == "prozent" ||
           word == "pro";
  });
}

/// How far what a heading says can be trusted.
std::string_view trust(bool by_word, bool by_unit) {
  return by_word && by_unit ? "sure" : by_word ? "likely" : "perhaps";
}

}  // namespace

bool is_of_a_sensor(const std::string& unit) {
  return unit == "V" || unit == "mV" || unit == "mA";
}

Heading heading_of(const UnknownColumn& column) {
  for (const auto& [commands, unit] : names(plant::CommandUnit{}))
    for (const domain::Quantity& each : domain::quantities(commands))
      if (column.name == each.column && !each.channel.signal->must_be_named &&
          (!each.is_old_current || unit == "mA"))
        return {&domain::quantity_of(each.key), std::string(each.unit()), true, "it has our own name"};
  const Split split = split_unit(column.heading());
  Heading heading;
  heading.unit = !column.unit.empty() ? column.unit : unit_of_part(split.behind);
  if (heading.unit.empty() && split.behind.empty() && column.heading().size() > 1 &&
      column.heading() != "in" && column.heading() != "min" && !names_a_run(column.heading()))
    heading.unit = input::unit_word(column.heading());  // a heading that is a unit
  if (column.unit.empty() && !split.in_brackets && heading.unit == "1") heading.unit.clear();  // x_1
  if (column.unit.empty() && is_of_something(split)) heading.unit.clear();
  if (column.is_date) heading.unit = input::date_unit;
  const bool is_suffix = column.unit.empty() && !split.in_brackets && !column.is_date;
  const Words words = words_of(split.in_brackets ? split.before : std::string_view(column.heading()));
  std::string_view key;
  std::string told;
  bool of_the_valve = false;
  for (const Vocabulary& each : vocabularies()) {
    told = each.told_by(words);
    if (told.empty()) continue;
    if (each.key.empty()) return {nullptr, heading.unit, false, told};
    key = each.key;
    of_the_valve = each.of_the_valve;
    break;
  }
  if (column.is_date) key = "time";
  // A current or a voltage that something reads: of what, no word says.
  if ((key == "command" || (key.empty() && key_of_unit(heading.unit) == "command")) &&
      names_an_instrument(column.heading()))
    return {nullptr, heading.unit, false, std::string(no_word)};
  if (key.empty() && !(is_suffix && heading.unit.size() < 2)) {
    key = key_of_unit(heading.unit);
    if (key == "command") key = "";  // a gauge's 4 to 20 mA are no command
    if (!key.empty()) told = fmt::format("its unit {}", heading.unit);
  }
  if (column.is_date) told = "it holds dates";
  if (key.empty()) return {nullptr, heading.unit, false, std::string(no_word)};
  if (!heading.unit.empty() && key == "time" && input::unit_problem(heading.unit, "K").empty())
    return {nullptr, heading.unit, false, "a temperature"};
  const bool is_share = of_the_valve && heading.unit == "%";
  if (key == "command" && !is_share && is_target_of_another(heading.unit, words))
    return {nullptr, heading.unit, false, "the target of a position or a force, not a command of the valve"};
  if (key == "force" && !heading.unit.empty() && !is_unit_of(key, heading.unit))
    heading.unit = force_of_mass(heading.unit);
  heading.quantity = &domain::quantity_of(key);
  if (key == "time" && heading.unit.empty()) heading.unit = unit_of_time_word(words);
  heading.unit_fits = is_unit_of(key, heading.unit);
  if (is_suffix && !heading.unit_fits && !is_share && !is_of_a_sensor(heading.unit)) heading.unit.clear();
  heading.reason = fmt::format("{} ({})", told, trust(!told.starts_with("its unit"), heading.unit_fits));
  if (!column.unit.empty() && !column.is_date)
    heading.other_unit = contradicting(unit_of_part(split.behind), split.in_brackets, column.unit);
  if (column.unit.empty() && split.in_brackets && heading.unit.empty()) heading.unknown = split.behind;
  heading.times = times_in(column.heading());
  if (heading.times.empty() && column.unit.empty()) heading.times = number_of_unit(split);
  static const Vocabulary lengths{"contraction", {"length", "länge", "laenge"}, {"länge"}};
  heading.is_length = !lengths.told_by(words).empty();
  static const Vocabulary contractions{"contraction",
                                       {"contraction", "contracción", "contração", "contrazione"},
                                       {"kontraktion", "verkürzung", "verkuerzung"}};
  heading.is_contraction = !contractions.told_by(words).empty();
  static const Vocabulary voltages{"command", {"voltage", "volts"}, {"spannung"}};
  heading.is_voltage = heading.quantity->is_command() && !voltages.told_by(words).empty();
  heading.is_duty = !duties().told_by(words).empty();
  return heading;
}

Told two_units(const Heading& heading) {
  return left_open(
      fmt::format("its heading says {}, the line below it {}: which?", heading.other_unit, heading.unit));
}

Told unit_of_the_map() {
  return {"1", "the unit that is written here counts, not the heading's"};
}

Told decimals_or_thousands(const std::string& number) {
  return left_open(
      fmt::format("the sign in {} may stand before decimals, 1, or between thousands, 1000", number));
}

}  // namespace mckibben::recognise
