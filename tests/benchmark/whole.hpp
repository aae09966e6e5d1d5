// A diagnosis that a suite may count: one that was through.
#pragma once

#include <sim/diagnose/diagnose.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::diagnose {

/// Throws run::Interrupted if the user has ended its search: that is no answer to be scored.
inline Diagnosis whole_diagnosis(const domain::Dataset& data, const Settings& settings) {
  Diagnosis found = diagnose(data, settings, [](auto, auto, auto) {});
  if (found.ended == Ended::by_user) throw run::Interrupted();
  return found;
}

}  // namespace mckibben::diagnose
