// What stands above a table: keys and values, and the rate among them.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/recognise/settings.hpp>

namespace mckibben::recognise {
namespace {

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0;
}

std::string lower_letters(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (is_letter(c)) letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

/// `500,000000`, `1.000 Hz`: the number, with what follows it. `decimal`: the sign in the table below; 0: not
/// known, and a number such as 1,000 is none.
struct Value {
  double number;
  std::string_view unit;
};
std::optional<Value> value_of(std::string_view text, char decimal) {
  const std::size_t length = std::min(text.find_first_not_of("0123456789.,+-eE"), text.size());
  std::string_view digits = text.substr(0, length);
  while (digits.ends_with(',') || digits.ends_with('.') || digits.ends_with('E') || digits.ends_with('e'))
    digits.remove_suffix(1);
  input::Spelling spelling;
  spelling.look_at(digits);
  if (spelling.decimal() != '\0') decimal = spelling.decimal();
  if (decimal == '\0' && !spelling.group().empty()) return std::nullopt;
  std::string problem;
  const auto number = input::NumberReader(decimal).read("", {digits, 0}, problem);
  if (!number) return std::nullopt;
  std::string_view unit = input::trimmed(text.substr(digits.size()));
  while (!unit.empty() && std::string_view(";,\t").find(unit.back()) != std::string_view::npos)
    unit.remove_suffix(1);
  return Value{*number, input::trimmed(unit)};
}

/// The step between rows that a setting says; 0 if it is about something else.
double step_in(const Remark& remark, char decimal) {
  const std::string key = lower_letters(remark.key);
  const auto value = value_of(remark.value, decimal);
  if (!value || value->number <= 0.0) return 0.0;
  std::string unit(value->unit);
  for (const char* in_key : {"(Hz)", "[Hz]", "(s)", "[s]", "(ms)", "[ms]"})
    if (unit.empty() && remark.key.find(in_key) != std::string::npos)
      unit = std::string(in_key).substr(1, std::string_view(in_key).size() - 2);
  const auto has = [&](std::string_view word) { return key.find(word) != std::string::npos; };
  const bool rate = has("samplerate") || has("samplingrate") || has("abtastrate") || has("samplefreq") ||
                    has("samplingfreq") || has("abtastfrequenz") || key == "fs" || key == "rate" ||
                    key == "fshz" || has("samplespersec") || has("scanrate") || has("framerate") ||
                    has("fps") || has("framespersec");
  const bool step = has("sampleinterval") || has("samplinginterval") || has("sampleperiod") ||
                    has("samplingperiod") || has("sampletime") || has("increment") || key == "dt" ||
                    key == "ts" || key == "deltat" || has("abtastzeit") || has("deltax") ||
                    has("wfincrement") || has("timeinterval") || has("logginginterval") ||
                    has("recordinginterval") || has("scaninterval") || key == "interval";
  std::vector<double> number{value->number};
  if (rate) {
    if (unit.empty() || unit == "S/s" || unit == "Sa/s" || unit == "SPS" || unit == "fps")
      return 1.0 / value->number;
    if (!input::unit_problem(unit, "Hz").empty()) return 0.0;
    input::convert_units(number, unit, "Hz");
    return 1.0 / number.front();
  }
  if (!step) return 0.0;
  if (unit.empty()) return value->number;
  if (!input::unit_problem(unit, "s").empty()) return 0.0;
  input::convert_units(number, unit, "s");
  return number.front();
}

}  // namespace

std::optional<Remark> setting_in(std::string_view line) {
  while (!line.empty() && std::string_view("#%/ \t\"").find(line.front()) != std::string_view::npos)
    line.remove_prefix(1);
  if (line.empty() || !is_letter(line.front())) return std::nullopt;
  std::size_t at = line.find_first_of("=:;\t,");
  if (at == std::string_view::npos) {
    const std::size_t digit = line.find_first_of("0123456789+-");
    if (digit == std::string_view::npos || digit == 0 || line[digit - 1] != ' ') return std::nullopt;
    at = digit - 1;
  }
  const std::string_view key = input::trimmed(line.substr(0, at));
  std::string_view value = line.substr(at + 1);
  while (!value.empty() && std::string_view("=:;\t, \"").find(value.front()) != std::string_view::npos)
    value.remove_prefix(1);
  value = input::trimmed(value);
  if (value.ends_with('"')) value.remove_suffix(1);
  if (key.empty() || !value_of(value, '.')) return std::nullopt;
  return Remark{std::string(key), std::string(value)};
}

SaidStep said_step(const UnknownTable& table) {
  SaidStep found;
  for (const Remark& remark : table.settings) {
    const double step_s = step_in(remark, table.decimal);
    if (step_s == 0.0 || !std::isfinite(step_s)) continue;
    if (found.step_s != 0.0 && std::abs(step_s / found.step_s - 1.0) > 1e-6) return {};
    found = {step_s, fmt::format("the file says {} {}", remark.key, remark.value)};
  }
  return found;
}

}  // namespace mckibben::recognise
