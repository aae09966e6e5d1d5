// Reading of scenarios, and the rules that need more than one field; see the header.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <plant/plant.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/controller_checks.hpp>
#include <sim/input/current_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/joint_target_checks.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/target_place.hpp>
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
    if (!scenario_.rig.valve.seals()) check_controllers(file_, scenario_, problems_);
    check_criteria();
    check_robustness();
    if (pair() != nullptr && problems_.errors() == 0) check_files();
  }

 private:
  const Node& list(std::string_view key) const { return *root_.find(key); }
  const plant::Pair* pair() const { return scenario_.rig.pair(); }
  plant::Rig opposite() const { return plant::opposite_rig(scenario_.rig); }

  void check_name_of(const std::string& name, const Node& node, std::string_view what, UsedNames& names) {
    check_used_name(source_, name, node, what, names, problems_);
  }

  void check_noise() {
    if (scenario_.noise.gauge_Pa > 0.0)
      check_has_gauge(source_, list("noise"), "noise.gauge", scenario_.rig, problems_);
  }

  void check_rig() {
    const Node* rig = root_.find("rig");
    const Place place = rig != nullptr ? rig->place : root_.place;
    check_dac(scenario_.rig, source_, place, problems_);
    check_gauge_error(file_, scenario_.rig, problems_);
    if (const std::string keys = unknown_keys(scenario_.rig); !keys.empty())
      problems_.warning(source_, place,
                        fmt::format("{}, so results are one guess of many: {}", rig_is_unknown, keys));
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
    UsedNames names;
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
    UsedNames names;
    for (std::size_t i = 0; i < scenario_.targets.size(); ++i) {
      domain::JointTarget& target = scenario_.targets[i];
      const Node& node = list("targets").children[i];
      if (node.find("name") == nullptr) target.name = fmt::format("t{:02}", i + 1);
      check_name_of(target.name, node, "target", names);
      warn_of_late_moves(target.angle, *node.find("angle"));
      check_joint_target(file_, node, target, scenario_, problems_);
    }
  }

  /// A move that would begin when the run is over is never made.
  template <class Value>
  void warn_of_late_moves(const controllers::TargetOf<Value>& target, const Node& node) {
    const auto look = [&](const auto& path) {
      if constexpr (requires { path.moves; }) {
        const auto late = std::ranges::find_if(
            path.moves, [&](const auto& move) { return move.at_s >= scenario_.duration_s; });
        if (late == path.moves.end()) return;
        const Node& first = node.find("moves")->children[static_cast<std::size_t>(late - path.moves.begin())];
        problems_.warning(source_, first.place,
                          fmt::format("at = {:g} s is not before the end: duration = {:g} s; what is wanted "
                                      "from here on is never begun",
                                      late->at_s, scenario_.duration_s));
      }
    };
    std::visit(look, target);
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
      const auto follows = std::ranges::find_if_not(scenario_.controllers, domain::is_given);
      const bool none = scenario_.controllers.empty();
      if (!scenario_.rig.valve.seals() && (none || follows != scenario_.controllers.end()))
        problems_.error(source_, root_.place,
                        fmt::format("the key target is missing: the movement that {} follows",
                                    none ? "a controller" : controllers::name_of(*follows)));
      const auto stays_at_0 = []<class Value>(controllers::TargetOf<Value>& target) {
        target = controllers::PointsOf<Value>{.points = std::vector<controllers::MoveOf<Value>>(1)};
      };
      stays_at_0(scenario_.target);
      stays_at_0(scenario_.angle);
      return;
    }
    if (scenario_.rig.lever() != nullptr) {
      warn_of_late_moves(scenario_.angle, list("target"));
      return check_lever_target(list("target").place);
    }
    warn_of_late_moves(scenario_.target, list("target"));
    const auto [lowest, highest] =
        controllers::range(scenario_.target, scenario_.duration_s, scenario_.rig.muscle.rest_length_m);
    const double largest = plant::Braid(scenario_.rig.muscle).largest_contraction_ratio();
    const Node& target = list("target");
    const double l0_m = scenario_.rig.muscle.rest_length_m;
    const auto place_of = [&](const auto& beyond) {
      return place_of_value(scenario_.target, target, l0_m, beyond);
    };
    const Place place = place_of([highest = highest](double ratio) { return ratio >= highest; });
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
      problems_.warning(source_, place_of([](double ratio) { return ratio < 0.0; }),
                        fmt::format("the target falls to a contraction ratio of {:.4g}; "
                                    "below 0 the threads are taut",
                                    lowest));
  }

  /// It goes as far as the muscle and the joint's stops let it.
  void check_lever_target(Place target) {
    const auto [lowest, highest] = controllers::range(scenario_.angle, scenario_.duration_s, 1.0);
    const plant::Rig& rig = scenario_.rig;
    const double most = plant::plant_of(rig).ratio_at_rad(highest),
                 largest = plant::Braid(rig.muscle).largest_contraction_ratio();
    if (!(most <= largest))
      problems_.error(
          source_, target,
          fmt::format("the target takes the muscle to a contraction ratio of {:.4g}; its limit is "
                      "{:.4g} (T 2.10)",
                      most, largest));
    else if (lowest < rig.joint.lowest_rad || highest > rig.joint.highest_rad)
      problems_.error(source_, target,
                      fmt::format("the target goes from {:.4g} to {:.4g} deg, beyond the rig's "
                                  "joint.lowest_angle or highest_angle",
                                  lowest / plant::degree_rad, highest / plant::degree_rad));
  }

  const YamlFile& file_;
  const Source& source_;
  const Node& root_;
  Scenario& scenario_;
  Problems& problems_;
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
