// What a fault of one run's recording does to its readings, as straight lines drawn at a small size: a
// dictionary to look a misfit up in.
#pragma once

#include <functional>

#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/faults.hpp>

namespace mckibben::diagnose {

/// Readings change by `column` [contraction ratio] for a size of 1 in the fault's unit.
struct Shape {
  FaultKind kind;
  std::size_t row = 0;
  double drawn_at = 0.0;  ///< the size at which the line was drawn; 0: it is straight
  Eigen::VectorXd column{};
};

/// `model`: what the run's rig would read; `scale`, `offset`: how its readings change with the current that
/// it really had, for a share of 1 and for 1 of its unit.
struct Undisturbed {
  Eigen::VectorXd model, scale, offset;
  bool of_stamps = false;  ///< rows hold several readings: one may be late by part of a row
};

/// A command that is higher in the table than what the valve had, by a share and by some of its unit: the
/// same as another zero and span of the valve. Where a pressure drives the muscle, that one, by a share and
/// by bar: the same as an error of its gauge.
std::vector<Experiment::Change> inputs_in_error(const domain::Dataset& data);

/// Tells `visit` of each shape, the simple ones first.
void each_shape(const Undisturbed& run, const std::function<void(const Shape&)>& visit);

/// The model's readings so many ticks late, for a size of 1 tick.
Eigen::VectorXd lateness(const Eigen::VectorXd& model, int ticks);

/// A line from 0 at the first row to 1 at the last.
Eigen::VectorXd ramp(Eigen::Index rows);

}  // namespace mckibben::diagnose
