// Two muscles on one wheel: what `run` simulates of a pair. Under given currents; or under controllers that
// turn the joint along targets, with loads in the hand.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <controllers/pair_settings.hpp>
#include <controllers/target.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/rig_file.hpp>

namespace mckibben::domain {

/// The currents of one run.
struct TwoCurrents {
  std::string name;
  CampaignWaveform current_1, current_2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
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

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "part of the names of its runs; if left out, t and its place in the list");
    visit.required("angle", self.angle, "the movement that is wanted");
    visit(
        "stiffness", self.stiffness,
        "stiffness of the joint that is wanted besides; if left out, controllers hold their co-contraction");
  }
};

/// Where the link holds a load, and which ones it holds, one after the other.
struct Hand {
  double distance_m = 0.4;
  std::vector<double> loads_kg{0.0};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("distance", self.distance_m, "m", 0.0, 5.0,
          "from the axis to the load, in line with the link's mass");
    visit("loads", self.loads_kg, "kg", 0.0, 500.0, "masses in the hand; 0 kg is the link alone");
  }
};

struct PairScenario {
  std::string name;
  RigFile rig = thesis_pair();
  double duration_s = 0.0;
  std::vector<TwoCurrents> currents;
  std::vector<JointTarget> targets;
  Hand hand;
  std::vector<controllers::PairSettings> controllers;

  std::map<std::string, RigFile> believed;  ///< rigs of controllers that name one, by controller
  std::vector<InputFile> inputs;            ///< the files it was read from

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "name of the results' folder; the file's name if left out");
    visit("rig", self.rig,
          "a shipped name, the path of a rig file, or changes in place; thesis_pair if left out");
    visit.required("duration", self.duration_s, "s", 1e-4, 3600.0, "length of each run");
    visit("currents", self.currents, "runs under given currents, two each");
    visit("targets", self.targets, "what controllers are to do with the joint");
    visit("hand", self.hand, "what the link holds while they do it");
    visit("controllers", self.controllers, "what is to follow the targets");
  }
};

/// Of a target with a load in the hand under a controller, by their places: what names its files.
inline std::string name_of_run(const PairScenario& scenario, std::size_t target, double load_kg,
                               std::size_t controller) {
  return scenario.targets[target].name + '_' + write_number(load_kg) + "kg_" +
         name_of(scenario.controllers[controller]);
}

}  // namespace mckibben::domain
