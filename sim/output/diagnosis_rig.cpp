// Rig and campaign files of a diagnosis; see the header.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/number.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/output/diagnosis_results.hpp>
#include <sim/output/diagnosis_words.hpp>

namespace mckibben::output {
namespace {

using input::Json;

/// Those members of `to` that `from` has otherwise or not at all.
Json changes(const Json& from, const Json& to) {
  Json changed = Json::object();
  for (const auto& [key, value] : to.items()) {
    const bool known = from.contains(key);
    if (!known || value != from.at(key))
      changed[key] = known && value.is_object() ? changes(from.at(key), value) : value;
  }
  return changed;
}

/// The shipped rig whose effects the rig has, as a base; empty if it has none. What stands over a base is
/// found, what is in it was known: a campaign's owner knows these effects (campaign_file.cpp).
std::string base_with_effects(const plant::Rig& rig, const plant::Rig& corrected) {
  const Json known = input::to_json(rig.effects), now = input::to_json(corrected.effects);
  if (known.empty()) return "";
  for (const auto& [key, effect] : known.items())
    if (!now.contains(key)) return "";
  return input::shipped_rig_where(
      [&](const plant::Rig& one) { return input::to_json(one.effects) == known; });
}

/// The corrected rig as it stands in a file, without schema.
Json corrected_rig(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis) {
  const Json shipped = input::to_json(plant::Rig{});
  Json rig = input::to_json(diagnosis.corrected);
  if (input::to_json(data.rig) == shipped) {
    Json file{{"base", "thesis"}};
    file.update(changes(shipped, rig));
    return file;
  }
  const std::string base = base_with_effects(data.rig, diagnosis.corrected);
  if (base.empty()) return rig;
  Json file{{"base", base}};
  file.update(rig);
  return file;
}

/// With a comment at the key of each effect that others could be.
std::string with_doubts(const std::string& yaml, const diagnose::Diagnosis& diagnosis) {
  std::string text;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line); text += line + '\n')
    for (const auto& effect : diagnosis.effects) {
      const std::string others = or_others(effect);
      if (!others.empty() && line.ends_with(" " + effect.name + ":"))
        line += fmt::format("  # {}: these data do not distinguish them", others);
    }
  return text;
}

/// A text as comment, whatever lines it has.
std::string comment(const std::string& text) {
  std::string lines = "# ";
  for (const char c : text) lines += c == '\n' ? std::string("\n# ") : std::string(1, c);
  return lines + "\n";
}

std::string number_line(const std::string& name, const diagnose::FittedNumber& number,
                        const std::string& note) {
  const Readable shown = readable(number);
  return comment(fmt::format("  {} {}{}, 95 % interval {}", name, shown.value, note, shown.interval));
}

std::string origin(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis) {
  std::string text =
      comment(fmt::format("The rig as a diagnosis of {} found it. {}.", name_of(data), title_of(diagnosis)));
  if (!diagnosis.because.empty()) text += comment(diagnosis.because);
  const auto add = [&](const char* as, const diagnose::NamedEffect& effect) {
    text += comment(fmt::format("{}: {}: {}", as, full_name(effect),
                                words_of(effect.name, diagnosis.corrected.effects).sentence));
    for (const auto& parameter : effect.parameters) text += number_line(parameter.name, parameter, "");
  };
  for (const auto& effect : diagnosis.effects) {
    add("Added", effect);
    if (const std::string others = or_others(effect); !others.empty())
      text += comment(fmt::format("  {}: these data do not distinguish them", others));
  }
  for (const auto& effect : diagnosis.stand_ins) add("Added in place of something unknown", effect);
  if (!diagnosis.residual_law.empty())
    text += comment("Added: a force outside the catalogue, valid for " + diagnosis.law_valid_for);
  for (const auto& term : diagnosis.residual_law) {
    text += number_line(term.term, term.coefficient, "");
    for (const auto& shape : term.shape) text += number_line("  " + shape.name, shape, "");
  }
  if (!diagnosis.recalibrated.empty()) text += comment("Recalibrated:");
  for (const auto& moved : diagnosis.recalibrated)
    text += number_line(moved.fitted.name, moved.fitted,
                        fmt::format(" (nominal {})", readable(moved.nominal, moved.fitted.unit)));
  return text;
}

