// See the header.
#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include <sim/cli/diagnosis_folders.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/json_file.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/source.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/grid.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

/// Standard errors: of some thirty numbers that are the same, one in twelve pairs of diagnoses has one so
/// far.
constexpr double beyond_chance = 3.0;

double error_of(const Told& told) {
  return 0.5 * (told.high - told.low) / diagnose::thresholds.interval.normal;
}

Json read(const fs::path& folder) {
  const fs::path file = folder / "diagnosis.json";
  const auto refuse = [&](const std::string& message) {
    throw input::BadInput({{input::Severity::error, file.string(), {}, message, ""}});
  };
  Json document = input::read_json(input::Source::load(file, input::most_json_bytes));
  if (!document.is_object() || document.value("schema", Json()) != "mckibben-diagnosis/1")
    refuse("schema is not mckibben-diagnosis/1");
  for (const char* key : {"verdict", "effects", "recalibrated", "gap"})
    if (!document.contains(key)) refuse(fmt::format("{} is missing", key));
  return document;
}

Told told(const Json& number, const char* value) {
  return {number.at(value), number.at("ci95").at(0), number.at("ci95").at(1)};
}

/// The terms of a law without a name. The length of a wave is in its term's words, which differ from fit to
/// fit, so terms go by their place.
void add_law(const Json& law, std::vector<NumberDifference>& list) {
  if (law.is_null()) return;
  const Json& terms = law.at("terms");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Json& term = terms.at(i);
    std::string of = term.at("term").get<std::string>();
    if (term.contains("wavelength")) of = fmt::format("wave {}", i + 1);
    of = "residual_law." + of;
    list.push_back({of, term.at("unit"), told(term, "coefficient"), {}, true});
    for (const char* shape : {"wavelength", "phase"})
      if (term.contains(shape))
        list.push_back(
            {of + "." + shape, term.at(shape).at("unit"), told(term.at(shape), "value"), {}, true});
  }
}

/// Those of one document: of its effects and its law, then of its rig.
std::vector<NumberDifference> numbers_of(const Json& document) {
  std::vector<NumberDifference> list;
  const auto add = [&](const Json& effect, const char* more) {
    std::string of = effect.at("name").get<std::string>() + more;
    if (effect.contains("side")) of += fmt::format(" of muscle {}", effect.at("side").get<int>());
    for (const auto& [name, number] : effect.at("parameters").items())
      list.push_back({fmt::format("{}.{}", of, name), number.at("unit"), told(number, "value"), {}, true});
  };
  for (const Json& effect : document.at("effects")) add(effect, "");
  for (const Json& effect : document.value("stand_ins", Json::array())) add(effect, " (stands in)");
  add_law(document.value("residual_law", Json()), list);
  for (const auto& [key, number] : document.at("recalibrated").items())
    list.push_back({number.value("path", key), number.at("unit"), told(number, "fitted"), {}, false});
  return list;
}

std::vector<NumberDifference> side_by_side(std::vector<NumberDifference> list,
                                           const std::vector<NumberDifference>& right) {
  for (const NumberDifference& one : right) {
    const auto same = std::ranges::find(list, one.name, &NumberDifference::name);
    if (same != list.end())
      same->right = one.left;
    else
      list.push_back({one.name, one.unit, {}, one.left, one.of_effect});
  }
  std::stable_partition(list.begin(), list.end(), [](const NumberDifference& one) { return one.of_effect; });
  return list;
}

std::string shown(const std::optional<Told>& told, const std::string& unit) {
  if (!told) return "-";
  return output::readable(told->value, unit) + " ± " + output::readable(error_of(*told), unit);
}

Json json_of(const std::optional<Told>& told) {
  if (!told) return nullptr;
  return {{"value", told->value}, {"ci95", {told->low, told->high}}};
}

}  // namespace

