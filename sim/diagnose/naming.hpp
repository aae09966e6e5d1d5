// Which effects are missing: one is added after another, each chosen on runs that the fits have not seen.
#pragma once

#include <functional>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/judge.hpp>
#include <sim/diagnose/screen.hpp>

namespace mckibben::diagnose {

/// A fitted model and what it makes of the runs held out.
struct Contender {
  Fitted fitted{};
  Eigen::VectorXd held_out{};
};

struct Naming {
  Contender best{};
  std::vector<NamedEffect> effects{};  ///< names and what they may be confused with, in order of importance
  plant::Rig first{};                  ///< with the first effect alone
  std::vector<plant::Rig> rivals{};    ///< with each that it may be confused with instead
  std::vector<Ranked> ranking{};
  std::vector<std::string> confusion_names{};
  std::vector<std::vector<double>> confusion{};
};

/// What stays the same throughout a diagnosis.
struct Case {
  const Experiment& experiment;
  const plant::Rig& nominal;
  Split split;
  double temperature;
};

/// Fits a model to the training runs. `known` as in FitSettings.
Contender contend(const Case& c, Model model, const KnownSlopes* known = nullptr);

/// The model with one candidate more, at the size that serves best along the direction of its score.
Model with(const Case& c, const Model& model, const Score& score);

/// Starts from the nominal and from the recalibrated rig. `reference`: residuals held out that an improvement
/// is measured against. `step(text)` is told what is being done.
Naming name_effects(const Case& c, const Contender& nominal, const Contender& recalibrated,
                    const Eigen::VectorXd& reference, const std::function<void(const std::string&)>& step);

}  // namespace mckibben::diagnose
