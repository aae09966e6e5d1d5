// A scenario: what a rig is to do, under which controllers, and what counts as good enough. One muscle lifts
// loads along a target; two turn a joint along targets with loads in the hand, or under given currents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <controllers/settings.hpp>
#include <controllers/target.hpp>
#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/outer_force.hpp>

namespace mckibben::domain {

/// Limits on the tracking error; a run that exceeds one ends with exit status 1. Errors are contraction
/// ratios, or of a joint angles [rad].
struct Criterion {
  std::string controller;
  std::optional<double> rmse_below;
  std::optional<double> largest_error_below;
  std::optional<double> spread_below;

  static void fields(auto& self, auto& visit) {
    visit("controller", self.controller, "name of the controller it is for; all if left out");
    visit("rmse_below", self.rmse_below, "1", 0.0, 1.0, "root mean square error, as contraction ratio");
    visit("largest_error_below", self.largest_error_below, "1", 0.0, 1.0,
          "largest error, as contraction ratio");
    visit("spread_below", self.spread_below, "1", 0.0, 1.0,
          "difference of the rmse between the worst and the best load, as contraction ratio");
  }
  void rules(auto& report) const {
    if (!rmse_below && !largest_error_below && !spread_below)
      report("rmse_below", "give this, largest_error_below or spread_below");
  }
};

/// The same as it is written of a joint.
struct JointCriterion : Criterion {
  static void fields(auto& self, auto& visit) {
    constexpr double turn_rad = 2.0 * std::numbers::pi;
    visit("controller", self.controller, "name of the controller it is for; all if left out");
    visit("rmse_below", self.rmse_below, "rad", 0.0, turn_rad, "root mean square error of the angle");
    visit("largest_error_below", self.largest_error_below, "rad", 0.0, turn_rad,
          "largest error of the angle");
    visit("spread_below", self.spread_below, "rad", 0.0, turn_rad,
          "difference of the rmse between the worst and the best run");
  }
};

/// Rigs drawn within what the rig's file says of its numbers; none: the described one alone is simulated.
struct Robustness {
  int rigs = 0;

  static void fields(auto& self, auto& visit) {
    visit("rigs", self.rigs, 0, 100000,
          "how many rigs are drawn within the ± of the rig's file, each with its own noise");
  }
};

/// The currents of one run.
struct TwoCurrents {
  std::string name;
  CampaignWaveform current_1, current_2;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name of the run; if left out, c and its place in the list");
    visit.required("current_1", self.current_1, "current to the valve of muscle 1");
    visit.required("current_2", self.current_2, "current to the valve of muscle 2");
  }
};

/// What is wanted of the joint.
struct JointTarget {
  std::string name;
  controllers::AngleTarget angle;
  std::optional<controllers::StiffnessTarget> stiffness;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "part of the names of its runs; if left out, t and its place in the list");
    visit.required("angle", self.angle, "the movement that is wanted");
    visit("stiffness", self.stiffness,
          "wanted stiffness of the joint; if left out, controllers hold their co-contraction");
  }
};

/// Where the link holds a load, and which ones it holds, one after the other.
struct Hand {
  double distance_m = 0.4;
  std::vector<double> loads_kg{0.0};

  static void fields(auto& self, auto& visit) {
    visit("distance", self.distance_m, "m", 0.0, 5.0,
          "from the axis to the load, in line with the link's mass");
    visit("loads", self.loads_kg, "kg", 0.0, 500.0, "masses in the hand; 0 kg is the link alone");
  }
};

/// Lets `visit` see a list as elements of another type, and takes back what it read.
template <class As, class List, class To, class Back, class Visit>
void visit_as(List& list, const To& to, const Back& back, const Visit& visit) {
  std::vector<As> seen;
  for (const auto& each : list) seen.push_back(to(each));
  visit(seen);
  if constexpr (!std::is_const_v<List>) {
    list.clear();
    for (const As& each : seen) list.push_back(back(each));
  }
}

struct Scenario {
  std::string name;
  plant::Rig rig;
  std::vector<double> loads_kg;       ///< that hang; of a pair in the hand
  controllers::Target target;         ///< of one muscle that lifts a load,
  controllers::AngleTarget angle;     ///< or turns a lever
  std::vector<JointTarget> targets;   ///< of a pair
  double hand_m = Hand{}.distance_m;  ///< of a pair: from the axis to the load
  std::vector<TwoCurrents> currents;  ///< of a pair: runs without a controller
  double duration_s = 0.0;
  std::optional<double> skip_s;  ///< of errors and tuning; absent: until the target first moves
  std::vector<controllers::Settings> controllers;
  std::vector<OuterForce> outer_forces;    ///< of a hanging load
  std::vector<OuterTorque> outer_torques;  ///< of a lever or a pair
  plant::Noise noise;
  std::uint64_t seed = 1;
  std::vector<Criterion> criteria;
  Robustness robustness;  ///< of one muscle

  std::map<std::string, plant::Rig> believed;  ///< rigs of controllers that name one, by controller
  std::vector<InputFile> inputs;               ///< the files it was read from

  /// The rig says which keys there are: it is visited first.
  static void fields(auto& self, auto& visit) {
    const bool pair = self.rig.pair() != nullptr;
    visit("name", self.name, "name of the results' folder; the file's name if left out");
    visit("rig", self.rig,
          pair ? "a shipped name, the path of a rig file, or changes in place; thesis_pair if left out"
               : "a shipped name, the path of a rig file, or changes in place");
    if (self.rig.pair() != nullptr)
      fields_of_pair(self, visit);
    else
      fields_of_one(self, visit);
  }

