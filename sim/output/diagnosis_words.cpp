// Units, digits and names; see the header.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/effects.hpp>
#include <sim/data/amount.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/output/diagnosis_words.hpp>

namespace mckibben::output {
namespace {

struct UsualUnit {
  double factor = 1.0;  ///< number in this unit for one of the SI unit
  std::string name;
};

/// The unit in which a number of that size is said. Conductances count litres of the reference state.
UsualUnit usual(std::string_view si_unit, double size) {
  if (si_unit == "1") return {1.0, ""};
  if (si_unit == "m" && size < 1.0) return {1e3, "mm"};
  if (si_unit == "m/s" && size < 1.0) return {1e3, "mm/s"};
  if (si_unit == "m3" && size < 1e-2) return {1e6, "ml"};
  if (si_unit == "s" && size < 0.5) return {1e3, "ms"};
  if (si_unit == "kg" && size < 0.5) return {1e3, "g"};
  if (si_unit == "rad") return {180.0 / std::numbers::pi, "deg"};
  if (si_unit == "Pa" && size >= 100.0) return size < 2e4 ? UsualUnit{1e-2, "mbar"} : UsualUnit{1e-5, "bar"};
  if (si_unit == "m3/(s.Pa)") return {6e9, "l/(min bar)"};
  std::string name(si_unit);
  std::replace(name.begin(), name.end(), '.', ' ');
  return {1.0, name};
}

std::string with_unit(const std::string& number, const UsualUnit& unit) {
  return unit.name.empty() ? number : number + " " + unit.name;
}

/// With this many decimals, or with an exponent where that would be unreadable.
std::string digits(double value, int decimals) {
  const double size = std::abs(value);
  return size >= 1e6 || (size > 0.0 && size < 1e-4) ? fmt::format("{:.3e}", value)
                                                    : fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

std::string name_of(const domain::Dataset& data) {
  const auto home = std::filesystem::absolute(data.path).lexically_normal().parent_path();
  return home.has_filename() ? home.filename().string() : "dataset";
}

std::string readable(double value, std::string_view si_unit) {
  const UsualUnit unit = usual(si_unit, std::abs(value));
  return with_unit(fmt::format("{:.4g}", value * unit.factor), unit);
}

Readable readable(const diagnose::FittedNumber& number) {
  const UsualUnit unit = usual(number.unit, std::abs(number.value));
  const double value = number.value * unit.factor, low = number.low * unit.factor,
               high = number.high * unit.factor, half = 0.5 * (high - low);
  if (!number.determined) return {readable(number.value, number.unit), "not determined by these data"};
  if (!std::isfinite(half) || half <= 0.0) return {readable(number.value, number.unit), "unknown"};
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, 9);
  return {with_unit(digits(value, decimals), unit),
          with_unit(digits(low, decimals) + " to " + digits(high, decimals), unit)};
}

Readable readable(const diagnose::BenchFault& fault, const plant::Rig& rig) {
  diagnose::FittedNumber size = fault.size;
  const bool length = size.unit == "1/s" || (size.unit == "1" && fault.name == "zeros_differ"),
             share = size.unit == "1" && !length;
  for (double* number : {&size.value, &size.low, &size.high})
    *number *= length ? rig.muscle.rest_length_m : share ? 100.0 : 1.0;
  if (length) size.unit = size.unit == "1" ? "m" : "m/s";
  Readable shown = readable(size);
  if (share) {
    shown.value += " %";
    shown.interval += " %";
  }
  return shown;
}

namespace {

std::string three_digits(double value) {
  const double size = std::abs(value);
  const int decimals = size > 0.0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 3) : 3;
  return rounded(value, decimals);
}

}  // namespace

std::string height(double ratio, const plant::Rig& rig) {
  return three_digits(ratio * rig.muscle.rest_length_m * 1e3) + " mm";
}

const JudgedWords& words_of(diagnose::Judged judged) {
  static constexpr JudgedWords contraction{"contraction_ratio",
                                           "1",
                                           1.0,
                                           "heights of the load in mm",
                                           "height of the load",
                                           "the load was higher",
                                           "lower",
                                           "Heights are heights of the load. "},
      force{"force",
            "N",
            1.0,
            "forces in N",
            "force of the cord",
            "the muscle pulled more",
            "less",
            "Forces are those of the cord. "},
      angle{"angle",
            "rad",
            plant::degree_rad,
            "joint angles in deg",
            "angle of the joint",
            "it stood further towards muscle 1",
            "towards muscle 2",
            "Angles are those of the joint, positive as muscle 1 contracts. "},
      pressure{"muscle_pressure", "Pa",
               plant::Pa_per_bar, "pressures in mbar",
               "pressure",        "it was higher",
               "lower",           "Pressures are those that were read. "};
  return judged == diagnose::Judged::force      ? force
         : judged == diagnose::Judged::angle    ? angle
         : judged == diagnose::Judged::pressure ? pressure
                                                : contraction;
}

std::string amount(double value, diagnose::Judged judged, const plant::Rig& rig) {
  const data::Shown in = data::shown_in(judged, rig);
  return three_digits(value / in.size) + ' ' + std::string(in.unit);
}

std::string mass(double kg) {
  return fmt::format("{:.6g} kg", kg);
}

std::string rounded(double value, int decimals, bool sign) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool nothing = text.find_first_of("123456789") == std::string::npos;
  if (nothing && text.front() == '-') text.erase(0, 1);
  return sign && value > 0.0 && !nothing ? "+" + text : text;
}

