// A scenario: which rig lifts which loads along which target,
// under which controllers, and what counts as good enough.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <controllers/settings.hpp>
#include <controllers/target.hpp>
#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/domain/rig_file.hpp>

namespace mckibben::domain {

/// Limits on the tracking error; a run that exceeds one ends with exit status 1.
struct Criterion {
  std::string controller;
  std::optional<double> rmse_below;
  std::optional<double> largest_error_below;
  std::optional<double> spread_below;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("controller", self.controller, "name of the controller it is for; all if left out");
    visit("rmse_below", self.rmse_below, "1", 0.0, 1.0, "root mean square error, as contraction ratio");
    visit("largest_error_below", self.largest_error_below, "1", 0.0, 1.0,
          "largest error, as contraction ratio");
    visit("spread_below", self.spread_below, "1", 0.0, 1.0,
          "difference of the rmse between the worst and the best load, as contraction ratio");
  }
  template <class Report>
  void rules(Report& report) const {
    if (!rmse_below && !largest_error_below && !spread_below)
      report("rmse_below", "give this, largest_error_below or spread_below");
  }
};

/// Rigs drawn within what the rig's file says of its numbers; none: the described one alone is simulated.
struct Robustness {
  int rigs = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("rigs", self.rigs, 0, 100000,
          "how many rigs are drawn within the ± of the rig's file, each with its own noise");
  }
};

struct Scenario {
  std::string name;
  RigFile rig;
  std::vector<double> loads_kg;
  controllers::Target target;
  double duration_s = 0.0;
  std::vector<controllers::Settings> controllers;
  plant::Noise noise;
  std::uint64_t seed = 1;
  std::vector<Criterion> criteria;
  Robustness robustness;

  std::map<std::string, RigFile> believed;  ///< rigs of controllers that name one, by controller
  std::vector<InputFile> inputs;            ///< the files it was read from

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "name of the results' folder; the file's name if left out");
    visit("rig", self.rig, "a shipped name, the path of a rig file, or changes in place");
    visit.required("loads", self.loads_kg, "kg", 0.01, 500.0, "masses of the loads");
    visit.required("target", self.target, "the movement that is wanted");
    visit.required("duration", self.duration_s, "s", 1e-4, 3600.0, "length of each run");
    visit.required("controllers", self.controllers, "what is to follow the target");
    visit("noise", self.noise, "what disturbs the instruments");
    visit("seed", self.seed, 0, std::numeric_limits<std::uint64_t>::max(), "where chance begins");
    visit("criteria", self.criteria, "what counts as good enough");
    visit("robustness", self.robustness, "how controllers do on rigs that are not quite as described");
  }
};

}  // namespace mckibben::domain
