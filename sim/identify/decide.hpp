// From the table of models to a verdict: the simplest model that predicts unseen runs as well as the most
// probable one, with parameters that the sheet allows.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <sim/diagnose/diagnosis.hpp>

namespace mckibben::identify {

using diagnose::Verdict;

/// A model as the decision sees it.
struct Scored {
  std::vector<std::string> names{};   ///< that are at work
  std::vector<std::string> faults{};  ///< those of them that the bench has in single runs
  bool described = false;             ///< no parameter is free
  bool general = false;               ///< it has general terms
  double score = 0.0;                 ///< log evidence and log prior of the set [nats]
  Eigen::VectorXd held_out{};         ///< log density of each group of runs given the others
  double above_noise = 0.0;           ///< mean square of what is left of them, less that of noise
  double off_sheet = 0.0;             ///< of the parameter that is furthest off [deviations]
};

struct Decision {
  Verdict verdict{};
  std::size_t chosen = 0, best = 0;   ///< in the table; the most probable one
  bool contradicts_sheet = false;     ///< the one chosen has parameters that the sheet does not allow
  std::vector<std::size_t> rivals{};  ///< with more than a twentieth of the mass
  std::vector<double> mass{};         ///< of each model
};

Decision decide(const std::vector<Scored>& table);

/// Whether a model predicts unseen runs as well as the chosen one, and is no less probable, by more than runs
/// disagree about it (Vuong 1989), or by this strong evidence so many times. One that the sheet forbids is so
/// only by its share of the mass: numbers that are free of the sheet predict whatever is missing.
bool does_as_well(const std::vector<Scored>& table, const Decision& decision, std::size_t i, double strong);

/// Whether a model closes most of what another one leaves, by strong evidence: a wide model error makes their
/// predictions alike.
bool closes_the_gap_of(const Scored& model, const Scored& other);

/// By how much a model predicts worse than another one [nats], and the standard error of that.
struct Loss {
  double nats, error;
};
Loss loss(const Eigen::VectorXd& of_better, const Eigen::VectorXd& of_worse);

/// The quantile of chi^2 of so many degrees of freedom (Wilson & Hilferty 1931; within 1 % from 3 on).
double chi_square(double share, std::size_t degrees);

}  // namespace mckibben::identify
