// Reading of scenarios, and the rules that need more than one field; see the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/current_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

/// The checks that look at a whole scenario and at the places in its file.
class ScenarioChecker {
 public:
  ScenarioChecker(const YamlFile& file, Scenario& scenario, Problems& problems)
      : file_(file), source_(file.source), root_(file.root), scenario_(scenario), problems_(problems) {}

  void check() {
    check_name(file_, scenario_.name, problems_);
    check_duration(file_, scenario_.duration_s, scenario_.rig, problems_);
    check_noise();
    check_lifts_a_load(file_, scenario_.rig, problems_);
    check_loads(file_, scenario_.loads_kg, scenario_.rig, problems_);
    check_rig();
    check_controllers();
    check_criteria();
    check_robustness();
    check_target();
  }

 private:
  const Node& list(std::string_view key) const { return *root_.find(key); }

  void check_noise() {
    if (scenario_.noise.gauge_Pa > 0.0 && !scenario_.rig.gauge.fitted)
      problems_.warning(source_, list("noise").place,
                        "noise.gauge has no effect: the rig has no gauge (gauge: {fitted: true})");
  }

  void check_rig() {
    const Node* rig = root_.find("rig");
    check_dac(scenario_.rig, source_, rig != nullptr ? rig->place : root_.place, problems_);
  }

