// Measured runs against a rig: how far they are apart, in units of what the instruments cannot see, and how
// that changes with each parameter.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <sim/diagnose/noise.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Runs by their index in the data set.
using Runs = std::vector<std::size_t>;

class Experiment {
 public:
  /// `masked[run][row]` rows do not count. `trusted` runs say what the noise floor is; none: all do,
  /// but none is compared with another. The data set outlives this.
  Experiment(const domain::Dataset& data, std::vector<std::vector<bool>> masked, unsigned threads,
             Runs trusted = {});

  const domain::Dataset& data() const { return data_; }
  const NoiseFloor& floor() const { return floor_; }
  std::size_t rows(std::size_t run) const;

  /// Measured minus predicted, each over its floor, for each row of a run: the reading that is judged, then
  /// those beside it. Masked rows are 0.
  Eigen::VectorXd residuals(const Readings& readings, std::size_t run) const;

  /// Readings of each of these runs. Throws engine::NumericalFailure, run::Interrupted.
  std::vector<Readings> readings(const Rig& rig, const Runs& runs) const;

  /// Root mean square of measured minus predicted, of the reading that is judged.
  double rmse(const Eigen::VectorXd& residuals, const Runs& runs) const;
  /// The part of a residual vector that is one run's judged reading: offset and length.
  struct Part {
    std::size_t run;
    Eigen::Index begin, rows;
  };
  std::vector<Part> parts(const Runs& runs) const;

  unsigned threads() const { return threads_; }

 private:
  /// Readings of a run by several rigs, the memories of each of a run that began on its way fitted to it.
  std::vector<Readings> begun(std::size_t run, std::vector<Loaded> rigs) const;
  double floor_of(const domain::Run& run, std::size_t reading) const;
  void compare(const Readings& readings, std::size_t run, double* residuals) const;
  /// Whether what the rig's effects remember when a run begins is to be found out.
  bool seeks_memories(const Rig& rig) const;
  const domain::Dataset& data_;
  std::vector<std::vector<bool>> masked_;
  unsigned threads_;
  NoiseFloor floor_;
};

}  // namespace mckibben::diagnose
