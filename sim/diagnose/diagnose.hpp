// The whole workflow, in running order (workflow, evidence):
//
//   check      which data can be trusted                check, labels; sim/data
//              faults of recordings, found and mended   first_look, faults, suspicions, shapes, repair
//   baseline   the rig as described, then recalibrated  baseline, starts
//   where      the map of what remains                  where
//   name       effects that runs held out ask for       name, trial, revise, ranking, further
//   law        a law of force for what they leave       law
//   decide     the verdict                              decide
//   plan       the measurement that would tell more     plan
//
// and then tells what was found (handing_over, estimates, left_open, start, run_gaps, remarks, story). All of
// it stands on a few tools: numbers and effects of a rig (parameter, priors, candidate, catalogue), runs
// against it (experiment, predict, noise), fits (fit, interval), slopes (screen, regression), runs held out
// (held_out). Every number that decides is in thresholds/.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::diagnose {

struct Settings {
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  double time_limit_s =
      std::numeric_limits<double>::infinity();        ///< for the search; the numbers come after it
  std::vector<std::string> warnings{};                ///< of the recordings, known before; told first
  std::function<void(const std::string&)> learned{};  ///< hears what is known so far, a sentence at a time
};

/// Progress counts steps and has no total: how much there is to try depends on what is found. A time limit,
/// or the user, ends the search with what is known. Throws run::Interrupted if the user asks to stop before
/// or after the search; data::UnfitData where the data cannot be used at all.
Diagnosis diagnose(const domain::Dataset& data, const Settings& settings, const run::ProgressHook& progress);

}  // namespace mckibben::diagnose