/// What a term is for a coefficient of 1 N, as an expression; a sine's numbers as parameters or written out.
std::string expression(const plant::ForceTerm& term, bool with_parameters) {
  using enum plant::Basis;
  const auto number = [](double value) { return input::write_number(value); };
  switch (term.of) {
    case constant:
      return "1";
    case ratio:
      return "e";
    case ratio_squared:
      return "e^2";
    case pressure:
      return "P / 1 [bar]";
    case pressure_ratio:
      return "P / 1 [bar] * e";
    case force_ratio:
      return "F_braid / 100 [N] * e";
    case force_ratio_squared:
      return "F_braid / 100 [N] * e^2";
    case force_ratio_cubed:
      return "F_braid / 100 [N] * e^3";
    case load:
      return "load / 98.0665 [N]";
    case speed:
      return "v / 0.1 [m/s]";
    case speed_squared:
      return "v * abs(v) / 0.01 [m2/s2]";
    case direction:
      return "tanh(v / 1 [mm/s])";
    case direction_ratio:
      return "tanh(v / 1 [mm/s]) * e";
    case direction_pressure:
      return "tanh(v / 1 [mm/s]) * P / 1 [bar]";
    case sine:
      break;
  }
  if (with_parameters) return "sin(2 * pi * x / wavelength + phase)";
  return fmt::format("sin(2 * pi * x / {} [m] + ({}))", number(term.wavelength_m), number(term.phase_rad));
}

/// What it is, exactly; where to begin and between which bounds, in few digits.
Json parameter(const char* unit, double value, double lowest, double highest) {
  const auto two_digits = [](double number) { return domain::significant(number, 2); };
  return {{"unit", unit},
          {"typical", two_digits(value)},
          {"range", {two_digits(lowest), two_digits(highest)}},
          {"value", value}};
}

}  // namespace

std::string law_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis) {
  const auto& all = diagnosis.corrected.effects.get<plant::ResidualForce>().terms;
  const std::size_t found =
      std::min(diagnosis.residual_law.size(), all.size());  // the rig may have had terms
  const std::vector<plant::ForceTerm> terms(all.end() - static_cast<std::ptrdiff_t>(found), all.end());
  constexpr double around = 5.0;  // a fit may move what was found by so many times
  Json file{{"schema", input::hypothesis_schema},
            {"name", "found_law"},
            {"sentence", "a force outside the catalogue, as a diagnosis found it"},
            {"adds", "force"}};
  Json parameters = Json::object();
  if (terms.size() == 1) {
    const plant::ForceTerm& term = terms.front();
    const double most_N = around * std::abs(term.coefficient_N);
    file["law"] = "F * " + expression(term, true);
    parameters["F"] = parameter("N", term.coefficient_N, -most_N, most_N);
    if (term.of == plant::Basis::sine) {
      parameters["wavelength"] =
          parameter("m", term.wavelength_m, term.wavelength_m / around, term.wavelength_m * around);
      parameters["phase"] = parameter("1", term.phase_rad, -7.0, 7.0);
    }
  } else {
    std::string sum;
    for (const plant::ForceTerm& term : terms)
      sum += fmt::format("{}{} [N] * {}", sum.empty() ? "" : " + ", input::write_number(term.coefficient_N),
                         expression(term, false));
    file["law"] = "size * (" + sum + ")";
    parameters["size"] = parameter("1", 1.0, -around, around);
  }
  file["parameters"] = std::move(parameters);
  return comment(fmt::format("The law that a diagnosis of {} found, valid for {}.", name_of(data),
                             diagnosis.law_valid_for)) +
         comment("Read it, change it, and put it to the test: docs/hypotheses.md.") + input::to_yaml(file);
}

std::string rig_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis) {
  Json file{{"schema", input::rig_schema}};
  file.update(corrected_rig(data, diagnosis));
  return origin(data, diagnosis) + with_doubts(input::to_yaml(file), diagnosis);
}

std::string plan_yaml(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis) {
  const auto& next = diagnosis.next_experiment.value();
  Json file{{"schema", input::campaign_schema}, {"rig", corrected_rig(data, diagnosis)}};
  if (data.rig.pair() == nullptr) file["loads"] = Json::array({input::quantity_json(next.load_kg, "kg")});
  file["currents"] = Json::array({input::to_json(next.measurement, {data.rig.command_unit()})});
  return fmt::format("{} of {}.\n", plan_heading, name_of(data)) +
         comment(fmt::format("It separates {} with a probability of {:.0f} %: {}.", listed(next.separates),
                             100.0 * next.expected_power, next.current)) +
         comment("`mckibben dataset` makes the current's table and what the corrected rig would do.") +
         comment("Add the measured run to the data set and diagnose again.") +
         with_doubts(input::to_yaml(file), diagnosis);
}

}  // namespace mckibben::output
