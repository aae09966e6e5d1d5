// The runs flown on the rig as described, and the straight lines that may explain what is left of them: the
// rig's parameters, effects of the catalogue, faults of recordings.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/in_brief.hpp>
#include <sim/diagnose/regression.hpp>
#include <sim/diagnose/shapes.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

/// Mean square, in floors, of runs that are taken for sound.
inline constexpr double sound = thresholds.near.mean_square();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

struct Hypothesis {
  std::vector<Fault> faults{};
  double cost = infinite;
};

class Examination {
 public:
  Examination(const Experiment& experiment, const Model& at, const Runs& runs,
              const std::vector<Candidate>& effects)
      : experiment_(experiment), at_(at), runs_(runs), effects_(effects) {
    fly();
  }

  Examined operator()();

 private:
  using Kept = std::vector<bool>;

  /// Of a few of `whole`'s runs.
  Examination(const Examination& whole, const Runs& few);
  struct Brief {};
  /// What regressions need of `whole`: its rows in brief, without what shapes of faults are drawn from.
  Examination(const Examination& whole, Brief);

  Eigen::Index begin(std::size_t i) const { return begins_[i]; }
  Eigen::Index rows(std::size_t i) const { return begins_[i + 1] - begins_[i]; }

  /// A candidate's straight line, drawn at half its typical size.
  struct Drawn {
    const Candidate* candidate;
    double shape;
    Eigen::VectorXd column;
    bool possible(double amplitude) const {
      return candidate->either_sign || amplitude * candidate->typical >= 0.0;
    }
  };

  /// What an effect leaves of the runs that it fits best, or of all if they are so late; its size there.
  struct Suspected {
    const Drawn* effect;
    Kept kept;
    double cost, amplitude;
    int late = 0;
    double cost_of_a_run() const {
      return cost / static_cast<double>(std::count(kept.begin(), kept.end(), true));
    }
  };

  void fly();
  void draw_effects();
  double most_gained(const Regression& alone) const;
  std::vector<Eigen::MatrixXd> products(const Eigen::VectorXd& column) const;
  Suspected trimmed(const Drawn& effect) const;
  std::vector<Suspected> beside_lateness(const Regression& alone) const;
  std::vector<Suspected> most_promising(std::vector<Suspected> list, double at_best) const;
  Suspicion told(const Suspected& one) const;
  std::vector<Suspicion> suspicions(const Regression& alone, double at_best) const;
  std::vector<Suspicion> suspicions_of_a_few() const;
  Hypothesis few(const Examination& brief, double near) const;
  Hypothesis common_lateness(const Regression& alone) const;
  Hypothesis own_line(FaultKind kind) const;
  std::optional<Fault> look_up(std::size_t i, Kept kept) const;

  /// With rows of 0 for the runs that are not kept.
  template <class Rows>
  Rows only(const Kept& kept, Rows values) const {
    for (std::size_t i = 0; i < runs_.size(); ++i)
      if (!kept[i]) values.middleRows(begin(i), rows(i)).setZero();
    return values;
  }
  /// The rig's parameters fitted to the runs that are kept.
  Regression regression(const Kept& kept) const {
    const Eigen::MatrixXd columns = only(kept, columns_);
    Regression result(only(kept, residuals_));
    for (Eigen::Index j = 0; j < columns.cols(); ++j) result.add(columns.col(j));
    return result;
  }
  /// Of a run's residuals, in floors.
  double mean_square(const Eigen::VectorXd& left, std::size_t i) const {
    return thresholds.scatter.first_inflation * left.segment(begin(i), rows(i)).squaredNorm() / readings_[i];
  }
  double worst(const Regression& fitted) const {
    double most = 0.0;
    for (std::size_t i = 0; i < runs_.size(); ++i) most = std::max(most, mean_square(fitted.left(), i));
    return most;
  }
  /// Contraction ratio as the regression counts it.
  Eigen::VectorXd weighted(const Eigen::VectorXd& ratio) const { return weight_ * ratio; }
  Eigen::VectorXd everywhere(std::size_t i, const Eigen::VectorXd& part) const {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(residuals_.size());
    column.segment(begin(i), rows(i)) = part;
    return column;
  }
  double count() const { return std::max(experiment_.floor().count, experiment_.floor().judged); }
  bool worth_telling(FaultKind kind, double size) const;

  const Experiment& experiment_;
  const Model& at_;
  const Runs& runs_;
  const std::vector<Candidate>& effects_;
  double weight_ = 1.0;               ///< of a contraction ratio
  std::vector<Eigen::Index> begins_;  ///< of each run's rows; one more for the end of the last
  std::vector<double> readings_;      ///< of each run
  Eigen::VectorXd residuals_;         ///< then a row for each prior
  Eigen::MatrixXd columns_;           ///< of the free parameters
  /// All runs late by so many ticks, for a size of 1 tick.
  struct Late {
    int ticks;
    Eigen::VectorXd column;
  };
  std::vector<Late> lates_;
  std::vector<Undisturbed> undisturbed_;
  std::vector<Drawn> drawn_;
};

}  // namespace mckibben::diagnose
