// What whole diagnoses are asked: whether they name one effect, and whether the truth is in its interval.
#pragma once

#include <string_view>

#include <gtest/gtest.h>

#include <sim/identify/diagnosis.hpp>

namespace mckibben::diagnose {

inline Diagnosis diagnosis_of(const domain::Dataset& data, unsigned threads) {
  const identify::Settings settings{.threads = threads};
  return identify::diagnosis_of(identify::identify(data, settings), settings, {.seed = 3});
}

inline testing::AssertionResult names_only(const Diagnosis& found, std::string_view effect) {
  if (found.verdict == Verdict::missing_effect && found.effects.size() == 1u &&
      found.effects[0].name == effect)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << found.effects.size() << " effects: " << found.because;
}

inline testing::AssertionResult surrounds(const FittedNumber& number, double truth) {
  if (number.low < truth && truth < number.high) return testing::AssertionSuccess();
  return testing::AssertionFailure() << truth << " is not in " << number.low << " to " << number.high;
}

}  // namespace mckibben::diagnose
