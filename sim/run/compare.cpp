// Targets x loads x controllers; see the header.
#include <atomic>
#include <bit>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/data/joint_reach.hpp>
#include <sim/data/warnings.hpp>
#include <sim/domain/number.hpp>
#include <sim/run/briefing.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/packed.hpp>
#include <sim/run/remarks.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/two_currents.hpp>

namespace mckibben::run {
namespace {

using domain::Scenario;

std::string id_of(const std::string& controller, double load_kg) {
  return fmt::format("{} at {} kg", controller, domain::write_kg(load_kg));
}

constexpr auto findings_of = [](auto&& visit, auto& findings) {
  if constexpr (requires { visit.size_of_list(1); })
    findings.resize(visit.size_of_list(1));
  else
    visit(findings.size());
  for (auto& finding : findings) {
    visit(finding.name);
    visit(finding.unit);
    visit(finding.value);
  }
};

constexpr auto members_of_robust_row = [](auto&& visit, auto& of) {
  visit(of.load_kg);
  visit(of.controller);
  visit(of.rigs);
  visit(of.failures);
  visit(of.no_result);
  visit(of.limit_cycles);
  visit(of.saturated);
  visit(of.over_contracted);
  visit(of.rmse);
  visit(of.why);
};

constexpr auto members_of_run = [](auto&& visit, auto& of) {
  visit(of.load_kg);
  visit(of.controller);
  auto& recording = of.recording;
  visit(recording.samples);
  visit(recording.ledger);
  visit(recording.imbalance);
  visit(recording.solver);
  visit(recording.largest_contraction_ratio);
  visit(recording.left_speed);
  visit(recording.failure);
  findings_of(visit, recording.findings);
  visit(recording.driven);
  visit(recording.slack);
  visit(of.metrics);
  visit(of.failure);
  visit(of.unreachable);
  visit(of.limits);
  visit(of.id);
  visit(of.name);
  visit(of.target);
  visit(of.joint);
  visit(of.cycle);
};

constexpr auto members_of_tuning = [](auto&& visit, auto& of) {
  visit(of.controller);
  visit(of.load_kg);
  visit(of.tuned);
  visit(of.failure);
  visit(of.idle_cost);
  visit(of.metrics);
  visit(of.limits);
};

class Comparing {
 public:
  Comparing(const Scenario& scenario, unsigned threads, const ProgressHook& progress, const Sharing& sharing)
      : scenario_(scenario),
        threads_(threads),
        progress_(progress),
        sharing_(sharing),
        briefing_(briefing_of(scenario)),
        settings_(briefing_.settings) {
    result_.targets = briefing_.targets;
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
      if (const auto* terms = controllers::part_of<controllers::PidForm>(settings);
          terms && terms->needs_tuning())
        open.push_back(&settings);
    if (open.empty()) return;
    const std::size_t most = 2 * open.size() * static_cast<std::size_t>(TuningOptions{}.evaluations);
    std::atomic<std::size_t> evaluations{0};
    progress_("tuning PID", 0, most);
    const auto tried = [&] { progress_("tuning PID", ++evaluations, most); };
    if (!sharing_) {
      result_.tuned = tune_controllers(scenario_, briefing_, open, threads_, tried);
      return;
    }
    const auto job = [&](std::size_t i) {
      return packed(tune_controllers(scenario_, briefing_, std::span(&open[i], 1), 1, tried).front(),
                    members_of_tuning);
    };
    result_.tuned.resize(open.size());
    sharing_("tuned", open.size(), true, job, [&](std::size_t i, const std::string& bytes) {
      unpack(bytes, result_.tuned[i], members_of_tuning);
      if (result_.tuned[i].failure.empty()) set_gains(*open[i], result_.tuned[i].tuned.gains, scenario_.rig);
    });
  }

