// Finds the PID gains that a scenario leaves open: Nelder-Mead (Nelder & Mead 1965, from NLopt) on the
// logarithms of the gains, from a fixed start and without chance, so that the same cost gives the same gains.
// Where less gain than the start's costs less than what was found, a second search begins there.
#pragma once

#include <functional>
#include <optional>

namespace mckibben::run {

struct Gains {
  double proportional_mA = 0.0;
  double integral_time_s = 0.0;
  double derivative_time_s = 0.0;
};

/// Gains that are given already and not to be searched.
struct GivenGains {
  std::optional<double> proportional_mA = std::nullopt;
  std::optional<double> integral_time_s = std::nullopt;
  std::optional<double> derivative_time_s = std::nullopt;
};

/// The proportional gains are those for a valve with `plant::thesis_span_mA`.
struct TuningOptions {
  Gains start{60.0, 0.15, 0.05};
  Gains lowest{1.0, 0.01, 1e-3};
  Gains highest{2000.0, 20.0, 1.0};
  int evaluations = 150;    ///< of each search
  double tolerance = 0.01;  ///< stops when gains and cost change by less than this share

  /// The same for a valve with another span of current: a gain is a current.
  static TuningOptions for_span(double span_mA);
};

struct Tuned {
  Gains gains;
  double cost = 0.0;
  int evaluations = 0;
  std::optional<double> start_cost = std::nullopt;  ///< of the gains it began with, if they gave one
};

/// The gains with the least cost found. A cost that is not finite, or throws std::runtime_error, counts as
/// very bad. Throws std::runtime_error if no gains at all gave a finite cost.
Tuned tune(const std::function<double(const Gains&)>& cost, const GivenGains& given = {},
           const TuningOptions& options = {});

}  // namespace mckibben::run
