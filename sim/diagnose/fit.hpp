// Least squares with priors and bounds (Ceres Solver): the most probable values of a rig's parameters, given
// measured runs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// A rig and what is free in it.
struct Model {
  Rig rig;  ///< with the values as they stand
  std::vector<Parameter> free{};
  std::vector<Candidate> effects{};    ///< that have been added, in this order
  std::vector<std::string> refused{};  ///< not free, although asked for: no reading depends on them
};

/// Slopes of parameters, by path.
using KnownSlopes = std::vector<std::pair<std::string, Eigen::VectorXd>>;

struct FitSettings {
  double inflation =
      1.0;  ///< how much more the residuals scatter, over long times, than white noise at the floor
  bool thorough = false;  ///< to the bottom of the valley, along its axes, for numbers that are told
  const KnownSlopes* known = nullptr;  ///< for a rough fit: slopes taken over from an earlier one
};

/// The free parameters as they stand in the rig, scaled.
Eigen::VectorXd scaled_values(const Model& model);

/// The rig with its free parameters at these scaled values, or at the bounds that they are beyond.
Rig rig_at(const Model& model, const double* scaled);

struct Fitted {
  Model model;
  Eigen::VectorXd residuals;  ///< of the fitted runs
  Eigen::MatrixXd columns;    ///< slopes at the end, a column for each free parameter
  double cost = 0.0;          ///< residuals and priors: sum of squares / inflation + deviations^2
  std::string failure{};      ///< why there is no fit; empty if there is
};

/// The least cost that could be reached from a fit if its slopes held all the way and there were no bounds.
double least_by_lines(const Fitted& fitted, double inflation);

/// Whether that misses a cost that is aimed at by far.
bool out_of_reach(double aim, const Fitted& fitted, double inflation);

/// The slopes of the nominal parameters, without effects: those may move far.
KnownSlopes slopes_of_nominal(const Fitted& fitted);

/// A parameter that no reading depends on is refused: it keeps its value and is free no more.
///
/// Slopes of nominal parameters, which hardly move, are computed once a round of descent, the others at each
/// step; the last round's are computed anew. Throws run::Interrupted.
Fitted fit(const Experiment& experiment, Model start, const Runs& runs, const FitSettings& settings);

}  // namespace mckibben::diagnose
