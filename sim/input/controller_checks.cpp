// See the header.
#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/controller_checks.hpp>
#include <sim/input/current_checks.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/rigs.hpp>

namespace mckibben::input {
namespace {

class ControllerChecker {
 public:
  ControllerChecker(const YamlFile& file, Scenario& scenario, Problems& problems)
      : source_(file.source), root_(file.root), scenario_(scenario), problems_(problems) {}

  void operator()() {
    UsedNames names;
    for (std::size_t i = 0; i < scenario_.controllers.size(); ++i) {
      const Node& node = (*root_.find("controllers")).children[i];
      const std::string& name = controllers::name_of(scenario_.controllers[i]);
      check_used_name(source_, name, node, "controller", names, problems_);
      if (auto* recorded = std::get_if<controllers::RecordedCurrent>(&scenario_.controllers[i]))
        load_recording(*recorded, source_, *node.find("file"), scenario_.rig, problems_);
      if (auto* guest = controllers::part_of<controllers::GuestTerms>(scenario_.controllers[i]))
        guest->folder = source_.folder().string();
      if (const auto* plugin = std::get_if<controllers::PluginSettings>(&scenario_.controllers[i]))
        look_for_library(plugin->library, *node.find("library"));
      if (const auto* filter = controllers::filter_of(scenario_.controllers[i]))
        check_filter(*filter, *node.find("command_filter")->find("frequency"));
      if (auto* calibrated = controllers::part_of<controllers::CalibrationTerms>(scenario_.controllers[i]))
        load_calibration(*calibrated, controllers::weighing_of(scenario_.controllers[i]), node);
      follow_valve(scenario_.controllers[i], source_, node, scenario_.rig, problems_);
      check_sets_a_pressure(scenario_.controllers[i], *node.find("kind"));
      warn_of_held(scenario_.controllers[i], node);
      warn_of_steps(scenario_.controllers[i], *node.find("kind"));
      if (const auto* terms = controllers::part_of<controllers::PlansWithModel>(scenario_.controllers[i]);
          terms && !terms->rig.empty())
        load_believed_rig(name, *node.find("rig"));
    }
  }

 private:
  /// Inverses of pressure over contraction.
  void check_sets_a_pressure(const controllers::Settings& settings, const Node& kind) {
    if (!scenario_.rig.valve.is_on_off()) return;
    if (std::holds_alternative<controllers::StaticInverseSettings>(settings) ||
        controllers::part_of<controllers::CalibrationTerms>(settings) != nullptr)
      problems_.error(source_, kind.place,
                      fmt::format("kind = {}: its commands are pressures, and the rig's on_off valve sets a "
                                  "flow; model_inverse and pid can drive it",
                                  kind.text));
  }

  /// P0 cannot be held and make the joint as stiff as wanted.
  void warn_of_held(const controllers::Settings& settings, const Node& node) {
    const auto* terms = controllers::part_of<controllers::JointTerms>(settings);
    const bool stiffness = std::ranges::any_of(
        scenario_.targets, [](const domain::JointTarget& target) { return target.stiffness.has_value(); });
    if (!stiffness || terms == nullptr || !terms->co_contraction_Pa) return;
    const Node& held = *node.find("co_contraction");
    problems_.warning(source_, held.place,
                      fmt::format("co_contraction = {}: it is held, so {} does not follow the stiffness of "
                                  "targets; leave co_contraction out to follow it",
                                  held.text, controllers::name_of(settings)));
  }

  /// The inverse of the thesis is of a contraction and its speed.
  void warn_of_steps(const controllers::Settings& settings, const Node& kind) {
    const auto* open = std::get_if<controllers::OpenLoopSettings>(&settings);
    const auto* steps = std::get_if<controllers::Steps>(&scenario_.target);
    if (open == nullptr || open->mode != controllers::OpenLoopMode::trajectory || steps == nullptr ||
        steps->moves.empty())
      return;
    problems_.warning(
        source_, kind.place,
        "kind = open_loop: it cannot follow steps, as its command depends on the target's speed: "
        "at each it jumps to the command for the fastest calibrated speed, and the load stays "
        "off the target; write a target of kind: minimum_jerk or ramps");
  }

