// Loads x controllers; see the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/domain/number.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/briefing.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/packed.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/remarks.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/track.hpp>
#include <sim/run/warnings.hpp>

namespace mckibben::run {
namespace {

using domain::Scenario;

std::string id_of(const std::string& controller, double load_kg) {
  return fmt::format("{} at {} kg", controller, domain::write_number(load_kg));
}

class Comparing {
 public:
  Comparing(const Scenario& scenario, unsigned threads, const ProgressHook& progress, const Sharing& sharing)
      : scenario_(scenario),
        threads_(threads),
        progress_(progress),
        sharing_(sharing),
        briefing_(briefing_of(scenario)),
        settings_(briefing_.settings),
        knowledge_(briefing_.knowledge) {
    result_.target = knowledge_.target;
  }

  Comparison operator()() {
    tune_all();
    run_all();
    if (scenario_.robustness.rigs > 0 && !result_.interrupted) draw_all();
    spread_all();
    judge();
    warn();
    return std::move(result_);
  }

 private:
  void tune_all() {
    std::vector<controllers::Settings*> open;
    for (auto& settings : settings_)
      if (const auto* terms = controllers::pid_terms(settings); terms && terms->needs_tuning())
        open.push_back(&settings);
    if (open.empty()) return;
    const std::size_t most = open.size() * static_cast<std::size_t>(TuningOptions{}.evaluations);
    std::atomic<std::size_t> evaluations{0};
    progress_("tuning PID", 0, most);
    const auto tried = [&] { progress_("tuning PID", ++evaluations, most); };
    if (!sharing_) {
      result_.tuned = tune_controllers(scenario_, knowledge_, open, threads_, tried);
      return;
    }
    const auto job = [&](std::size_t i) {
      return packed(tune_controllers(scenario_, knowledge_, std::span(&open[i], 1), 1, tried).front());
    };
    result_.tuned.resize(open.size());
    sharing_("tuned", open.size(), true, job, [&](std::size_t i, const std::string& bytes) {
      result_.tuned[i] = unpacked_tuning(bytes);
      if (result_.tuned[i].failure.empty()) set_gains(*open[i], result_.tuned[i].tuned.gains);
    });
  }

  void run_all() {
    const std::size_t columns = settings_.size(), total = columns * scenario_.loads_kg.size();
    for (std::size_t i = 0; i < total; ++i)
      result_.runs.push_back({.load_kg = scenario_.loads_kg[i / columns],
                              .controller = controllers::name_of(settings_[i % columns]),
                              .failure = not_begun});
    progress_("simulating", 0, total);
    try {
      if (sharing_)
        share_runs(total);
      else
        simulate_runs(0, total, threads_, progress_);
    } catch (const Interrupted&) {
      result_.interrupted = true;
    }
  }

  void share_runs(std::size_t total) {
    const auto job = [&](std::size_t i) {
      simulate_runs(i, 1, 1, [](const std::string&, std::size_t, std::size_t) {});
      return packed(result_.runs[i]);
    };
    sharing_("run", total, false, job, [&](std::size_t i, const std::string& bytes) {
      result_.runs[i] = unpacked_run(bytes);
      progress_("simulating", i + 1, total);
    });
  }

