// Whether columns of measured data are in the unit they say, and what is compared for that.
#pragma once

#include <span>
#include <vector>

#include <sim/diagnose/predict.hpp>
#include <sim/input/dataset.hpp>

namespace mckibben::diagnose {

using Series = std::vector<double>;

inline constexpr double bar_Pa = 1e5;

/// Largest less smallest.
double range(std::span<const double> values);

/// Straight line through `values` over `model`; its slope is 0 where the model stands still.
struct Line {
  double slope = 0.0, mean_difference = 0.0;
  Line(const Series& values, const Series& model);
};

/// Throws input::BadInput, with all that it finds, where a column is in another unit than it says. `model`:
/// what the rig would read in each run.
void check_units(const input::Dataset& data, const std::vector<Readings>& model);

}  // namespace mckibben::diagnose
