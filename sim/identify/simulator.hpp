// What rigs and benches with other numbers would have read, row by row. One pass: one of them through all
// runs.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <sim/identify/dictionary.hpp>
#include <sim/identify/rows.hpp>

namespace mckibben::identify {

/// What wander of a run's input does to its readings, what it remembers of before, and what other loads
/// would.
struct Wander {
  Eigen::MatrixXd columns{};  ///< [row, knot]: of one unit of input, of the run's own knots; then
                              ///< of a run that began on its way, of each number of its start
  std::vector<std::vector<double>> knots{};  ///< [run] when they are [s]; the first is the start's
  std::size_t starts = 0;                    ///< numbers of a start, in deviations of what is known of them
  Eigen::VectorXd read{}, label{};  ///< of the setting; how that changes by a kg of the load, or a m of a
                                    ///< given length, both 0 but for the judged
  Eigen::VectorXd together{};       ///< by all knots of a run at once
};

/// What was simulated, in the order in which a search asked for it: it asks for the same again.
using Simulated = std::vector<Eigen::MatrixXd>;

/// What a recorder whose clock runs fast, and is ahead by so many rows, shows: it reads at t (1 + rate) +
/// later.
Eigen::VectorXd clocked(const Eigen::VectorXd& read, double rate, double later_rows = 0.0);

class Simulator {
 public:
  Simulator(const Rows& rows, unsigned threads) : rows_(rows), threads_(threads) {}

  /// As a setting reads, integrated finely: so that others can be compared with it; not a number where it
  /// cannot go on.
  Eigen::VectorXd read(const Setting& setting) const;
  /// The first as it reads, the others less the first, in common steps with it.
  Eigen::MatrixXd differences(std::span<const Setting> settings, std::optional<double> tolerance = {}) const;
  /// The change by friction of 1 N in each of so many places along the stroke (general terms).
  Eigen::MatrixXd rubs(const Setting& setting, double reach_m, std::size_t places) const;

  Wander wander(const Setting& setting) const;

  /// That were simulated, and not known.
  long passes() const { return passes_; }

  /// Keeps from now on what is simulated; what is known of an earlier search is not simulated again.
  void keep(Simulated known) const {
    kept_ = std::move(known);
    keeps_ = true;
  }
  /// What was kept; no more is.
  Simulated kept() const {
    keeps_ = false;
    return std::move(kept_);
  }

 private:
  template <class Make>
  Eigen::MatrixXd once(std::size_t passes, const Make& make) const;

  const Rows& rows_;
  unsigned threads_;
  mutable std::atomic<long> passes_{0};
  mutable Simulated kept_{};
  mutable std::size_t asked_ = 0;  ///< of these
  mutable bool keeps_ = false;
};

}  // namespace mckibben::identify
