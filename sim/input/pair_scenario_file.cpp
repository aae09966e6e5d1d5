// Reading of pairs under given currents; see the header.
#include <unordered_map>

#include <fmt/format.h>

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
  }

 private:
  plant::Rig opposite() const { return plant::opposite_rig(scenario_.rig, *scenario_.rig.pair()); }

  void check_currents() {
    const Node& nodes = *file_.root.find("currents");
    if (scenario_.currents.empty())
      problems_.error(file_.source, nodes.place, "currents: at least one run is needed");
    std::unordered_map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < scenario_.currents.size(); ++i) {
      TwoCurrents& run = scenario_.currents[i];
      const Node& node = nodes.children[i];
      const Node* given = node.find("name");
      if (given == nullptr) run.name = fmt::format("c{:02}", i + 1);
      const Place place = given != nullptr ? given->place : node.place;
      const auto [earlier, is_new] = first.try_emplace(run.name, node.place.line);
      if (!is_file_safe(run.name))
        problems_.error(file_.source, place, fmt::format("name = {}: {}", run.name, file_safe_rule));
      else if (!is_new)
        problems_.error(file_.source, place,
                        fmt::format("the name {} is already that of the run in line {}; give each a name",
                                    run.name, earlier->second));
      complete(run.current_1, *node.find("current_1"), scenario_.rig);
      complete(run.current_2, *node.find("current_2"), opposite());
    }
  }

  /// What the waveform leaves to the rig or to a file.
  void complete(domain::CampaignWaveform& waveform, const Node& node, const plant::Rig& rig) {
    if (auto* steps = std::get_if<controllers::StepCurrent>(&waveform)) steps->follow(working_range(rig));
    if (auto* recorded = std::get_if<controllers::RecordedCurrent>(&waveform))
      load_recording(*recorded, file_.source, *node.find("file"), rig, problems_);
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
