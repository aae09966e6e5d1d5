// The cost of gains, and the searches with it; see the header.
#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

#include <sim/run/rounds.hpp>
#include <sim/run/track.hpp>
#include <sim/run/tune_controller.hpp>
#include <sim/run/tuning_cost.hpp>

namespace mckibben::run {

double lower_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

namespace {

class Tuning {
 public:
  Tuning(const domain::Scenario& scenario, const controllers::Knowledge& knowledge,
         const controllers::Settings& settings, double load_kg, Rounds& rounds)
      : scenario_(scenario),
        knowledge_(knowledge),
        settings_(settings),
        plan_(plan_of(scenario, load_kg, 0)),
        span_mA_(controllers::working_range(knowledge).width_mA()),
        limits_(limits_of(settings, knowledge, scenario.rig)),
        rounds_(rounds) {
    plan_.keep_ledger = false;  // nothing here asks where the air went
  }

  controllers::Settings with(const Gains& gains) const {
    controllers::Settings complete = settings_;
    set_gains(complete, gains);
    return complete;
  }

  double span_mA() const { return span_mA_; }
  const std::optional<controllers::CurrentRange>& limits() const { return limits_; }

  /// What came of each of these gains; those that could not be simulated say so.
  std::vector<Recording> tried(std::initializer_list<Gains> all) const {
    std::vector<Order> orders;
    for (const Gains& gains : all) orders.push_back({plan_, controllers::make(with(gains), knowledge_)});
    return rounds_.simulated(std::move(orders));
  }

  Metrics metrics(const Recording& recording) const {
    if (!recording.failure.empty()) throw std::runtime_error(recording.failure);
    return metrics_of(scenario_, knowledge_.target, recording, limits_);
  }

  double cost(const Recording& recording) const {
    return tuning_cost(metrics(recording).rmse, recording, span_mA_);
  }

  double cost_with_margin(const Gains& gains) const {
    Gains higher = gains;
    higher.proportional_mA *= gain_margin;
    const auto both = tried({gains, higher});
    return 0.5 * (cost(both.front()) + cost(both.back()));
  }

 private:
  const domain::Scenario& scenario_;
  const controllers::Knowledge& knowledge_;
  const controllers::Settings& settings_;
  RunPlan plan_;
  double span_mA_;
  std::optional<controllers::CurrentRange> limits_;
  Rounds& rounds_;
};

}  // namespace

void set_gains(controllers::Settings& settings, const Gains& gains) {
  controllers::PidTerms& terms = *controllers::pid_terms(settings);
  terms.proportional_mA = gains.proportional_mA;
  terms.integral_time_s = gains.integral_time_s;
  terms.derivative_time_s = gains.derivative_time_s;
}

namespace {

/// The loop as it is without what is fed forward: it is to be good by itself, and gains no less by a model.
controllers::Settings loop_alone(const controllers::Settings& settings) {
  if (!std::holds_alternative<controllers::FeedforwardPidSettings>(settings)) return settings;
  controllers::PidSettings loop;
  static_cast<controllers::PidTerms&>(loop) = std::get<controllers::FeedforwardPidSettings>(settings);
  return loop;
}

TunedController tune_one(const domain::Scenario& scenario, const controllers::Knowledge& knowledge,
                         controllers::Settings& settings, Rounds& rounds,
                         const std::function<void()>& heard) {
  const controllers::PidTerms& pid = *controllers::pid_terms(settings);
  TunedController result{.controller = controllers::name_of(settings),
                         .load_kg = pid.tuning_load_kg.value_or(lower_median(scenario.loads_kg))};
  const controllers::Settings loop = loop_alone(settings);
  const Tuning tuning(scenario, knowledge, loop, result.load_kg, rounds);
  const auto cost = [&](const Gains& gains) {
    heard();
    return tuning.cost_with_margin(gains);
  };
  const auto begin = std::chrono::steady_clock::now();
  try {
    result.tuned = tune(cost, {pid.proportional_mA, pid.integral_time_s, pid.derivative_time_s},
                        TuningOptions::for_span(tuning.span_mA()));
    Gains idle = result.tuned.gains;
    idle.proportional_mA = 0.0;
    const auto ended = tuning.tried({result.tuned.gains, idle});
    if (ended.back().failure.empty()) result.idle_cost = tuning.cost(ended.back());
    result.metrics = tuning.metrics(ended.front());
    result.limits = tuning.limits();
    set_gains(settings, result.tuned.gains);
  } catch (const std::runtime_error& failure) {
    result.failure = failure.what();
  }
  result.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace

std::vector<TunedController> tune_controllers(const domain::Scenario& scenario,
                                              const controllers::Knowledge& knowledge,
                                              std::span<controllers::Settings* const> open, unsigned threads,
                                              const std::function<void()>& tried) {
  std::vector<TunedController> tuned(open.size());
  search_in_rounds(open.size(), threads, [&](std::size_t i, Rounds& rounds) {
    tuned[i] = tune_one(scenario, knowledge, *open[i], rounds, tried);
  });
  return tuned;
}

}  // namespace mckibben::run