std::string or_others(const diagnose::NamedEffect& effect) {
  constexpr std::size_t most = 3;
  std::vector<std::string> others = words_of(effect.confusable_with);
  if (others.size() > most) {
    const std::size_t more = others.size() - most + 1;
    others.resize(most - 1);
    others.push_back(fmt::format("{} more", more));
  }
  if (others.empty()) return "";
  const std::string last = others.back();
  others.pop_back();
  return others.empty() ? "or " + last : fmt::format("or {} or {}", fmt::join(others, ", "), last);
}

std::string or_others_line(const diagnose::NamedEffect& effect) {
  const std::string others = or_others(effect);
  return others.empty() ? "" : fmt::format("* {}: these data do not distinguish them.", others);
}

std::string title_of(const diagnose::Diagnosis& diagnosis) {
  std::vector<std::string> found;
  bool open = false;
  for (const auto& effect : diagnosis.effects) {
    const std::string others = or_others(effect);
    open = open || !others.empty();
    found.push_back(effect.who().words() + (others.empty() ? "" : " " + others));
  }
  switch (diagnosis.verdict) {
    case diagnose::Verdict::nothing_missing:
      return "Nothing is missing";
    case diagnose::Verdict::recalibrate:
      return "The rig needs other numbers, not another effect";
    case diagnose::Verdict::missing_effect:
      return "Missing: " + (open ? fmt::format("{}", fmt::join(found, ", and ")) : listed(found)) +
             (diagnosis.residual_law.empty() ? "" : ", and something else") +
             (diagnosis.contradicts_sheet ? ", if the rig file's ± are wrong" : "");
    case diagnose::Verdict::unknown_effect:
      return "Something outside the catalogue is missing";
    case diagnose::Verdict::cannot_tell:
      break;
  }
  return "These data do not decide";
}

std::string why_recalibrated_is_worse(const diagnose::Diagnosis& diagnosis) {
  // With a fault of the bench neither says anything; where nothing is missing, or the difference is within
  // noise, there is nothing to explain.
  const auto& gap = diagnosis.gap;
  if (gap.recalibrated_rmse <= std::hypot(gap.nominal_rmse, gap.noise_floor) || !diagnosis.bench.empty() ||
      diagnosis.verdict == diagnose::Verdict::nothing_missing)
    return "";
  return "The recalibrated rig is worse than the nominal one: its parameters maximise the probability of the "
         "other runs, not this rms, and a model that lacks something predicts poorly what it was not fitted "
         "to.";
}

bool is_unexplained(const diagnose::Diagnosis& diagnosis) {
  return diagnosis.verdict != diagnose::Verdict::nothing_missing &&
         diagnosis.gap.floors_left() > diagnose::thresholds.start.explained_floors;
}

namespace {

/// Names that no fit has judged, though by a linear model they might explain as much as those that were
/// found.
std::string untried_in_words(const diagnose::Diagnosis& diagnosis) {
  constexpr std::size_t most = 4;
  if (!diagnosis.bench.empty()) return "";  // candidates promise to explain what the bench did
  double least = std::numeric_limits<double>::infinity();
  for (const auto& effect : diagnosis.effects) least = std::min(least, effect.support.fall);
  std::vector<std::string> names;
  for (const auto& one : diagnosis.ranking)
    if (one.untried && one.score >= least) names.push_back(full_name(one));
  if (names.empty()) return "";
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  if (more > 0) names.push_back(fmt::format("{} more", more));
  return fmt::format("Not tried, though by a linear model they might explain as much: {}.", listed(names));
}

}  // namespace

std::string in_words(const diagnose::NextExperiment& next) {
  return next.load_kg > 0.0 ? fmt::format("{}, with a load of {}", next.current, mass(next.load_kg))
                            : next.current;
}