  /// Every load under every controller once more, on rigs that are drawn.
  void draw_all() {
    const domain::Variation variation = within_stated(scenario_.rig);
    for (const auto& number : variation.numbers) result_.drawn.push_back(number.path);
    result_.robustness.resize(result_.runs.size());
    const auto row = [&](std::size_t i, unsigned threads) {
      const controllers::Settings& settings = settings_of(i);
      const double load_kg = result_.runs[i].load_kg;
      const auto runs = lacks_gains(result_.runs[i])
                            ? std::vector<DrawnRun>(static_cast<std::size_t>(scenario_.robustness.rigs))
                            : on_drawn_rigs(
                                  scenario_, result_.target, variation, load_kg,
                                  limits_of(settings, knowledge_, scenario_.rig),
                                  [&] { return briefing_.make(settings, load_kg); }, threads);
      return std::string(reinterpret_cast<const char*>(runs.data()), runs.size() * sizeof(DrawnRun));
    };
    const auto take = [&](std::size_t i, const std::string& bytes) {
      std::vector<DrawnRun> runs(bytes.size() / sizeof(DrawnRun));
      std::memcpy(static_cast<void*>(runs.data()), bytes.data(), bytes.size());
      result_.robustness[i] = summed(result_.runs[i].load_kg, result_.runs[i].controller, runs);
      progress_("drawing rigs", i + 1, result_.runs.size());
    };
    progress_("drawing rigs", 0, result_.runs.size());
    try {
      if (sharing_)
        return sharing_(
            "drawn", result_.runs.size(), false, [&](std::size_t i) { return row(i, 1); }, take);
      for (std::size_t i = 0; i < result_.runs.size(); ++i) take(i, row(i, threads_));
    } catch (const Interrupted&) {
      result_.interrupted = true;
      result_.robustness.clear();
    }
  }

  const controllers::Settings& settings_of(std::size_t run) const {
    return settings_[run % settings_.size()];
  }

  void simulate_runs(std::size_t first, std::size_t count, unsigned threads, const ProgressHook& progress) {
    std::vector<std::size_t> wanted;
    for (std::size_t i = first; i < first + count; ++i)
      if (!lacks_gains(result_.runs[i])) wanted.push_back(i);
    std::atomic<std::size_t> done{count - wanted.size()};
    simulate_all(
        wanted.size(), threads,
        [&](std::size_t i) {
          const std::size_t run = wanted[i];
          const double load_kg = result_.runs[run].load_kg;
          return Order{plan_of(scenario_, load_kg, run + 1), briefing_.make(settings_of(run), load_kg)};
        },
        [&](std::size_t i, Recording recording) {
          result_.runs[wanted[i]].recording = std::move(recording);
          measure(result_.runs[wanted[i]], settings_of(wanted[i]));
          progress("simulating", ++done, count);
        });
  }

  bool lacks_gains(TrackedRun& run) const {
    for (const auto& tuning : result_.tuned)
      if (tuning.controller == run.controller && !tuning.failure.empty()) {
        run.failure = tuning.failure;
        return true;
      }
    return false;
  }

  void measure(TrackedRun& run, const controllers::Settings& settings) const {
    run.failure = run.recording.failure;
    if (controllers::calibrated(settings)) run.unreachable = unreachable_of(run, settings);
    if (!run.failure.empty()) return;
    run.limits = limits_of(settings, knowledge_, scenario_.rig);
    run.metrics = metrics_of(scenario_, result_.target, run.recording, run.limits);
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

  void warn() {
    std::vector<std::string> all;
    for (const auto& run : result_.runs) {
      const std::string id = id_of(run.controller, run.load_kg);
      if (run.unreachable.any()) all.push_back(warning_of_run(id, run.unreachable.text()));
      if (const std::string stood = limit_warning(run, scenario_.rig); !stood.empty())
        all.push_back(warning_of_run(id, stood));
      for (const auto& doubt : doubts(run.recording)) all.push_back(warning_of_run(id, doubt));
    }
    for (const auto& tuned : result_.tuned)
      if (gained_nothing(tuned))
        all.push_back(
            warning_of_run(id_of(tuned.controller, tuned.load_kg), tuning_warning(tuned, scenario_.rig)));
    result_.warnings = grouped(all);
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
        const auto who = id_of(run.controller, run.load_kg);
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
  const Sharing& sharing_;
  Briefing briefing_;
  std::vector<controllers::Settings>& settings_;
  const controllers::Knowledge& knowledge_;
  Comparison result_;
};

}  // namespace

Comparison compare(const Scenario& scenario, unsigned threads, const ProgressHook& progress,
                   const Sharing& sharing) {
  return Comparing(scenario, threads, progress, sharing)();
}

}  // namespace mckibben::run
