// A diagnosis that a suite may count: one that was through.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <sim/identify/diagnosis.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::diagnose {

struct Asked {
  unsigned threads = 0;
  std::uint64_t seed = 1;
  std::function<void(const std::string&)> say{};  ///< hears of each step of the search
};

/// Throws run::Interrupted if the user has ended its search: that is no answer to be scored.
inline Diagnosis whole_diagnosis(const domain::Dataset& data, const Asked& asked) {
  const identify::Settings settings{.threads = asked.threads, .say = asked.say};
  Diagnosis found =
      identify::diagnosis_of(identify::identify(data, settings), settings, {.seed = asked.seed});
  if (found.ended == Ended::by_user) throw run::Interrupted();
  return found;
}

}  // namespace mckibben::diagnose
