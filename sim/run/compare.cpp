// Loads x controllers; see the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/input/number.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

using input::Scenario;

// What a change of current costs in tuning [contraction ratio for each mA rms and tick]: enough to keep gains
// from chasing single encoder counts, too little to matter for how the target is followed.
constexpr double effort_weight = 2e-4;

// Gains must also do with the proportional gain this much higher, so that they are not tuned to the edge of
// stability: the loop's own gain changes with load and contraction.
constexpr double gain_margin = 2.0;

RunPlan plan_of(const Scenario& scenario, double load_kg, std::uint64_t stream) {
  return {.rig = scenario.rig,
          .load_kg = load_kg,
          .ticks = static_cast<std::size_t>(std::llround(scenario.duration_s / scenario.rig.tick_s)),
          .engine = scenario.rig.integrator,
          .noise = scenario.noise,
          .seed = scenario.seed,
          .stream = stream,
          .keep_ledger = true};
}

Metrics metrics_of(const Scenario& scenario, const std::vector<double>& target, const Recording& recording) {
  std::vector<double> contraction, current_mA;
  for (const auto& sample : recording.samples) {
    contraction.push_back(sample.state.joint.contraction_ratio);
    current_mA.push_back(sample.current_mA);
  }
  return measure({.target = target,
                  .contraction = contraction,
                  .current_mA = current_mA,
                  .tick_s = scenario.rig.tick_s,
                  .last_change_s = controllers::last_change_s(scenario.target),
                  .air_kg = recording.ledger.air_drawn_kg});
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

class Comparing {
 public:
  Comparing(const Scenario& scenario, unsigned threads, const ProgressHook& progress)
      : scenario_(scenario), threads_(threads), progress_(progress), settings_(scenario.controllers) {
    const auto ticks = plan_of(scenario, 0.0, 0).ticks;
    result_.target =
        controllers::sample(scenario.target, ticks, scenario.rig.tick_s, scenario.rig.muscle.rest_length_m);
    knowledge_ = knowledge_of(scenario.rig, result_.target);
    if (std::any_of(settings_.begin(), settings_.end(),
                    [](auto& each) { return controllers::calibrated(each); }))
      knowledge_.reach = reachable(scenario.rig);  // only the model-based ones ask for it
  }

  Comparison operator()() {
    tune_all();
    run_all();
    spread_all();
    judge();
    warn();
    return std::move(result_);
  }

 private:
  std::unique_ptr<controllers::Controller> make(const controllers::Settings& settings) const {
    return controllers::make(settings, knowledge_);
  }

  void tune_all() {
    std::vector<controllers::Settings*> open;
    for (auto& settings : settings_)
      if (const auto* terms = controllers::pid_terms(settings); terms && terms->needs_tuning())
        open.push_back(&settings);
    if (open.empty()) return;
    result_.tuned.resize(open.size());
    const std::size_t most = open.size() * static_cast<std::size_t>(TuningOptions{}.evaluations);
    std::atomic<std::size_t> evaluations{0};
    progress_("tuning PID", 0, most);
    for_each_job(
        open.size(), threads_,
        [&](std::size_t i) {
          result_.tuned[i] = tune_one(*open[i], [&] { progress_("tuning PID", ++evaluations, most); });
        },
        [](std::size_t) {});
  }

  TunedController tune_one(controllers::Settings& settings, const std::function<void()>& tried) {
    const controllers::PidTerms& pid = *controllers::pid_terms(settings);
    const double load_kg = pid.tuning_load_kg.value_or(median(scenario_.loads_kg));
    RunPlan plan = plan_of(scenario_, load_kg, 0);
    plan.keep_ledger = false;  // nothing here asks where the air went
    const auto with = [&settings](const Gains& gains) {
      controllers::Settings complete = settings;
      controllers::PidTerms& terms = *controllers::pid_terms(complete);
      terms.proportional_mA = gains.proportional_mA;
      terms.integral_time_s = gains.integral_time_s;
      terms.derivative_time_s = gains.derivative_time_s;
      return complete;
    };
    const auto cost_at = [&](const Gains& gains) {
      const auto controller = make(with(gains));
      const Recording recording = simulate(plan, *controller);
      if (!recording.failure.empty()) throw std::runtime_error(recording.failure);
      double sum_squared_mA = 0.0;
      for (std::size_t k = 1; k < recording.samples.size(); ++k) {
        const double change_mA = recording.samples[k].current_mA - recording.samples[k - 1].current_mA;
        sum_squared_mA += change_mA * change_mA;
      }
      const double effort_mA = std::sqrt(sum_squared_mA / static_cast<double>(recording.samples.size()));
      return metrics_of(scenario_, result_.target, recording).rmse + effort_weight * effort_mA;
    };
    const auto cost = [&](const Gains& gains) {
      if (interrupted()) throw Interrupted();
      tried();
      Gains higher = gains;
      higher.proportional_mA *= gain_margin;
      return 0.5 * (cost_at(gains) + cost_at(higher));
    };
    TunedController result{.controller = controllers::name_of(settings), .load_kg = load_kg};
    try {
      result.tuned = tune(cost, {pid.proportional_mA, pid.integral_time_s, pid.derivative_time_s});
      settings = with(result.tuned.gains);
    } catch (const std::runtime_error& failure) {
      result.failure = failure.what();
    }
    return result;
  }

  void run_all() {
    const std::size_t columns = settings_.size(), total = columns * scenario_.loads_kg.size();
    for (std::size_t i = 0; i < total; ++i)
      result_.runs.push_back({.load_kg = scenario_.loads_kg[i / columns],
                              .controller = controllers::name_of(settings_[i % columns]),
                              .failure = not_begun});
    progress_("simulating", 0, total);
    try {
      for_each_job(
          total, threads_, [&](std::size_t i) { run_one(result_.runs[i], settings_[i % columns], i); },
          [&](std::size_t done) { progress_("simulating", done, total); });
    } catch (const Interrupted&) {
      result_.interrupted = true;
    }
  }

  void run_one(TrackedRun& run, const controllers::Settings& settings, std::size_t index) const {
    for (const auto& tuning : result_.tuned)
      if (tuning.controller == run.controller && !tuning.failure.empty()) {
        run.failure = tuning.failure;
        return;
      }
    const auto controller = make(settings);
    run.recording = simulate(plan_of(scenario_, run.load_kg, index + 1), *controller);
    run.failure = run.recording.failure;
    if (controllers::calibrated(settings)) run.unreachable = unreachable_of(run, settings);
    if (run.failure.empty()) run.metrics = metrics_of(scenario_, result_.target, run.recording);
  }

  Unreachable unreachable_of(const TrackedRun& run, const controllers::Settings& settings) const {
    const controllers::Reach& reach = knowledge_.reach;
    const controllers::ReachOfLoad limits = reach.at_load(run.load_kg);
    const auto* open = std::get_if<controllers::OpenLoopSettings>(&settings);
    Unreachable found =
        open && open->mode == controllers::OpenLoopMode::triangle
            ? unreachable(open->to.ratio(knowledge_.model.rest_length_m), open->speed_per_s, reach, limits)
            : unreachable(result_.target, knowledge_.tick_s, reach, limits, knowledge_.contraction_per_count);
    found.ticks_without_current_speed =
        static_cast<std::size_t>(controllers::value_of(run.recording.findings, "ticks_unreachable"));
    return found;
  }

  // One for each load and reason: controllers that ask the same in vain share it.
  void warn() {
    std::vector<std::pair<std::string, std::string>> said;  // beginning, reason
    for (const auto& run : result_.runs) {
      if (!run.unreachable.any()) continue;
      const std::string reason =
          fmt::format("{} kg: {}", input::write_number(run.load_kg), run.unreachable.text());
      const auto same =
          std::find_if(said.begin(), said.end(), [&](const auto& one) { return one.second == reason; });
      if (same == said.end())
        said.emplace_back(fmt::format("{}: {}", scenario_.name, run.controller), reason);
      else
        same->first += ", " + run.controller;
    }
    for (const auto& [who, reason] : said) result_.warnings.push_back(fmt::format("{} at {}", who, reason));
  }

  void spread_all() {
    for (const auto& settings : settings_) {
      ControllerSpread row{.controller = controllers::name_of(settings)};
      std::vector<double> rmse;
      for (const auto& run : result_.runs)
        if (run.controller == row.controller && run.failure.empty()) rmse.push_back(run.metrics.rmse);
      if (!rmse.empty()) row.rmse = spread(rmse);
      result_.spreads.push_back(std::move(row));
    }
  }

  void judge() {
    for (const auto& criterion : scenario_.criteria) {
      const auto concerns = [&](const std::string& name) {
        return criterion.controller.empty() || criterion.controller == name;
      };
      const auto check = [&](const std::string& who, const char* what, double value,
                             std::optional<double> limit) {
        if (limit && !(value < *limit))
          result_.unmet.push_back(
              fmt::format("{}: {} = {:.4g} is not below {:.4g}", who, what, value, *limit));
      };
      for (const auto& run : result_.runs) {
        if (!concerns(run.controller) || !run.failure.empty()) continue;
        const auto who = fmt::format("{} at {} kg", run.controller, input::write_number(run.load_kg));
        check(who, "rmse", run.metrics.rmse, criterion.rmse_below);
        check(who, "largest_error", run.metrics.largest_error, criterion.largest_error_below);
      }
      for (const auto& row : result_.spreads)
        if (concerns(row.controller) && row.rmse)
          check(row.controller, "spread", row.rmse->width(), criterion.spread_below);
    }
  }

  const Scenario& scenario_;
  unsigned threads_;
  const ProgressHook& progress_;
  std::vector<controllers::Settings> settings_;
  controllers::Knowledge knowledge_;
  Comparison result_;
};

}  // namespace

Comparison compare(const Scenario& scenario, unsigned threads, const ProgressHook& progress) {
  return Comparing(scenario, threads, progress)();
}

}  // namespace mckibben::run
