// The whole workflow: replay, recalibrate, map, name, add, show the gap, judge.
#pragma once

#include <cstdint>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::diagnose {

struct Settings {
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::uint64_t seed = 1;
};

/// Throws run::Interrupted; input::BadInput where the data cannot be used at all.
Diagnosis diagnose(const input::Dataset& data, const Settings& settings, const run::ProgressHook& progress);

}  // namespace mckibben::diagnose
