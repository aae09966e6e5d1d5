// The grid of a campaign: all samples of one load and one current speed are a cell. Speeds that differ by
// less than two per cent are one speed, loads that differ by less than one in a thousand one load.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <sim/domain/dataset.hpp>
#include <sim/thesis/processing.hpp>

namespace mckibben::thesis {

struct Cell {
  double load_kg = 0.0, speed_mA_per_s = 0.0;
  Samples samples;
};

/// A run that was not used, and why.
struct LeftOut {
  std::string id, why;
  bool still = false;  ///< because nothing moves enough
  double largest_current_mA = 0.0;
};

struct Grid {
  std::vector<double> loads_kg, speeds_mA_per_s;  ///< ascending
  std::array<std::vector<Cell>, 2> cells;         ///< by Direction; by load, then by speed; none is empty
  std::size_t merged_loads = 0;                   ///< that were too near to another to count
  std::vector<LeftOut> left_out;
  Dropped dropped;  ///< of the runs that were used

  /// How many runs were left out because nothing moves,
  /// with the first one and what would help; empty if none.
  std::string still_runs(const plant::Valve& valve) const;

  const std::vector<Cell>& of(Direction direction) const {
    return cells[static_cast<std::size_t>(direction)];
  }
};

/// Processes every run and sorts it in. `wrong`: what is wrong with the data set already. Throws
/// data::UnfitData with that and with what is wrong with each run.
Grid make_grid(const domain::Dataset& dataset, const ProcessingOptions& options,
               std::vector<data::Finding> wrong = {});

/// A column of samples as Eigen sees it.
inline Eigen::Map<const Eigen::VectorXd> vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace mckibben::thesis