  void check_filter(const controllers::CommandFilter& filter, const Node& frequency) {
    const double half_Hz = 0.5 / scenario_.rig.tick_s;
    if (filter.frequency_Hz >= half_Hz)
      problems_.error(
          source_, frequency.place,
          fmt::format("frequency = {}: must be below half the sampling rate, {:.4g} Hz (rig: tick)",
                      frequency.text, half_Hz));
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
    if (scenario_.rig.pair() != nullptr && problems_.errors() == 0 && rig.pair() == nullptr)
      problems_.error(source_, node.place, "rig: it has one muscle, a controller of a pair needs two");
    if (problems_.errors() == 0 && rig.command_unit() != scenario_.rig.command_unit())
      problems_.error(source_, node.place,
                      fmt::format("rig: its valve is commanded in {}, the scenario's in {}",
                                  name_of(rig.command_unit()), name_of(scenario_.rig.command_unit())));
    if (problems_.errors() == 0 && rig_json(rig) == rig_json(scenario_.rig))
      problems_.warning(
          source_, node.place,
          fmt::format("rig = {}: this is the simulated rig itself, so {} knows it exactly; to see "
                      "what a wrong model does, name a rig that differs from it",
                      node.kind == Node::Kind::scalar ? node.text : "{...}", controller));
    if (const std::string why = no_load(rig); scenario_.rig.pair() == nullptr && !why.empty())
      problems_.error(source_, node.place, "rig: " + why);
  }

  // Several controllers may share a calibration: it is read, and complained about, once.
  const std::optional<controllers::Calibration>& calibration(const std::string& file, const Node& node) {
    const auto path = file == shipped_calibration ? std::filesystem::path(file)
                                                  : (source_.folder() / file).lexically_normal();
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
                           double highest, std::string_view unit, const std::string& instead) {
      if (settings.extrapolate_load || (value >= lowest && value <= highest)) return;
      problems_.error(
          source_, given != nullptr ? given->place : node.place,
          fmt::format("{} = {:g} {} is outside what {} was made with, {:g} to {:g} {}; {}calibrate "
                      "on both sides of it, or allow it with extrapolate_load: true",
                      key, value, unit, settings.calibration, lowest, highest, unit, instead));
    };
    if (settings.assumed_load_kg) {
      check(node.find("assumed_load"), "assumed_load", *settings.assumed_load_kg, range.lowest_load_kg,
            range.highest_load_kg, "kg", "");
    } else if (contractions != nullptr && contractions->speed_mA_per_s) {
      const double speed = *contractions->speed_mA_per_s, lowest = range.lowest_speed_mA_per_s,
                   highest = range.highest_speed_mA_per_s;
      const std::string unit = in_unit(scenario_.rig.command_unit(), "mA/s");
      check(node.find("weighing")->find("speed"), "weighing.speed", speed, lowest, highest, unit,
            fmt::format("write weighing: {{speed: {} {}}}, ",
                        domain::write_number(std::clamp(speed, lowest, highest)), unit));
    }
  }

  const Source& source_;
  const Node& root_;
  Scenario& scenario_;
  Problems& problems_;
  std::map<std::string, std::optional<controllers::Calibration>> calibrations_;
};

}  // namespace

void check_used_name(const Source& source, const std::string& name, const Node& node, std::string_view what,
                     UsedNames& names, Problems& problems) {
  const Node* given = node.find("name");
  const Place place = given != nullptr ? given->place : node.place;
  const auto [earlier, is_new] = names.try_emplace(name, node.place.line);
  if (!is_file_safe(name))
    problems.error(source, place, fmt::format("name = {}: {}", name, file_safe_rule));
  else if (!is_new)
    problems.error(source, place,
                   fmt::format("the name {} is already that of the {} in line {}; give each a name", name,
                               what, earlier->second));
}

void check_controllers(const YamlFile& file, Scenario& scenario, Problems& problems) {
  ControllerChecker(file, scenario, problems)();
}

}  // namespace mckibben::input