double NumberDifference::deviations() const {
  if (!left || !right) return 0.0;
  const double error = std::hypot(error_of(*left), error_of(*right)), moved = right->value - left->value;
  return error > 0.0 ? moved / error : 0.0;
}

bool NumberDifference::changed() const {
  if (!left || !right) return of_effect;
  return std::abs(deviations()) > beyond_chance;
}

bool DiagnosisDifference::changed() const {
  return left_verdict != right_verdict || std::ranges::any_of(numbers, &NumberDifference::changed);
}

bool is_diagnosis_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path / "diagnosis.json", ignored);
}

DiagnosisDifference compare_diagnoses(const fs::path& left, const fs::path& right) {
  for (const fs::path& folder : {left, right})
    if (!is_diagnosis_folder(folder))
      throw input::MissingInput(folder.string() +
                                ": is not a folder that diagnose wrote, as the other is: no "
                                "diagnosis.json in it");
  const Json before = read(left), after = read(right);
  DiagnosisDifference found;
  try {
    found = {before.at("verdict"),
             after.at("verdict"),
             side_by_side(numbers_of(before), numbers_of(after)),
             {},
             after.at("gap").value("unit", "1")};
    for (const char* key : {"nominal_rmse", "recalibrated_rmse", "corrected_rmse", "noise_floor"})
      found.errors.push_back({key, before.at("gap").at(key), after.at("gap").at(key)});
    if (before.at("gap").value("unit", "1") != found.unit)
      throw input::BadInput({{input::Severity::error,
                              (right / "diagnosis.json").string(),
                              {},
                              "compares another reading than " + (left / "diagnosis.json").string(),
                              ""}});
  } catch (const Json::exception& error) {
    throw input::BadInput({{input::Severity::error,
                            left.string() + " or " + right.string(),
                            {},
                            fmt::format("is no diagnosis of this program: {}", error.what()),
                            ""}});
  }
  return found;
}

Json json_of(const DiagnosisDifference& found) {
  Json numbers = Json::array(), errors = Json::object();
  for (const NumberDifference& one : found.numbers)
    numbers.push_back({{"name", one.name},
                       {"unit", one.unit},
                       {"left", json_of(one.left)},
                       {"right", json_of(one.right)},
                       {"deviations", one.left && one.right ? Json(one.deviations()) : Json()},
                       {"changed", one.changed()}});
  for (const auto& error : found.errors) errors[error.key] = {{"left", error.left}, {"right", error.right}};
  return {{"verdict", {{"left", found.left_verdict}, {"right", found.right_verdict}}},
          {"changed", found.changed()},
          {"numbers", std::move(numbers)},
          {"gap", std::move(errors)}};
}

std::string text_of(const DiagnosisDifference& found) {
  std::string text =
      fmt::format("verdict: {}\n\n", found.left_verdict == found.right_verdict
                                         ? found.left_verdict + ", both"
                                         : found.left_verdict + ", then " + found.right_verdict);
  output::Grid grid({"number", "left", "right", "difference in standard errors", ""}, 3);
  for (const NumberDifference& one : found.numbers)
    grid.add({one.name, shown(one.left, one.unit), shown(one.right, one.unit),
              one.left && one.right ? output::rounded(one.deviations(), 1, true) : "-",
              !one.changed()          ? ""
              : one.left && one.right ? "changed"
              : one.left              ? "gone"
                                      : "new"});
  if (!grid.empty()) text += grid.text() + "\n";
  output::Grid errors({"error on runs held out", "left", "right"}, 1);
  for (const auto& error : found.errors)
    errors.add({error.key, fmt::format("{:.3g}", error.left), fmt::format("{:.3g}", error.right)});
  text += errors.text() + "\n";
  return text +
         (found.changed()
              ? "The rig has changed: see the last column.\n"
              : fmt::format("No number differs by more than {:g} standard errors: the rig is the same as "
                            "far as these data tell.\n",
                            beyond_chance));
}

}  // namespace mckibben::cli
