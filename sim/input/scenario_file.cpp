// Reading of scenarios, and the rules that need more than one field; see the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/current_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/lever_checks.hpp>
#include <sim/input/quantity.hpp>
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
    if (const Node* skip = file_.root.find("skip"); skip && *scenario_.skip_s >= scenario_.duration_s)
      problems_.error(file_.source, skip->place, "skip: must be shorter than the duration");
    check_noise();
    check_rig();
    if (pair() != nullptr) {
      check_currents();
      check_outer_forces();
      check_joint_targets();
      check_hand();
      check_controlled();
    } else {
      check_lifts_a_load(file_, scenario_.rig, problems_);
      check_loads(file_, scenario_.loads_kg, scenario_.rig, problems_);
      check_target();
      check_outer_forces();
      if (scenario_.rig.valve.seals())
        let_alone();
      else if (scenario_.controllers.empty())
        problems_.error(source_, list("controllers").place, "controllers: at least one controller is needed");
    }
    if (!scenario_.rig.valve.seals()) check_controllers();
    check_criteria();
    check_robustness();
    if (pair() != nullptr && problems_.errors() == 0) check_files();
  }

 private:
  using Names = std::unordered_map<std::string, std::size_t>;  // and the lines in which they stand

  const Node& list(std::string_view key) const { return *root_.find(key); }
  const plant::Pair* pair() const { return scenario_.rig.pair(); }
  plant::Rig opposite() const { return plant::opposite_rig(scenario_.rig); }

  void check_name_of(const std::string& name, const Node& node, std::string_view what, Names& names) {
    const Node* given = node.find("name");
    const Place place = given != nullptr ? given->place : node.place;
    const auto [earlier, is_new] = names.try_emplace(name, node.place.line);
    if (!is_file_safe(name))
      problems_.error(source_, place, fmt::format("name = {}: {}", name, file_safe_rule));
    else if (!is_new)
      problems_.error(source_, place,
                      fmt::format("the name {} is already that of the {} in line {}; give each a name", name,
                                  what, earlier->second));
  }

  void check_noise() {
    if (scenario_.noise.gauge_Pa > 0.0 && scenario_.rig.sensors.of(plant::Sensed::muscle_pressure) == nullptr)
      problems_.warning(source_, list("noise").place,
                        "noise.gauge has no effect: the rig has no gauge (sensors: [{signal: "
                        "muscle_pressure, kind: gauge}])");
  }

  void check_rig() {
    const Node* rig = root_.find("rig");
    const Place place = rig != nullptr ? rig->place : root_.place;
    check_dac(scenario_.rig, source_, place, problems_);
    if (const std::string keys = unknown_keys(scenario_.rig); !keys.empty())
      problems_.warning(
          source_, place,
          fmt::format("these values of the rig are ± unknown, so results are one guess of many: {}", keys));
    if (pair() != nullptr) check_dac(opposite(), source_, place, problems_);
  }

  /// Keys that are written as ± unknown.
  static std::string unknown_keys(const plant::Rig& rig) {
    std::vector<std::string_view> keys;
    for (const auto& [path, deviation] : rig.spreads)
      if (std::isinf(deviation)) keys.push_back(path);
    return join_few(keys);
  }

  void check_currents() {
    Names names;
    for (std::size_t i = 0; i < scenario_.currents.size(); ++i) {
      domain::TwoCurrents& run = scenario_.currents[i];
      const Node& node = list("currents").children[i];
      if (node.find("name") == nullptr) run.name = fmt::format("c{:02}", i + 1);
      check_name_of(run.name, node, "run", names);
      complete_current(run.current_1, source_, *node.find("current_1"), scenario_.rig, problems_);
      complete_current(run.current_2, source_, *node.find("current_2"), opposite(), problems_);
    }
  }

  void check_joint_targets() {
    Names names;
    for (std::size_t i = 0; i < scenario_.targets.size(); ++i) {
      domain::JointTarget& target = scenario_.targets[i];
      const Node& node = list("targets").children[i];
      if (node.find("name") == nullptr) target.name = fmt::format("t{:02}", i + 1);
      check_name_of(target.name, node, "target", names);
      const double radius_m = scenario_.rig.joint.wheel_radius_m;
      const auto [lowest, highest] = controllers::range(target.angle, scenario_.duration_s, 1.0);
      const Place place = node.find("angle")->place;
      check_contraction(1, pair()->contraction_ratio, radius_m * highest, scenario_.rig.muscle, place);
      check_contraction(2, pair()->opposite_contraction_ratio, -radius_m * lowest, pair()->opposite.muscle,
                        place);
    }
  }

  void check_contraction(int muscle, double mounted, double rise_m, const plant::Muscle& of, Place place) {
    const double most = mounted + rise_m / of.rest_length_m,
                 largest = plant::Braid(of).largest_contraction_ratio();
    if (!(most <= largest))
      problems_.error(source_, place,
                      fmt::format("the angle takes muscle {} to a contraction ratio of {:.4g}; its limit is "
                                  "{:.4g} (T 2.10)",
                                  muscle, most, largest));
  }

  void check_hand() {
    const Node* hand = root_.find("hand");
    const Node* loads = hand != nullptr ? hand->find("loads") : nullptr;
    if (loads == nullptr) return;
    if (scenario_.loads_kg.empty())
      problems_.error(source_, loads->place, "loads: at least one load is needed, 0 kg for an empty hand");
    check_different(scenario_.loads_kg, *loads, source_, problems_);
  }

  /// Either currents, or targets and controllers, or all of them.
  void check_controlled() {
    const bool targets = !scenario_.targets.empty(), controllers = !scenario_.controllers.empty();
    const auto lacks = [&](std::string_view what) {
      problems_.error(source_, root_.place, std::string(what));
    };
    if (scenario_.currents.empty() && !targets && !controllers)
      lacks("nothing is to be run: give currents, or targets and controllers");
    if (targets && !controllers) lacks("targets need controllers that follow them");
    if (controllers && !targets) lacks("controllers need targets that they follow");
  }

  /// Each run has files of its own.
  void check_files() {
    std::set<std::string> names;
    for (const domain::TwoCurrents& run : scenario_.currents) names.insert(run.name);
    for (std::size_t t = 0; t < scenario_.targets.size(); ++t)
      for (const double load_kg : scenario_.loads_kg)
        for (const auto& controller : scenario_.controllers)
          if (const auto name = domain::name_of_run(scenario_, t, load_kg, name_of(controller));
              !names.insert(name).second)
            problems_.error(source_, list("targets").children[t].place,
                            fmt::format("two runs would be called {}; choose other names", name));
  }

  /// A sealed muscle: its run goes by that name. What it does is told as an error from 0, unless there is a
  /// target.
  void let_alone() {
    if (!scenario_.controllers.empty())
      problems_.error(source_, list("controllers").place,
                      "controllers: the rig's muscle is sealed (valve: {kind: none}), so that nothing is "
                      "commanded; leave them out");
    scenario_.controllers = {controllers::StepCurrent{
        .name = "sealed", .start_mA = scenario_.rig.valve.zero_command, .moves = {}}};
  }

  void check_controllers() {
    Names names;
    for (std::size_t i = 0; i < scenario_.controllers.size(); ++i) {
      const Node& node = list("controllers").children[i];
      const std::string& name = controllers::name_of(scenario_.controllers[i]);
      check_name_of(name, node, "controller", names);
      if (auto* recorded = std::get_if<controllers::RecordedCurrent>(&scenario_.controllers[i]))
        load_recording(*recorded, source_, *node.find("file"), scenario_.rig, problems_);
      if (auto* guest = controllers::part_of<controllers::GuestTerms>(scenario_.controllers[i]))
        guest->folder = source_.folder().string();
      if (const auto* plugin = std::get_if<controllers::PluginSettings>(&scenario_.controllers[i]))
        look_for_library(plugin->library, *node.find("library"));
      follow_valve(scenario_.controllers[i], source_, node, scenario_.rig, problems_);
      if (const auto* terms = controllers::part_of<controllers::PlansWithModel>(scenario_.controllers[i]);
          terms && !terms->rig.empty())
        load_believed_rig(name, *node.find("rig"));
      if (auto* calibrated = controllers::part_of<controllers::CalibrationTerms>(scenario_.controllers[i]))
        load_calibration(*calibrated, controllers::weighing_of(scenario_.controllers[i]), node);
    }
  }

  /// Reading a scenario runs nothing of it; what is in the library is seen when it is used.
  void look_for_library(const std::string& library, const Node& node) {
    constexpr std::size_t largest_library_bytes = 256U << 20U;
    read_other(source_, node, problems_, [&] {
      problems_.opened(Source::load((source_.folder() / library).lexically_normal(), largest_library_bytes));
    });
  }

  void load_believed_rig(const std::string& controller, const Node& node) {
    Rig& rig = scenario_.believed[controller];
    read_named(source_, node, rig, problems_);
    if (pair() != nullptr && problems_.errors() == 0 && rig.pair() == nullptr)
      problems_.error(source_, node.place, "rig: it has one muscle, a controller of a pair needs two");
    if (problems_.errors() == 0 && rig.command_unit() != scenario_.rig.command_unit())
      problems_.error(source_, node.place,
                      fmt::format("rig: its valve is commanded in {}, the scenario's in {}",
                                  name_of(rig.command_unit()), name_of(scenario_.rig.command_unit())));
    if (const std::string why = no_load(rig); pair() == nullptr && !why.empty())
      problems_.error(source_, node.place, "rig: " + why);
  }

  // Several controllers may share a calibration: it is read, and complained about, once.
  const std::optional<controllers::Calibration>& calibration(const std::string& file, const Node& node) {
    const auto path = (source_.folder() / file).lexically_normal();
    const auto [entry, is_new] = calibrations_.try_emplace(path.string());
    if (!is_new) return entry->second;
    read_other(source_, node, problems_,
               [&, &read = entry->second] { read = read_calibration(path, scenario_.inputs); });
    return entry->second;
  }

  void load_calibration(controllers::CalibrationTerms& settings,
                        const controllers::WeighingSettings* contractions, const Node& node) {
    const auto& model = calibration(settings.calibration, *node.find("calibration"));
    if (!model) return;
    if (const std::string why =
            wrong_rig(*model, scenario_.rig, contractions != nullptr && !settings.assumed_load_kg);
        !why.empty())
      return problems_.error(source_, node.find("calibration")->place,
                             fmt::format("calibration = {}: {}", settings.calibration, why));
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
            *contractions->speed_mA_per_s, range.lowest_speed_mA_per_s, range.highest_speed_mA_per_s,
            in_unit(scenario_.rig.command_unit(), "mA/s"));
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

  /// Of what acts from outside, one after the other.
  template <class Outer>
  void check_times(std::string_view key, const std::vector<Outer>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto wrong = [&](std::string_view rule) {
        problems_.error(source_, list(key).children[i].place, fmt::format("{}: {}", key, rule));
      };
      if (i > 0 && all[i].at_s <= all[i - 1].at_s) wrong("times must ascend");
      if (all[i].at_s >= scenario_.duration_s) wrong("at must be before the end, duration");
    }
  }

  void check_outer_forces() {
    const auto& forces = scenario_.outer_forces;
    const plant::Rig& rig = scenario_.rig;
    if (!forces.empty() && rig.lever() != nullptr)
      return problems_.error(source_, list("joint_force").place,
                             "joint_force: forces on a cord are of a hanging load; the rig turns a lever, "
                             "which takes joint_torque");
    if (!scenario_.outer_torques.empty() && !rig.has_angle())
      return problems_.error(
          source_, list("joint_torque").place,
          "joint_torque: torques are of a lever or a pair; a hanging load takes joint_force");
    check_times("joint_force", forces);
    check_times("joint_torque", scenario_.outer_torques);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const auto wrong = [&](const std::string& message) {
        problems_.error(source_, list("joint_force").children[i].place, message);
      };
      for (const double load_kg : scenario_.loads_kg) {
        const double pulls_kg = rig.pulled_kg(load_kg) + forces[i].force_N / plant::gravity_m_per_s2;
        const double most_kg = plant::Braid(rig.muscle).largest_load_kg();
        if (pulls_kg < 0.0)
          wrong(fmt::format("joint_force: with a load of {:g} kg it would push the cord, which only pulls",
                            load_kg));
        else if (pulls_kg > most_kg)
          wrong(fmt::format(
              "joint_force: with a load of {:g} kg it is more than the taut threads bear, {:.4g} N", load_kg,
              most_kg * plant::gravity_m_per_s2));
        else
          continue;
        break;
      }
    }
  }

  void check_target() {
    if (root_.find("target") == nullptr) {
      const auto stays_at_0 = []<class Value>(controllers::TargetOf<Value>& target) {
        target = controllers::PointsOf<Value>{.points = std::vector<controllers::MoveOf<Value>>(1)};
      };
      stays_at_0(scenario_.target);
      stays_at_0(scenario_.angle);
      return;
    }
    if (scenario_.rig.lever() != nullptr)
      return check_lever_target(scenario_, source_, list("target").place, problems_);
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

/// Files of this schema are of two muscles, those of `thesis_pair` if they name no others. False if theirs
/// has one.
bool begin_pair(const YamlFile& file, Scenario& scenario, Problems& problems) {
  scenario.rig = plant::thesis_pair();
  const Node* given = file.root.find("rig");
  if (given == nullptr) return true;
  Rig rig = scenario.rig;
  Problems found;
  read_named(file.source, *given, rig, found);
  if (found.errors() > 0 || rig.pair() != nullptr) return true;
  problems.error(
      file.source, given->place,
      "this rig has one muscle; two currents need two: rig: thesis_pair, or mechanics: {kind: pair}");
  return false;
}

}  // namespace

Scenario read_scenario(Source source, std::vector<Problem>& warnings) {
  const YamlFile file = parse_yaml(std::move(source));
  Problems problems;
  Scenario scenario;
  scenario.name = made_file_safe(fs::path(file.source.name()).stem().string());
  constexpr std::string_view also_allowed[] = {"schema"};
  const Node* schema = file.root.find("schema");
  const bool of_pair = schema != nullptr && schema->text == pair_schema;
  if (begin_file(file, of_pair ? pair_schema : scenario_schema, problems) &&
      (!of_pair || begin_pair(file, scenario, problems)))
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
  return file_json(scenario_schema, scenario);
}

}  // namespace mckibben::input
