// Two muscles on one wheel under given currents: what `run` simulates of a pair. No load hangs there, and no
// target is followed.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/domain/input_file.hpp>
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

struct PairScenario {
  std::string name;
  RigFile rig = thesis_pair();
  double duration_s = 0.0;
  std::vector<TwoCurrents> currents;

  std::vector<InputFile> inputs;  ///< the files it was read from

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "name of the results' folder; the file's name if left out");
    visit("rig", self.rig,
          "a shipped name, the path of a rig file, or changes in place; thesis_pair if left out");
    visit.required("duration", self.duration_s, "s", 1e-4, 3600.0, "length of each run");
    visit.required("currents", self.currents, "runs: two currents each");
  }
};

}  // namespace mckibben::domain