 private:
  static void fields_of_one(auto& self, auto& visit) {
    visit.required("loads", self.loads_kg, "kg", 0.0, 500.0, "masses of the loads");
    const auto target = [&](auto& movement) {
      visit("target", movement,
            "the movement that is wanted; of a lever angles; may be left out where nothing follows it: given "
            "commands, a sealed muscle");
    };
    if (self.rig.lever() != nullptr)
      target(self.angle);
    else
      target(self.target);
    fields_of_time(self, visit);
    const auto controllers_of_rig = [&](auto& controllers) {
      if (self.rig.valve.seals())
        visit("controllers", controllers, "none: the muscle is sealed");
      else
        visit.required("controllers", controllers,
                       "what is to follow the target; none if a muscle is sealed");
    };
    if (self.rig.lever() != nullptr)
      visit_controllers<controllers::LeverSettings>(self, controllers_of_rig);
    else
      visit_controllers<controllers::SingleSettings>(self, controllers_of_rig);
    if (self.rig.lever() == nullptr)
      visit("joint_force", self.outer_forces,
            "forces on the cord in addition to the load, one after the other; none before the first");
    visit_torques(self, visit);
    fields_of_chance(self, visit);
    if (self.rig.lever() != nullptr)
      visit_criteria_of_joint(self, visit);
    else
      visit("criteria", self.criteria, "what counts as good enough");
    visit("robustness", self.robustness, "how controllers do on rigs that are not quite as described");
  }

  template <class Self, class Visitor>
  static void fields_of_pair(Self& self, Visitor& visit) {
    fields_of_time(self, visit);
    visit_torques(self, visit);
    visit("currents", self.currents, "runs under given currents, two each");
    visit("targets", self.targets, "what controllers are to do with the joint");
    Hand hand{self.hand_m, self.loads_kg.empty() ? Hand{}.loads_kg : self.loads_kg};
    visit("hand", hand, "what the link holds while they do it");
    if constexpr (!std::is_const_v<Self>) {
      self.hand_m = hand.distance_m;
      self.loads_kg = hand.loads_kg;
    }
    visit_controllers<controllers::PairSettings>(
        self, [&](auto& controllers) { visit("controllers", controllers, "what is to follow the targets"); });
    fields_of_chance(self, visit);
    visit_criteria_of_joint(self, visit);
  }

  static void visit_torques(auto& self, auto& visit) {
    visit("joint_torque", self.outer_torques,
          "of a lever or a pair: torques on the joint, one after the other; none before the first");
  }

  static void visit_criteria_of_joint(auto& self, auto& visit) {
    visit_as<JointCriterion>(
        self.criteria, [](const Criterion& one) { return JointCriterion{one}; },
        [](const JointCriterion& one) -> Criterion { return one; },
        [&](auto& criteria) { visit("criteria", criteria, "what counts as good enough"); });
  }

  static void fields_of_time(auto& self, auto& visit) {
    visit.required("duration", self.duration_s, "s", 1e-4, 3600.0, "length of each run");
    visit(
        "skip", self.skip_s, "s", 0.0, 3600.0,
        "so much of each run is simulated, but counts neither in errors nor in tuning: the way from rest to "
        "where the target begins; until the target first moves if absent");
  }

  static void fields_of_chance(auto& self, auto& visit) {
    visit("noise", self.noise, "what disturbs the instruments");
    visit("seed", self.seed, 0, std::numeric_limits<std::uint64_t>::max(), "where chance begins");
  }

  template <class OfRig, class Self, class Visit>
  static void visit_controllers(Self& self, const Visit& visit) {
    visit_as<OfRig>(
        self.controllers, [](const auto& one) { return controllers::settings_as<OfRig>(one); },
        [](const OfRig& one) { return controllers::settings_as<controllers::Settings>(one); }, visit);
  }
};

/// A scenario of two muscles with every default.
inline Scenario pair_scenario() {
  Scenario scenario;
  scenario.rig = plant::thesis_pair();
  scenario.loads_kg = Hand{}.loads_kg;
  return scenario;
}

/// A scenario of a lever with every default.
inline Scenario lever_scenario() {
  Scenario scenario;
  scenario.rig.mechanics = plant::Lever{};
  return scenario;
}

/// What controllers know of a valve.
inline controllers::ValveLine valve_line(const plant::Valve& valve) {
  return {valve.zero_command,     valve.span_command,          valve.zero_pressure_Pa,
          valve.span_pressure_Pa, name_of(valve.command_unit), valve.closed_command()};
}

/// Whether it plays a command, whatever the target.
inline bool is_given(const controllers::Settings& settings) {
  return std::visit([]<class One>(const One&) { return controllers::is_one_of<One, CampaignWaveform>; },
                    settings);
}

/// What names the files of a run: its target, if targets have names, its load and its controller.
inline std::string name_of_run(const Scenario& scenario, std::size_t target, double load_kg,
                               const std::string& controller) {
  const std::string of_target = scenario.targets.empty() ? "" : scenario.targets[target].name + '_';
  return of_target + kg_in_name(load_kg, scenario.loads_kg) + "kg_" + controller;
}

}  // namespace mckibben::domain