  void check_controllers() {
    const Node& nodes = list("controllers");
    if (scenario_.controllers.empty())
      problems_.error(source_, nodes.place, "controllers: at least one controller is needed");
    std::unordered_map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < scenario_.controllers.size(); ++i) {
      const Node& node = nodes.children[i];
      const Node* given = node.find("name");
      const Place place = given != nullptr ? given->place : node.place;
      const std::string& name = controllers::name_of(scenario_.controllers[i]);
      const auto [earlier, is_new] = first.try_emplace(name, node.place.line);
      if (!is_file_safe(name))
        problems_.error(source_, place, fmt::format("name = {}: {}", name, file_safe_rule));
      else if (!is_new)
        problems_.error(
            source_, place,
            fmt::format("the name {} is already that of the controller in line {}; give each a name", name,
                        earlier->second));
      if (auto* recorded = std::get_if<controllers::RecordedCurrent>(&scenario_.controllers[i]))
        load_recording(*recorded, source_, *node.find("file"), scenario_.rig, problems_);
      if (auto* guest = controllers::guest_terms(scenario_.controllers[i]))
        guest->folder = source_.folder().string();
      if (const auto* plugin = std::get_if<controllers::PluginSettings>(&scenario_.controllers[i]))
        look_for_library(plugin->library, *node.find("library"));
      follow_valve(scenario_.controllers[i], source_, node, scenario_.rig, problems_);
      if (const auto* terms = controllers::model_terms(scenario_.controllers[i]);
          terms && !terms->rig.empty())
        load_believed_rig(name, *node.find("rig"));
      if (auto* calibrated = controllers::calibrated(scenario_.controllers[i]))
        load_calibration(*calibrated, controllers::weighing_of(scenario_.controllers[i]), node);
    }
  }

  /// Reading a scenario runs nothing of it; what is in the library is seen when it is used.
  void look_for_library(const std::string& library, const Node& node) {
    constexpr std::size_t largest_library_bytes = 256U << 20U;
    try {
      problems_.opened(Source::load((source_.folder() / library).lexically_normal(), largest_library_bytes));
    } catch (const MissingInput& missing) {
      problems_.missing_file(source_, node.place, missing.what());
    }
  }

  void load_believed_rig(const std::string& controller, const Node& node) {
    RigFile& rig = scenario_.believed[controller];
    read_named(source_, node, rig, problems_);
    if (const std::string why = no_load(rig); !why.empty())
      problems_.error(source_, node.place, "rig: " + why);
  }

  // Several controllers may share a calibration: it is read, and complained about, once.
  const std::optional<controllers::Calibration>& calibration(const std::string& file, const Node& node) {
    const auto path = (source_.folder() / file).lexically_normal();
    const auto [entry, is_new] = calibrations_.try_emplace(path.string());
    if (!is_new) return entry->second;
    try {
      entry->second = read_calibration(path, scenario_.inputs);
    } catch (const MissingInput& missing) {
      problems_.missing_file(source_, node.place, missing.what());
    } catch (const BadInput& bad) {
      problems_.adopt(bad.problems());
    }
    return entry->second;
  }

  void load_calibration(controllers::CalibrationTerms& settings,
                        const controllers::WeighingSettings* contractions, const Node& node) {
    const auto& model = calibration(settings.calibration, *node.find("calibration"));
    if (!model) return;
    settings.model = *model;
    const controllers::CalibratedRange& range = settings.model.range;
    const auto check = [&](const Node* given, std::string_view key, double value, double lowest,
                           double highest, std::string_view unit) {
      if (settings.extrapolate_load || (value >= lowest && value <= highest)) return;
      problems_.error(source_, given != nullptr ? given->place : node.place,
                      fmt::format("{} = {:g} {} is outside what {} was made with, {:g} to {:g} {}; calibrate "
                                  "on both sides of it, or allow it with extrapolate_load: true",
                                  key, value, unit, settings.calibration, lowest, highest, unit));
    };
    if (settings.assumed_load_kg) {
      check(node.find("assumed_load"), "assumed_load", *settings.assumed_load_kg, range.lowest_load_kg,
            range.highest_load_kg, "kg");
    } else if (contractions != nullptr) {
      const Node* weighing = node.find("weighing");
      check(weighing != nullptr ? weighing->find("speed") : nullptr, "weighing.speed",
            *contractions->speed_mA_per_s, range.lowest_speed_mA_per_s, range.highest_speed_mA_per_s, "mA/s");
    }
  }

  void check_robustness() {
    if (scenario_.robustness.rigs == 0) return;
    const bool stated =
        std::any_of(scenario_.rig.spreads.begin(), scenario_.rig.spreads.end(),
                    [](const auto& one) { return std::isfinite(one.second) && one.second > 0.0; });
    if (!stated)
      problems_.error(source_, list("robustness").place,
                      "robustness draws rigs within the ± of the rig's file, and this rig states none: write "
                      "`rest_radius: 7.5 mm ± 1 %` where you know how well a number is known");
  }

  void check_criteria() {
    std::vector<std::string_view> names;
    for (const controllers::Settings& settings : scenario_.controllers)
      names.push_back(controllers::name_of(settings));
    for (std::size_t i = 0; i < scenario_.criteria.size(); ++i) {
      const Node* given = list("criteria").children[i].find("controller");
      const std::string& name = scenario_.criteria[i].controller;
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
        problems_.error(source_, given->place,
                        fmt::format("controller = {} is not a controller of this scenario: {}{}", name,
                                    join(names), did_you_mean(name, names)));
    }
  }

  void check_target() {
    const auto [lowest, highest] =
        controllers::range(scenario_.target, scenario_.duration_s, scenario_.rig.muscle.rest_length_m);
    const double largest = plant::Braid(scenario_.rig.muscle).largest_contraction_ratio();
    const Place place = list("target").place;
    if (!std::isfinite(lowest) || !std::isfinite(highest) || highest > largest)
      problems_.error(source_, place,
                      fmt::format("the target rises to a contraction ratio of {:.4g}; "
                                  "the muscle's limit is {:.4g} (T 2.10)",
                                  highest, largest));
    else if (highest > plant::risky_contraction_ratio)
      problems_.warning(
          source_, place,
          fmt::format(
              "the target rises to a contraction ratio of {:.4g}; above a contraction ratio of {:.2f} "
              "there is a risk to the muscle (T 2.3)",
              highest, plant::risky_contraction_ratio));
    if (lowest < 0.0)
      problems_.warning(source_, place,
                        fmt::format("the target falls to a contraction ratio of {:.4g}; "
                                    "below 0 the threads are taut",
                                    lowest));
  }

  const YamlFile& file_;
  const Source& source_;
  const Node& root_;
  Scenario& scenario_;
  Problems& problems_;
  std::map<std::string, std::optional<controllers::Calibration>> calibrations_;
};

}  // namespace

Scenario read_scenario(Source source, std::vector<Problem>& warnings) {
  const YamlFile file = parse_yaml(std::move(source));
  Problems problems;
  problems.opened(file.source);
  problems.adopt(file.found);
  Scenario scenario;
  scenario.name = made_file_safe(fs::path(file.source.name()).stem().string());
  constexpr std::string_view also_allowed[] = {"schema"};
  if (check_schema(file, scenario_schema, problems))
    read_struct(file.source, file.root, scenario, problems, also_allowed);
  if (problems.errors() == 0) ScenarioChecker(file, scenario, problems).check();
  problems.raise();
  scenario.inputs.insert(scenario.inputs.begin(), problems.inputs().begin(), problems.inputs().end());
  const std::vector<Problem> found = problems.warnings();
  warnings.insert(warnings.end(), found.begin(), found.end());
  return scenario;
}

Scenario read_scenario(const std::filesystem::path& path, std::vector<Problem>& warnings) {
  return read_scenario(Source::load(path, largest_yaml_bytes), warnings);
}

Json scenario_json(const Scenario& scenario) {
  Json file{{"schema", scenario_schema}};
  file.update(to_json(scenario));
  return file;
}

}  // namespace mckibben::input
