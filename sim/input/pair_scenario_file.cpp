// Reading of pairs and what is wanted of them; see the header.
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/current_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/pair_scenario_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

class PairChecker {
 public:
  PairChecker(const YamlFile& file, PairScenario& scenario, Problems& problems)
      : file_(file), scenario_(scenario), problems_(problems) {}

  void check() {
    check_name(file_, scenario_.name, problems_);
    const Node* rig = file_.root.find("rig");
    const Place place = rig != nullptr ? rig->place : file_.root.place;
    if (scenario_.rig.pair() == nullptr) {
      problems_.error(
          file_.source, place,
          "this rig has one muscle; two currents need two: rig: thesis_pair, or mechanics: {kind: pair}");
      return;
    }
    check_dac(scenario_.rig, file_.source, place, problems_);
    check_dac(opposite(), file_.source, place, problems_);
    check_duration(file_, scenario_.duration_s, scenario_.rig, problems_);
    check_currents();
    check_controlled();
    check_targets();
    check_hand();
    check_controllers();
    if (problems_.errors() == 0) check_files();
  }

 private:
  plant::Rig opposite() const { return plant::opposite_rig(scenario_.rig, *scenario_.rig.pair()); }

  void check_currents() {
    Names names;
    for (std::size_t i = 0; i < scenario_.currents.size(); ++i) {
      TwoCurrents& run = scenario_.currents[i];
      const Node& node = file_.root.find("currents")->children[i];
      if (node.find("name") == nullptr) run.name = fmt::format("c{:02}", i + 1);
      check_name_of(run.name, node, "run", names);
      complete_current(run.current_1, file_.source, *node.find("current_1"), scenario_.rig, problems_);
      complete_current(run.current_2, file_.source, *node.find("current_2"), opposite(), problems_);
    }
  }

  /// Either currents, or targets and controllers, or all of them.
  void check_controlled() {
    const bool targets = !scenario_.targets.empty(), controllers = !scenario_.controllers.empty();
    const auto lacks = [&](std::string_view what) {
      problems_.error(file_.source, file_.root.place, std::string(what));
    };
    if (scenario_.currents.empty() && !targets && !controllers)
      lacks("nothing is to be run: give currents, or targets and controllers");
    if (targets && !controllers) lacks("targets need controllers that follow them");
    if (controllers && !targets) lacks("controllers need targets that they follow");
  }

  void check_targets() {
    Names names;
    for (std::size_t i = 0; i < scenario_.targets.size(); ++i) {
      domain::JointTarget& target = scenario_.targets[i];
      const Node& node = file_.root.find("targets")->children[i];
      if (node.find("name") == nullptr) target.name = fmt::format("t{:02}", i + 1);
      check_name_of(target.name, node, "target", names);
      const plant::Pair& pair = *scenario_.rig.pair();
      const double radius_m = scenario_.rig.joint.wheel_radius_m;
      const auto [lowest, highest] = controllers::range(target.angle, scenario_.duration_s, 1.0);
      const Place place = node.find("angle")->place;
      check_contraction(1, pair.contraction_ratio, radius_m * highest, scenario_.rig.muscle, place);
      check_contraction(2, pair.opposite_contraction_ratio, -radius_m * lowest, pair.opposite.muscle, place);
    }
  }

  void check_contraction(int muscle, double mounted, double rise_m, const plant::Muscle& of, Place place) {
    const double most = mounted + rise_m / of.rest_length_m,
                 largest = plant::Braid(of).largest_contraction_ratio();
    if (!(most <= largest))
      problems_.error(file_.source, place,
                      fmt::format("the angle takes muscle {} to a contraction ratio of {:.4g}; its limit is "
                                  "{:.4g} (T 2.10)",
                                  muscle, most, largest));
  }

  void check_hand() {
    const Node* hand = file_.root.find("hand");
    if (hand == nullptr) return;
    const Node* loads = hand->find("loads");
    if (loads == nullptr) return;
    if (scenario_.hand.loads_kg.empty())
      problems_.error(file_.source, loads->place,
                      "loads: at least one load is needed, 0 kg for an empty hand");
    std::set<double> earlier;
    for (std::size_t i = 0; i < scenario_.hand.loads_kg.size(); ++i)
      if (!earlier.insert(scenario_.hand.loads_kg[i]).second)
        problems_.error(file_.source, loads->children[i].place,
                        fmt::format("loads: {} stands in the list already", loads->children[i].text));
  }

  void check_controllers() {
    Names names;
    for (std::size_t i = 0; i < scenario_.controllers.size(); ++i) {
      const Node& node = file_.root.find("controllers")->children[i];
      const std::string& name = controllers::name_of(scenario_.controllers[i]);
      check_name_of(name, node, "controller", names);
      const auto* terms = controllers::model_terms(scenario_.controllers[i]);
      if (terms == nullptr || terms->rig.empty()) continue;
      RigFile& rig = scenario_.believed[name];
      const Node& given = *node.find("rig");
      read_named(file_.source, given, rig, problems_);
      if (problems_.errors() == 0 && rig.pair() == nullptr)
        problems_.error(file_.source, given.place,
                        "rig: it has one muscle, a controller of a pair needs two");
    }
  }

  /// Each run has files of its own.
  void check_files() {
    std::set<std::string> names;
    for (const TwoCurrents& run : scenario_.currents) names.insert(run.name);
    for (std::size_t t = 0; t < scenario_.targets.size(); ++t)
      for (const double load_kg : scenario_.hand.loads_kg)
        for (std::size_t c = 0; c < scenario_.controllers.size(); ++c)
          if (const auto name = domain::name_of_run(scenario_, t, load_kg, c); !names.insert(name).second)
            problems_.error(file_.source, file_.root.find("targets")->children[t].place,
                            fmt::format("two runs would be called {}; choose other names", name));
  }

  using Names = std::unordered_map<std::string, std::size_t>;  // and the lines in which they stand
  void check_name_of(const std::string& name, const Node& node, std::string_view what, Names& names) {
    const Node* given = node.find("name");
    const Place place = given != nullptr ? given->place : node.place;
    const auto [earlier, is_new] = names.try_emplace(name, node.place.line);
    if (!is_file_safe(name))
      problems_.error(file_.source, place, fmt::format("name = {}: {}", name, file_safe_rule));
    else if (!is_new)
      problems_.error(file_.source, place,
                      fmt::format("the name {} is already that of the {} in line {}; give each a name", name,
                                  what, earlier->second));
  }

  const YamlFile& file_;
  PairScenario& scenario_;
  Problems& problems_;
};

}  // namespace

PairScenario read_pair_scenario(Source source) {
  const YamlFile file = parse_yaml(std::move(source));
  Problems problems;
  problems.opened(file.source);
  problems.adopt(file.found);
  PairScenario scenario;
  scenario.name = made_file_safe(std::filesystem::path(file.source.name()).stem().string());
  constexpr std::string_view also_allowed[] = {"schema"};
  if (check_schema(file, pair_schema, problems))
    read_struct(file.source, file.root, scenario, problems, also_allowed);
  if (problems.errors() == 0) PairChecker(file, scenario, problems).check();
  problems.raise();
  scenario.inputs = problems.inputs();
  return scenario;
}

PairScenario read_pair_scenario(const std::filesystem::path& path) {
  return read_pair_scenario(Source::load(path, largest_yaml_bytes));
}

Json pair_scenario_json(const PairScenario& scenario) {
  Json file{{"schema", pair_schema}};
  file.update(to_json(scenario));
  return file;
}

}  // namespace mckibben::input
