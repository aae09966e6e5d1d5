// What a diagnosis may have found, as ordinary data sets give it, to be moved to where it matters.
#pragma once

#include <cmath>
#include <limits>

#include <sim/diagnose/decide.hpp>

namespace mckibben::diagnose {

inline const DecideThresholds& at = thresholds.decide;
inline const NearThresholds& close = thresholds.near;
inline constexpr double most_explained =
    thresholds.start.explained_floors * thresholds.start.explained_floors;
inline const ImprovementThresholds& least = thresholds.improvement;

inline double below(double value) {
  return std::nextafter(value, -std::numeric_limits<double>::infinity());
}
inline double above(double value) {
  return std::nextafter(value, std::numeric_limits<double>::infinity());
}

/// As good as it gets: model and data agree, every effect would have shown.
inline Evidence agreeing() {
  Evidence e;
  e.runs = 2;
  e.nominal_left = e.recalibrated_left = below(close.nothing_left);
  e.catalogue = 20;
  return e;
}

/// Other numbers close the gap, just clearly enough.
inline Evidence other_numbers() {
  Evidence e = agreeing();
  e.nominal_left = 30.0;
  e.recalibrated_left = 0.1;
  e.recalibration = {.gained = least.gained, .share = least.share, .significance = least.significance};
  e.recalibration.better = 2;
  e.recalibration.runs = 3;
  return e;
}

/// A gap that other numbers make a little smaller.
inline Evidence gap() {
  Evidence e = other_numbers();
  e.nominal_left = 110.0;
  e.recalibrated_left = 100.0;
  return e;
}

/// Numbers that close nearly all of a gap, and leave what knows where the load is.
inline Evidence nearly_closed() {
  Evidence e = other_numbers();
  e.nominal_left = 2000.0;
  e.recalibrated_left = 16.0;
  e.patterned = true;
  return e;
}

/// An effect closes nearly all of it.
inline Evidence one_name() {
  Evidence e = gap();
  e.names = 1;
  e.named_left = 0.1;
  e.named_share = 0.99;
  return e;
}

/// Terms of a force do.
inline Evidence one_law() {
  Evidence e = gap();
  e.law_terms = 1;
  e.law_left = 0.2;
  e.law_share = 0.99;
  return e;
}

}  // namespace mckibben::diagnose
