// The gains that a controller of a scenario leaves open, tuned on all of the scenario's own targets at one
// load.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/run/briefing.hpp>
#include <sim/run/metrics.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/tune_pid.hpp>

namespace mckibben::run {

/// Gains found for a PID that left some open.
struct TunedController {
  std::string controller;
  double load_kg = 0.0;
  Tuned tuned{};                                      ///< gains for a whole contraction ratio of muscle 1
  double took_s = 0.0;                                ///< by the machine's clock
  std::string failure{};                              ///< why no gains were found; empty if they were
  std::optional<double> idle_cost{};                  ///< without feedback: proportional gain 0
  Metrics metrics{};                                  ///< with the tuned gains, along the first target
  std::optional<controllers::CurrentRange> limits{};  ///< of its current, as the DAC gives them
};

/// The load at which gains are tuned if nothing else is said.
double lower_median(std::vector<double> values);

/// Gives a PID of this rig these gains.
void set_gains(controllers::Settings& settings, const Gains& gains, const plant::Rig& rig);

/// Tunes each of `open` and fills the gains in, on `threads` threads (0: all the machine has); what comes of
/// one depends neither on them nor on the others. `tried` hears of each trial, from any thread. Throws
/// Interrupted.
std::vector<TunedController> tune_controllers(const domain::Scenario& scenario, const Briefing& briefing,
                                              std::span<controllers::Settings* const> open, unsigned threads,
                                              const std::function<void()>& tried);

/// Gains must also do with the proportional gain this much higher, so that they are not tuned to the edge of
/// stability: the loop's own gain changes with load and contraction.
inline constexpr double gain_margin = 2.0;

/// [contraction ratio], for the rows of a run that count, whose error is `rmse`; `span_mA`: of the
/// controller's currents. Of a pair the current to muscle 1 tells of both.
double tuning_cost(double rmse, std::span<const Sample> rows, double span_mA);

}  // namespace mckibben::run
