// The cost of gains, and the searches with it; see the header.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include <plant/plant.hpp>
#include <sim/run/rounds.hpp>
#include <sim/run/tune_controller.hpp>

namespace mckibben::run {

double lower_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

void set_gains(controllers::Settings& settings, const Gains& gains, const plant::Rig& rig) {
  controllers::PidForm& feedback = *controllers::part_of<controllers::PidForm>(settings);
  feedback.proportional_mA = gains.proportional_mA / per_ratio(rig);
  feedback.integral_time_s = gains.integral_time_s;
  feedback.derivative_time_s = gains.derivative_time_s;
}

namespace {

class Tuning {
 public:
  Tuning(const domain::Scenario& scenario, const Briefing& briefing, const controllers::Settings& settings,
         double load_kg, Rounds& rounds)
      : scenario_(scenario),
        briefing_(briefing),
        settings_(settings),
        plan_(plan_of(scenario, load_kg, 0)),
        span_mA_(controllers::working_range(briefing.knowledge.front()).width_mA()),
        rounds_(rounds) {
    plan_.keep_ledger = false;  // nothing here asks where the air went
  }

  double span_mA() const { return span_mA_; }

  /// What came of each of these gains along every target; a run that could not be simulated says so.
  std::vector<Recording> tried(std::initializer_list<Gains> all) const {
    std::vector<Order> orders;
    for (const Gains& gains : all) {
      controllers::Settings complete = settings_;
      set_gains(complete, gains, scenario_.rig);
      for (const auto& known : briefing_.knowledge)
        orders.push_back({plan_, controllers::make(complete, known)});
    }
    return rounds_.simulated(std::move(orders));
  }

  /// The mean over recordings that `tried` gave.
  double cost(std::span<const Recording> recordings) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      if (!recordings[i].failure.empty()) throw std::runtime_error(recordings[i].failure);
      const Wanted& wanted = briefing_.targets[i % briefing_.targets.size()];
      sum += tuning_cost(rmse(recordings[i], wanted), std::span(recordings[i].samples).subspan(wanted.first),
                         span_mA_);
    }
    return sum / static_cast<double>(recordings.size());
  }

  double cost_with_margin(const Gains& gains) const {
    Gains higher = gains;
    higher.proportional_mA *= gain_margin;
    return cost(tried({gains, higher}));
  }

 private:
  double rmse(const Recording& recording, const Wanted& wanted) const {
    const plant::Plant plant = plant::plant_of(plan_.rig, plan_.load_kg);
    double squares = 0.0;
    for (std::size_t k = wanted.first; k < wanted.ratios.size(); ++k)
      squares += std::pow(
          plant.shown_ratio(recording.samples[k].state.joint.contraction_ratio) - wanted.ratios[k], 2);
    return std::sqrt(squares / static_cast<double>(wanted.ratios.size() - wanted.first));
  }

  const domain::Scenario& scenario_;
  const Briefing& briefing_;
  const controllers::Settings& settings_;
  RunPlan plan_;
  double span_mA_;
  Rounds& rounds_;
};

/// The loop as it is without what is fed forward: it is to be good by itself, and gains no less by a model.
controllers::Settings loop_alone(const controllers::Settings& settings) {
  if (!std::holds_alternative<controllers::FeedforwardPidSettings>(settings)) return settings;
  controllers::PidSettings loop;
  static_cast<controllers::PidTerms&>(loop) = std::get<controllers::FeedforwardPidSettings>(settings);
  return loop;
}

TunedController tune_one(const domain::Scenario& scenario, const Briefing& briefing,
                         controllers::Settings& settings, Rounds& rounds,
                         const std::function<void()>& heard) {
  const controllers::PidForm& pid = *controllers::part_of<controllers::PidForm>(settings);
  TunedController result{.controller = controllers::name_of(settings),
                         .load_kg = pid.tuning_load_kg.value_or(lower_median(scenario.loads_kg))};
  const controllers::Settings loop = loop_alone(settings);
  const Tuning tuning(scenario, briefing, loop, result.load_kg, rounds);
  const auto cost = [&](const Gains& gains) {
    heard();
    return tuning.cost_with_margin(gains);
  };
  const auto begin = std::chrono::steady_clock::now();
  try {
    GivenGains given{pid.proportional_mA, pid.integral_time_s, pid.derivative_time_s};
    if (given.proportional_mA) *given.proportional_mA *= per_ratio(scenario.rig);
    result.tuned = tune(cost, given, TuningOptions::for_span(tuning.span_mA()));
    Gains idle = result.tuned.gains;
    idle.proportional_mA = 0.0;
    const auto ended = tuning.tried({result.tuned.gains, idle});
    const std::span without = std::span(ended).last(briefing.targets.size());
    if (std::ranges::all_of(without, [](const Recording& one) { return one.failure.empty(); }))
      result.idle_cost = tuning.cost(without);
    if (!ended.front().failure.empty()) throw std::runtime_error(ended.front().failure);
    result.limits = limits_of(loop, briefing.knowledge.front(), scenario.rig);
    result.metrics = metrics_of(scenario, briefing.targets.front(), ended.front(), result.limits);
    set_gains(settings, result.tuned.gains, scenario.rig);
  } catch (const std::runtime_error& failure) {
    result.failure = failure.what();
  }
  result.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace

std::vector<TunedController> tune_controllers(const domain::Scenario& scenario, const Briefing& briefing,
                                              std::span<controllers::Settings* const> open, unsigned threads,
                                              const std::function<void()>& tried) {
  std::vector<TunedController> tuned(open.size());
  search_in_rounds(open.size(), threads, [&](std::size_t i, Rounds& rounds) {
    tuned[i] = tune_one(scenario, briefing, *open[i], rounds, tried);
  });
  return tuned;
}

namespace {

// What a change of current costs in tuning [contraction ratio for each mA rms and tick, at the thesis's
// span]: enough to keep gains from chasing single encoder counts,
// too little to matter for how the target is followed.
constexpr double effort_weight = 2e-4;

double effort_mA(std::span<const Sample> rows) {
  double sum_squared_mA = 0.0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const double change_mA = rows[k].current_mA - rows[k - 1].current_mA;
    sum_squared_mA += change_mA * change_mA;
  }
  return std::sqrt(sum_squared_mA / static_cast<double>(rows.size()));
}

}  // namespace

double tuning_cost(double rmse, std::span<const Sample> rows, double span_mA) {
  return rmse + effort_weight * (plant::thesis_span_mA / span_mA) * effort_mA(rows);
}

}  // namespace mckibben::run
