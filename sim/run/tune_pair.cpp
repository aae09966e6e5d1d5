// The cost of gains: the mean over the targets; see the header.
#include <cmath>
#include <stdexcept>
#include <utility>

#include <sim/run/metrics.hpp>
#include <sim/run/rounds.hpp>
#include <sim/run/tune_controller.hpp>
#include <sim/run/tune_pair.hpp>
#include <sim/run/tuning_cost.hpp>

namespace mckibben::run {
namespace {

using controllers::PairPidSettings;

class PairTuning {
 public:
  PairTuning(const domain::PairScenario& scenario, const PairPidSettings& settings, double load_kg,
             Rounds& rounds)
      : settings_(settings), plan_(plan_of(scenario, load_kg)), rounds_(rounds) {
    plan_.keep_ledger = false;
    for (const auto& target : scenario.targets) known_.push_back(knowledge_of(scenario, target));
    span_mA_ = controllers::working_range(known_.front()).width_mA();
  }

  double span_mA() const { return span_mA_; }

  PairPidSettings with(const Gains& gains) const {
    PairPidSettings complete = settings_;
    complete.proportional_mA_per_rad = gains.proportional_mA / rad_per_ratio(plan_.rig);
    complete.integral_time_s = gains.integral_time_s;
    complete.derivative_time_s = gains.derivative_time_s;
    return complete;
  }

  double cost(const Gains& gains) const {
    Gains higher = gains;
    higher.proportional_mA *= gain_margin;
    std::vector<Order> orders;
    for (const Gains& each : {gains, higher})
      for (const auto& known : known_) orders.push_back({plan_, with(each).make(known)});
    const auto all = rounds_.simulated(std::move(orders));
    double sum = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].failure.empty()) throw std::runtime_error(all[i].failure);
      sum += tuning_cost(error_of(all[i], known_[i % known_.size()].target), all[i], span_mA_);
    }
    return sum / static_cast<double>(all.size());
  }

 private:
  double error_of(const Recording& recording, const std::vector<double>& target) const {
    double squares = 0.0;
    for (std::size_t k = 0; k < target.size(); ++k)
      squares += std::pow(
          recording.samples[k].state.joint.contraction_ratio - plan_.pair->contraction_ratio - target[k], 2);
    return std::sqrt(squares / static_cast<double>(target.size()));
  }

  const PairPidSettings& settings_;
  RunPlan plan_;
  Rounds& rounds_;
  std::vector<controllers::Knowledge> known_;
  double span_mA_ = 0.0;
};

TunedPair tune_one(const domain::PairScenario& scenario, PairPidSettings& settings, Rounds& rounds,
                   const std::function<void()>& tried) {
  TunedPair result{.controller = settings.name,
                   .load_kg = settings.tuning_load_kg.value_or(lower_median(scenario.hand.loads_kg))};
  const PairTuning tuning(scenario, settings, result.load_kg, rounds);
  const auto cost = [&](const Gains& gains) {
    tried();
    return tuning.cost(gains);
  };
  GivenGains given{std::nullopt, settings.integral_time_s, settings.derivative_time_s};
  if (settings.proportional_mA_per_rad)
    given.proportional_mA = *settings.proportional_mA_per_rad * rad_per_ratio(scenario.rig);
  try {
    result.tuned = tune(cost, given, TuningOptions::for_span(tuning.span_mA()));
    settings = tuning.with(result.tuned.gains);
  } catch (const std::runtime_error& failure) {
    result.failure = failure.what();
  }
  return result;
}

}  // namespace

RunPlan plan_of(const domain::PairScenario& scenario, double load_kg) {
  return {.rig = scenario.rig,
          .pair = plant::with_load_in_hand(*scenario.rig.pair(), load_kg, scenario.hand.distance_m),
          .ticks = static_cast<std::size_t>(std::llround(scenario.duration_s / scenario.rig.tick_s)),
          .engine = scenario.rig.integrator,
          .keep_ledger = true};
}

controllers::Knowledge knowledge_of(const domain::PairScenario& scenario, const domain::JointTarget& target) {
  const double tick_s = scenario.rig.tick_s;
  const auto ticks = static_cast<std::size_t>(std::llround(scenario.duration_s / tick_s));
  controllers::Knowledge known =
      knowledge_of(scenario.rig, *scenario.rig.pair(),
                   controllers::sample(target.angle, ticks, tick_s, rad_per_ratio(scenario.rig)));
  if (target.stiffness)
    known.pair->stiffness_N_m_per_rad = controllers::sample(*target.stiffness, ticks, tick_s, 1.0);
  return known;
}

double rad_per_ratio(const plant::Rig& rig) {
  return rig.muscle.rest_length_m / rig.joint.wheel_radius_m;
}

std::vector<TunedPair> tune_pair(const domain::PairScenario& scenario,
                                 std::vector<controllers::PairSettings>& settings, unsigned threads,
                                 const std::function<void()>& tried) {
  std::vector<PairPidSettings*> open;
  for (auto& each : settings)
    if (auto* pid = std::get_if<PairPidSettings>(&each); pid != nullptr && pid->needs_tuning())
      open.push_back(pid);
  std::vector<TunedPair> tuned(open.size());
  search_in_rounds(open.size(), threads, [&](std::size_t i, Rounds& rounds) {
    tuned[i] = tune_one(scenario, *open[i], rounds, tried);
  });
  return tuned;
}

}  // namespace mckibben::run
