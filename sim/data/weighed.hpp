// What runs seem to carry, weighed by the muscle.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <sim/data/examine.hpp>

namespace mckibben::data {

struct Weighed {
  std::size_t run;
  double label_kg, seems_kg;
};

/// Runs with a load, or those without.
std::vector<Weighed> weigh(const domain::Dataset& data, const std::vector<Expected>& expected, bool loaded);

/// What they seem to carry over what is written, in the middle; of one at least.
double common_ratio(const std::vector<Weighed>& list);
/// How far off what runs have in common, as a logarithm; infinite where one is no load.
double far_off(const Weighed& one, double scale);
/// Whether the loads of all other runs are off as well, by half as much or more: a zero elsewhere does that,
/// or another muscle. False where there are no others.
bool all_are_off(const std::vector<Weighed>& list, const Weighed& one);

/// A load that is a tenth or a thousandth of what hung, or ten or a thousand times that; others are right, as
/// what all runs are off by alike is no misplaced point.
struct MisplacedPoint {
  Weighed run;
  double factor;  ///< by which its label is to be multiplied
};
std::vector<MisplacedPoint> misplaced_points_in(const std::vector<Weighed>& list);

}  // namespace mckibben::data