std::string left_undecided(const diagnose::Diagnosis& diagnosis) {
  if (diagnosis.verdict != diagnose::Verdict::missing_effect) return "";
  const bool twins = std::ranges::any_of(diagnosis.effects,
                                         [](const auto& effect) { return !effect.confusable_with.empty(); });
  if (twins && diagnosis.corrected.pair() != nullptr)
    return "No measurement of a joint's angle is planned that would distinguish these names.";
  if (diagnosis.next_sensor) {
    const auto& sensor = *diagnosis.next_sensor;
    const std::string names = listed(sensor.separates);
    if (sensor.expected_power < diagnose::thresholds.plan.least_power)
      return fmt::format("Neither another current nor a pressure gauge on the muscle would separate {}.",
                         names);
    return fmt::format(
        "No other current would separate {}. A pressure gauge on the muscle would, in a run like {}, with a "
        "probability of {:.0f} %.",
        names, sensor.run, 100.0 * sensor.expected_power);
  }
  if (twins) return "No current that was tried and is not yet in the data would distinguish these names.";
  std::vector<std::string> as_good;
  for (const auto& one : diagnosis.explanations)
    if (one.as_good && !one.chosen) as_good.push_back(explained_as_well_by(diagnosis, one));
  return as_good.empty() ? "" : fmt::format("Not decided: {} may explain the data as well.", listed(as_good));
}

std::string what_next(const diagnose::Diagnosis& diagnosis) {
  using enum diagnose::Verdict;
  if (diagnosis.ended != diagnose::Ended::no)
    return "The search was stopped: let it finish before anything else is measured.";
  if (!diagnosis.to_measure.empty()) return "These data do not decide: " + diagnosis.to_measure + ".";
  if (is_unexplained(diagnosis))
    return fmt::format(
        "On the runs held out {:.1f} times the noise floor remains, so something is still unexplained. "
        "Measure "
        "one of the runs again: what two equal runs differ by is noise, "
        "what is left beyond it is not in the rig.",
        diagnosis.gap.floors_left());
  if (diagnosis.verdict == missing_effect) {
    const std::string undecided = left_undecided(diagnosis), untried = untried_in_words(diagnosis);
    if (undecided.empty() && untried.empty())
      return "No further measurement is needed to choose between names.";
    return undecided + (undecided.empty() || untried.empty() ? "" : " ") + untried;
  }
  if (diagnosis.verdict == recalibrate)
    return "Check the numbers that moved most against a ruler or the data sheet.";
  if (diagnosis.verdict == unknown_effect && !diagnosis.law_valid_for.empty())
    return "Measure wherever the rig is to be used beyond what the law is valid for.";
  return diagnosis.verdict == cannot_tell ? "These data do not decide, and no single run is known that would."
                                          : "";
}

std::string runs_in_words(const domain::Dataset& data) {
  const std::size_t runs = data.runs.size();
  return data.parts_of_a_run ? fmt::format("1 run in {} parts", runs)
                             : fmt::format("{} run{}", runs, runs == 1 ? "" : "s");
}

std::vector<std::string> held_out(const diagnose::Diagnosis& diagnosis) {
  std::vector<std::string> ids;
  for (const auto& run : diagnosis.runs)
    if (run.held_out) ids.push_back(run.id);
  return ids;
}

bool each_is_held_out(const diagnose::Diagnosis& diagnosis) {
  return !diagnosis.runs.empty() &&
         std::ranges::all_of(diagnosis.runs, [](const auto& run) { return run.held_out || run.left_out; });
}

std::string held_out_in_words(const diagnose::Diagnosis& diagnosis) {
  const auto ids = held_out(diagnosis);
  if (ids.empty()) return "none held out";
  return each_is_held_out(diagnosis) ? "each predicted from the others" : listed(ids) + " held out";
}

bool changed(const diagnose::Diagnosis& diagnosis) {
  return !diagnosis.bench.empty() || rig_changed(diagnosis);
}

bool rig_changed(const diagnose::Diagnosis& diagnosis) {
  return !diagnosis.effects.empty() || !diagnosis.stand_ins.empty() || !diagnosis.residual_law.empty() ||
         !diagnosis.recalibrated.empty();
}

EffectWords words_of(std::string_view effect, const plant::Effects& of_rig) {
  EffectWords words;
  const auto look = [&]<class E>(const E&) {
    if (effect == E::name) words = {E::law, E::sentence, E::source};
  };
  std::apply([&](const auto&... each) { (look(each), ...); }, plant::Effects::Table{});
  for (const auto& law : of_rig.laws.list)
    if (effect == law.text->name)
      words = {law.text->law, law.text->sentence, "a hypothesis of the user's own"};
  return words;
}

}  // namespace mckibben::output
