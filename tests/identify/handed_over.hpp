// A diagnosis as it is handed over, and whether an interval holds.
#pragma once

#include <gtest/gtest.h>

#include <sim/identify/diagnosis.hpp>

#include "diagnose/planted.hpp"

namespace mckibben::identify {

using diagnose::Diagnosis, diagnose::FittedNumber;

inline Diagnosis handed_over(const domain::Dataset& data, const Settings& settings = {.threads = 2}) {
  return diagnosis_of(identify(data, settings), settings);
}

inline testing::AssertionResult surrounds(const FittedNumber& number, double truth) {
  if (number.low < truth && truth < number.high) return testing::AssertionSuccess();
  return testing::AssertionFailure() << truth << " is not in " << number.low << " to " << number.high;
}

inline plant::Rig with_a_leak() {
  plant::Rig rig;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
  return rig;
}

}  // namespace mckibben::identify