  void run_all() {
    for (const auto& currents : scenario_.currents)
      result_.runs.push_back(
          {.controller = "", .failure = not_begun, .id = currents.name, .name = currents.name});
    for (const auto& [target, load_kg, first] : tasks_of(scenario_))
      for (const auto& settings : settings_) {
        const std::string& controller = controllers::name_of(settings);
        const std::string name = domain::name_of_run(scenario_, target, load_kg, controller);
        result_.runs.push_back({.load_kg = load_kg,
                                .controller = controller,
                                .failure = not_begun,
                                .id = scenario_.rig.pair() != nullptr ? name : id_of(controller, load_kg),
                                .name = name,
                                .target = target});
      }
    const std::size_t total = result_.runs.size();
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
      return packed(result_.runs[i], members_of_run);
    };
    sharing_("run", total, false, job, [&](std::size_t i, const std::string& bytes) {
      unpack(bytes, result_.runs[i], members_of_run);
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
                            ? std::vector<DrawnRun>(static_cast<std::size_t>(scenario_.robustness.rigs),
                                                    {.why = result_.runs[i].failure})
                            : on_drawn_rigs(
                                  scenario_, result_.targets.front(), variation, load_kg,
                                  limits_of(settings, briefing_.knowledge.front(), scenario_.rig),
                                  [&] { return briefing_.make(settings, 0, load_kg); }, threads);
      return packed(summed(load_kg, result_.runs[i].controller, runs), members_of_robust_row);
    };
    const auto take = [&](std::size_t i, const std::string& bytes) {
      unpack(bytes, result_.robustness[i], members_of_robust_row);
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
    return settings_[(run - scenario_.currents.size()) % settings_.size()];
  }

  void simulate_runs(std::size_t first, std::size_t count, unsigned threads, const ProgressHook& progress) {
    std::vector<std::size_t> wanted;
    for (std::size_t i = first; i < first + count; ++i)
      if (!lacks_gains(result_.runs[i])) wanted.push_back(i);
    std::atomic<std::size_t> done{count - wanted.size()};
    simulate_all(
        wanted.size(), threads,
        [&](std::size_t i) {
          const std::size_t at = wanted[i];
          // One load has one noise, whichever controllers and loads are beside it.
          const double load_kg = result_.runs[at].load_kg;
          return Order{plan_of(scenario_, load_kg, std::bit_cast<std::uint64_t>(load_kg)), controller_of(at)};
        },
        [&](std::size_t i, Recording recording) {
          result_.runs[wanted[i]].recording = std::move(recording);
          measure(wanted[i]);
          progress("simulating", ++done, count);
        });
  }

  std::unique_ptr<controllers::Controller> controller_of(std::size_t at) const {
    const TrackedRun& run = result_.runs[at];
    if (run.followed()) return briefing_.make(settings_of(at), run.target, run.load_kg);
    const domain::TwoCurrents& given = scenario_.currents[at];
    return play(given.current_1, given.current_2, scenario_.rig);
  }

  bool lacks_gains(TrackedRun& run) const {
    for (const auto& tuning : result_.tuned)
      if (tuning.controller == run.controller && !tuning.failure.empty()) {
        run.failure = tuning.failure;
        return true;
      }
    return false;
  }

  void measure(std::size_t at) {
    TrackedRun& run = result_.runs[at];
    run.failure = run.recording.failure;
    const Wanted* wanted = run.followed() ? &result_.targets[run.target] : nullptr;
    if (scenario_.rig.pair() != nullptr && !run.recording.samples.empty())
      run.joint = joint_figures(scenario_.rig, run.recording, wanted);
    if (wanted == nullptr) return;
    const controllers::Settings& settings = settings_of(at);
    if (std::holds_alternative<plant::HangingLoad>(scenario_.rig.mechanics) && !domain::is_given(settings))
      run.unreachable = unreachable_of(run, settings);
    if (!run.failure.empty()) return;
    run.limits = limits_of(settings, briefing_.knowledge[run.target], scenario_.rig);
    run.metrics = metrics_of(scenario_, *wanted, run.recording, run.limits);
    if (!scenario_.rig.has_angle() && !domain::is_given(settings))
      run.cycle = limit_cycle(run.recording, *wanted, scenario_.rig.tick_s);
  }

  Unreachable unreachable_of(const TrackedRun& run, const controllers::Settings& settings) const {
    const controllers::Knowledge& known = briefing_.knowledge[run.target];
    const bool plans = controllers::part_of<controllers::CalibrationTerms>(settings) != nullptr;
    const controllers::Reach reach = plans ? known.reach : controllers::Reach{};
    controllers::ReachOfLoad limits = plans ? reach.at_load(run.load_kg) : controllers::ReachOfLoad{};
    const controllers::ReachOfLoad ends = ends_of_way(scenario_.rig, run.load_kg);
    limits.lowest_rising = ends.lowest_rising;
    limits.lowest_falling = ends.lowest_falling;
    limits.highest = ends.highest;
    const auto* open = std::get_if<controllers::OpenLoopSettings>(&settings);
    Unreachable found =
        open && open->mode == controllers::OpenLoopMode::triangle
            ? unreachable(open->to.ratio(known.model.rest_length_m), open->speed_per_s, reach, limits)
            : unreachable(known.target, known.tick_s, reach, limits, known.contraction_per_count);
    found.ticks_without_current_speed =
        static_cast<std::size_t>(controllers::value_of(run.recording.findings, "ticks_unreachable"));
    return found;
  }

  /// Why a joint missed its target, if none can follow that.
  std::string beyond_joint_of(const TrackedRun& run) const {
    if (scenario_.rig.pair() == nullptr) return "";
    const auto beyond = data::beyond_joint(scenario_, scenario_.targets[run.target], run.load_kg);
    return beyond.angle + (beyond.angle.empty() || beyond.stiffness.empty() ? "" : "; ") + beyond.stiffness;
  }

  void warn() {
    std::vector<std::string> all;
    std::string beyond;
    for (std::size_t i = 0; i < result_.runs.size(); ++i) {
      const TrackedRun& run = result_.runs[i];
      const std::string& id = run.id;
      for (const Unreachable& found : {run.unreachable.heights(), run.unreachable.speeds()})
        if (found.any()) all.push_back(data::warning_of_run(id, found.text()));
      if (run.followed() && (i - scenario_.currents.size()) % settings_.size() == 0)
        beyond = beyond_joint_of(run);  // alike of all that follow this target with this load
      const bool calibrated =
          run.followed() && controllers::part_of<controllers::CalibrationTerms>(settings_of(i)) != nullptr;
      if (const std::string stood = beyond.empty() ? limit_warning(run, scenario_.rig, calibrated) : beyond;
          !stood.empty())
        all.push_back(data::warning_of_run(id, stood));
      if (run.followed())
        for (const std::string& wrong :
             {load_warning(run, settings_of(i)), reading_warning(run, settings_of(i), scenario_.rig),
              missed_warning(run, result_.targets[run.target], settings_of(i), scenario_.rig),
              cycle_warning(run, result_.targets[run.target], settings_of(i), scenario_.rig)})
          if (!wrong.empty()) all.push_back(data::warning_of_run(id, wrong));
      if (moves(run.recording.left_speed, scenario_.rig) && scenario_.skip_s.value_or(0.0) == 0.0)
        all.push_back(data::warning_of_run(id, still_moves(run.recording.left_speed, scenario_.rig)));
      for (const auto& doubt : doubts(run.recording)) all.push_back(data::warning_of_run(id, doubt));
    }
    for (const auto& tuned : result_.tuned)
      if (gained_nothing(tuned))
        all.push_back(data::warning_of_run(id_of(tuned.controller, tuned.load_kg),
                                           tuning_warning(tuned, scenario_.rig)));
    result_.warnings = data::grouped(all);
  }

  void spread_all() {
    for (const auto& settings : settings_) {
      ControllerSpread row{.controller = controllers::name_of(settings)};
      std::vector<double> rmse;
      for (const auto& run : result_.runs) {
        if (run.controller != row.controller) continue;
        ++row.runs;
        if (run.failure.empty()) rmse.push_back(run.metrics.rmse);
      }
      row.with_result = rmse.size();
      if (!rmse.empty()) row.rmse = spread(rmse);
      result_.spreads.push_back(std::move(row));
    }
  }

  void judge() {
    const char* unit = scenario_.rig.has_angle() ? " rad" : "";
    for (const auto& criterion : scenario_.criteria) {
      const auto concerns = [&](const std::string& name) {
        return criterion.controller.empty() || criterion.controller == name;
      };
      const auto check = [&](const std::string& who, const char* what, double value,
                             std::optional<double> limit) {
        if (limit && !(value < *limit))
          result_.unmet.push_back(
              fmt::format("{}: {} = {:.4g}{} is not below {:.4g}{}", who, what, value, unit, *limit, unit));
      };
      for (const auto& run : result_.runs) {
        if (!run.followed() || !concerns(run.controller)) continue;
        if (!run.failure.empty()) {
          if (criterion.rmse_below || criterion.largest_error_below)
            result_.unjudged.push_back(run.id + ": its errors, as it has no result");
          continue;
        }
        check(run.id, "rmse", run.metrics.rmse, criterion.rmse_below);
        check(run.id, "largest_error", run.metrics.largest_error, criterion.largest_error_below);
      }
      for (const auto& row : result_.spreads)
        if (concerns(row.controller) && row.partial() && criterion.spread_below)
          result_.unjudged.push_back(fmt::format("{}: its spread, as {} of {} loads have a result",
                                                 row.controller, row.with_result, row.runs));
        else if (concerns(row.controller) && row.rmse)
          check(row.controller, "spread", row.rmse->width(), criterion.spread_below);
    }
  }

  const Scenario& scenario_;
  unsigned threads_;
  const ProgressHook& progress_;
  const Sharing& sharing_;
  Briefing briefing_;
  std::vector<controllers::Settings>& settings_;
  Comparison result_;
};

}  // namespace

std::vector<Task> tasks_of(const Scenario& scenario) {
  std::vector<Task> all;
  const std::size_t given = scenario.currents.size(), controllers = scenario.controllers.size();
  for (std::size_t t = 0; t < (scenario.rig.pair() != nullptr ? scenario.targets.size() : 1); ++t)
    for (const double load_kg : scenario.loads_kg)
      all.push_back({t, load_kg, given + all.size() * controllers});
  return all;
}

Comparison compare(const Scenario& scenario, unsigned threads, const ProgressHook& progress,
                   const Sharing& sharing) {
  return Comparing(scenario, threads, progress, sharing)();
}

}  // namespace mckibben::run
