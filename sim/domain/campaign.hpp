// A campaign: which currents are to drive which loads on a rig,
// and how often, to get calibration data (T 3.3).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <controllers/waveform.hpp>
#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/domain/variation.hpp>

namespace mckibben::domain {

using CampaignWaveform =
    std::variant<controllers::SineCurrent, controllers::TriangleCurrent, controllers::StepCurrent,
                 controllers::StairCurrent, controllers::ChirpCurrent, controllers::RecordedCurrent>;

/// One current, and how long it is played; on a pair, two.
struct CampaignCurrent {
  std::string name;
  double duration_s = 0.0;
  std::optional<CampaignWaveform> current{};                 ///< of one muscle
  std::optional<CampaignWaveform> current_1{}, current_2{};  ///< of a pair

  static void fields(auto& self, auto& visit) {
    visit("name", self.name,
          "part of the names of its runs; if left out, that of the waveform, or c and its place in the list");
    visit.required("duration", self.duration_s, "s", 1e-4, 3600.0, "length of each run");
    visit("current", self.current, "the waveform; required where there is one muscle");
    visit("current_1", self.current_1, "of a pair: current to the valve of muscle 1; required there");
    visit("current_2", self.current_2, "of a pair: current to the valve of muscle 2; required there");
  }
};

struct Campaign {
  std::string name;
  plant::Rig rig;
  plant::Rig known{};  ///< as its owner believes it to be: without the effects that are written over its base
  std::vector<double> loads_kg;  ///< none of a pair
  std::vector<CampaignCurrent> currents;
  int repeats = 1;
  plant::Noise noise;
  std::uint64_t seed = 1;
  Variation vary;

  std::vector<InputFile> inputs;  ///< the files it was read from, its own first

  /// The verb and file that make it.
  std::string job() const { return "dataset " + (inputs.empty() ? name : inputs.front().name); }

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name of the results' folder; the file's name if left out");
    visit("rig", self.rig, "a shipped name, the path of a rig file, or changes in place");
    visit("loads", self.loads_kg, "kg", 0.0, 500.0, "masses of the loads; required where they hang");
    visit.required("currents", self.currents, "currents that drive each load, or a pair");
    visit("repeats", self.repeats, 1, 1000000,
          "how often each load, or the pair, is driven by each current; without vary at most 10000 times");
    visit("noise", self.noise, "what disturbs the instruments");
    visit("seed", self.seed, 0, std::numeric_limits<std::uint64_t>::max(), "where chance begins");
    visit("vary", self.vary,
          "numbers of the rig that each repeat draws anew, by their keys: muscle.rest_radius: normal 7.5 mm "
          "± 1 %, "
          "friction.scale: uniform 0.8 .. 1.2; and sampling: random or latin_hypercube (docs/datasets.md)");
  }
};

}  // namespace mckibben::domain
