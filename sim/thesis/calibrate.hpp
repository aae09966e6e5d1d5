// From a measured data set to the models that the thesis's controller needs (T 4.1, 4.2): friction
// coefficient and pressure, for contraction and relaxation.
#pragma once

#include <array>

#include <controllers/calibration.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/thesis/cells.hpp>
#include <sim/thesis/friction.hpp>
#include <sim/thesis/pressure.hpp>

namespace mckibben::thesis {

/// Which pressure coefficients go into the calibration: those of all samples at once, or those of the
/// thesis's sequence of fits.
enum class PressureFitting { joint, sequence };

struct Options {
  ProcessingOptions processing;
  Orders orders;
  PressureFitting fitting = PressureFitting::joint;
};

struct CalibrationResult {
  Grid grid;
  std::array<FrictionFit, 2> friction;  ///< by Direction
  std::array<PressureFit, 2> pressure;  ///< by Direction
  controllers::Calibration calibration;

  plant::CommandUnit command_unit() const {
    return plant::command_unit_of(calibration.command_unit.value_or("mA"));
  }
  const FrictionFit& friction_of(Direction direction) const {
    return friction[static_cast<std::size_t>(direction)];
  }
  const PressureFit& pressure_of(Direction direction) const {
    return pressure[static_cast<std::size_t>(direction)];
  }
};

/// Throws data::UnfitData if the rig's valve is none of those that the models are of.
void require_pressure_valve(const domain::Dataset& dataset);

/// Throws data::UnfitData if loads and runs are too few for the orders, whatever the runs hold.
void require_enough_runs(const domain::Dataset& dataset, const Orders& orders);

/// Throws data::UnfitData if the data set cannot bear the fits; the message says what would help.
CalibrationResult calibrate(const domain::Dataset& dataset, const Options& options);

}  // namespace mckibben::thesis
