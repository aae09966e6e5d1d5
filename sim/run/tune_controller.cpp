// The cost of gains, and the search with it; see the header.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <sim/run/batch.hpp>
#include <sim/run/track.hpp>
#include <sim/run/tune_controller.hpp>

namespace mckibben::run {
namespace {

// What a change of current costs in tuning [contraction ratio for each mA rms and tick, at the thesis's
// span]: enough to keep gains from chasing single encoder counts,
// too little to matter for how the target is followed.
constexpr double effort_weight = 2e-4;

// Gains must also do with the proportional gain this much higher, so that they are not tuned to the edge of
// stability: the loop's own gain changes with load and contraction.
constexpr double gain_margin = 2.0;

double lower_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

double effort_mA(const Recording& recording) {
  double sum_squared_mA = 0.0;
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const double change_mA = recording.samples[k].current_mA - recording.samples[k - 1].current_mA;
    sum_squared_mA += change_mA * change_mA;
  }
  return std::sqrt(sum_squared_mA / static_cast<double>(recording.samples.size()));
}

class Tuning {
 public:
  Tuning(const domain::Scenario& scenario, const controllers::Knowledge& knowledge,
         const controllers::Settings& settings, double load_kg)
      : scenario_(scenario),
        knowledge_(knowledge),
        settings_(settings),
        plan_(plan_of(scenario, load_kg, 0)),
        span_mA_(controllers::working_range(knowledge).width_mA()),
        limits_(limits_of(settings, knowledge, scenario.rig)) {
    plan_.keep_ledger = false;  // nothing here asks where the air went
  }

  controllers::Settings with(const Gains& gains) const {
    controllers::Settings complete = settings_;
    set_gains(complete, gains);
    return complete;
  }

  double span_mA() const { return span_mA_; }
  const std::optional<controllers::CurrentRange>& limits() const { return limits_; }

  Metrics metrics(const Gains& gains) const { return tried(gains).first; }

  double cost(const Gains& gains) const {
    const auto [metrics, effort] = tried(gains);
    return metrics.rmse + effort_weight * (thesis_span_mA / span_mA_) * effort;
  }

  double cost_with_margin(const Gains& gains) const {
    Gains higher = gains;
    higher.proportional_mA *= gain_margin;
    return 0.5 * (cost(gains) + cost(higher));
  }

 private:
  std::pair<Metrics, double> tried(const Gains& gains) const {
    const auto controller = controllers::make(with(gains), knowledge_);
    const Recording recording = simulate(plan_, *controller);
    if (!recording.failure.empty()) throw std::runtime_error(recording.failure);
    return {metrics_of(scenario_, knowledge_.target, recording, limits_), effort_mA(recording)};
  }

  const domain::Scenario& scenario_;
  const controllers::Knowledge& knowledge_;
  const controllers::Settings& settings_;
  RunPlan plan_;
  double span_mA_;
  std::optional<controllers::CurrentRange> limits_;
};

std::optional<double> idle_cost(const Tuning& tuning, Gains gains) {
  gains.proportional_mA = 0.0;
  try {
    return tuning.cost(gains);
  } catch (const std::runtime_error&) {
    return std::nullopt;  // only feedback keeps it going
  }
}

}  // namespace

void set_gains(controllers::Settings& settings, const Gains& gains) {
  controllers::PidTerms& terms = *controllers::pid_terms(settings);
  terms.proportional_mA = gains.proportional_mA;
  terms.integral_time_s = gains.integral_time_s;
  terms.derivative_time_s = gains.derivative_time_s;
}

TunedController tune_controller(const domain::Scenario& scenario, const controllers::Knowledge& knowledge,
                                controllers::Settings& settings, const std::function<void()>& tried) {
  const controllers::PidTerms& pid = *controllers::pid_terms(settings);
  TunedController result{.controller = controllers::name_of(settings),
                         .load_kg = pid.tuning_load_kg.value_or(lower_median(scenario.loads_kg))};
  const Tuning tuning(scenario, knowledge, settings, result.load_kg);
  const auto cost = [&](const Gains& gains) {
    if (interrupted()) throw Interrupted();
    tried();
    return tuning.cost_with_margin(gains);
  };
  try {
    result.tuned = tune(cost, {pid.proportional_mA, pid.integral_time_s, pid.derivative_time_s},
                        TuningOptions::for_span(tuning.span_mA()));
    result.idle_cost = idle_cost(tuning, result.tuned.gains);
    result.metrics = tuning.metrics(result.tuned.gains);
    result.limits = tuning.limits();
    settings = tuning.with(result.tuned.gains);
  } catch (const std::runtime_error& failure) {
    result.failure = failure.what();
  }
  return result;
}

}  // namespace mckibben::run
