// The whole workflow: replay, recalibrate, map, name, add, show the gap, judge.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::diagnose {

struct Settings {
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  std::function<void(const std::string&)> learned{};  ///< hears what is known so far, a sentence at a time
};

/// Progress counts steps and has no total: how much there is to try depends on what is found. Throws
/// run::Interrupted; domain::UnfitData where the data cannot be used at all.
Diagnosis diagnose(const domain::Dataset& data, const Settings& settings, const run::ProgressHook& progress);

}  // namespace mckibben::diagnose
