// See the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/domain/number.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/pair_runs.hpp>
#include <sim/run/remarks.hpp>
#include <sim/run/rig_model.hpp>
#include <sim/run/two_currents.hpp>
#include <sim/run/warnings.hpp>

namespace mckibben::run {
namespace {

void take(PairRun& run, Recording recording, const domain::RigFile& rig) {
  run.recording = std::move(recording);
  run.failure = run.recording.failure;
  const auto& rows = run.recording.samples;
  if (rows.empty()) return;
  run.angle_rad = span_of(rows, [&](const Sample& row) { return angle_rad(rig, row); });
  run.cord_force_N = span_of(rows, [](const Sample& row) { return row.cord_force_N; });
  run.opposite_cord_force_N = span_of(rows, [](const Sample& row) { return row.opposite.cord_force_N; });
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Whether a current is at an end of what the valve answers to, as the DAC gives it.
bool is_at_end(double current_mA, const plant::Rig& rig) {
  return current_mA <= plant::dac_output_mA(rig.dac, rig.valve.zero_current_mA) ||
         current_mA >= plant::dac_output_mA(rig.dac, rig.valve.span_current_mA);
}

void judge(PairRun& run, const domain::PairScenario& scenario) {
  if (!run.failure.empty()) return;
  JointFollowed& followed = *run.followed;
  const auto& rows = run.recording.samples;
  const plant::Rig opposite = plant::opposite_rig(scenario.rig, *scenario.rig.pair());
  std::vector<double> angle, current, stiffness;
  std::size_t at_end = 0;
  for (const Sample& row : rows) {
    angle.push_back(angle_rad(scenario.rig, row));
    current.push_back(row.current_mA);
    stiffness.push_back(row.stiffness_N_m_per_rad);
    if (is_at_end(row.current_mA, scenario.rig) || is_at_end(row.opposite.current_mA, opposite)) ++at_end;
  }
  followed.metrics =
      measure({.target = followed.angle_rad,
               .contraction = angle,
               .current_mA = current,
               .tick_s = scenario.rig.tick_s,
               .last_change_s = controllers::last_change_s(scenario.targets[followed.target].angle),
               .air_kg = run.recording.ledger.air_drawn_kg});
  followed.at_limit = static_cast<double>(at_end) / static_cast<double>(rows.size());
  followed.stiffness_had = mean_of(stiffness);
  if (followed.stiffness_N_m_per_rad.empty()) return;
  followed.stiffness_asked = mean_of(followed.stiffness_N_m_per_rad);
  double squares = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    squares += std::pow(stiffness[k] - followed.stiffness_N_m_per_rad[k], 2);
  followed.stiffness_rmse = std::sqrt(squares / static_cast<double>(rows.size()));
}

class RunningPairs {
 public:
  RunningPairs(const domain::PairScenario& scenario, unsigned threads, const ProgressHook& progress)
      : scenario_(scenario), threads_(threads), progress_(progress), settings_(scenario.controllers) {
    for (auto& settings : settings_)
      if (auto* terms = model_terms(settings)) {
        const auto named = scenario.believed.find(name_of(settings));
        terms->model = model_of_pair(named == scenario.believed.end() ? scenario.rig : named->second,
                                     scenario.hand.distance_m, scenario.rig.tick_s);
      }
  }

  PairRuns operator()() {
    tune_all();
    for (const auto& currents : scenario_.currents)
      result_.runs.push_back({.name = currents.name, .failure = not_begun});
    for (std::size_t t = 0; t < scenario_.targets.size(); ++t)
      for (const double load_kg : scenario_.hand.loads_kg)
        for (std::size_t c = 0; c < settings_.size(); ++c) add(t, load_kg, c);
    for_each_result(result_.runs.size(), threads_, "simulating", progress_, [&](std::size_t i) { run(i); });
    return std::move(result_);
  }

 private:
  void tune_all() {
    const auto open =
        static_cast<std::size_t>(std::count_if(settings_.begin(), settings_.end(), [](const auto& settings) {
          const auto* pid = std::get_if<controllers::PairPidSettings>(&settings);
          return pid != nullptr && pid->needs_tuning();
        }));
    if (open == 0) return;
    const std::size_t most = open * static_cast<std::size_t>(TuningOptions{}.evaluations);
    std::atomic<std::size_t> trials{0};
    progress_("tuning PID", 0, most);
    result_.tuned =
        tune_pair(scenario_, settings_, threads_, [&] { progress_("tuning PID", ++trials, most); });
  }

  void add(std::size_t t, double load_kg, std::size_t c) {
    const controllers::Knowledge known = knowledge_of(scenario_, scenario_.targets[t]);
    JointFollowed followed{.target = t,
                           .controller = c,
                           .load_kg = load_kg,
                           .angle_rad = known.target,
                           .stiffness_N_m_per_rad = known.pair->stiffness_N_m_per_rad};
    for (double& each : followed.angle_rad) each *= rad_per_ratio(scenario_.rig);
    result_.runs.push_back({.name = domain::name_of_run(scenario_, t, load_kg, c),
                            .failure = not_begun,
                            .followed = std::move(followed)});
  }

  void run(std::size_t i) {
    PairRun& run = result_.runs[i];
    if (!run.followed) {
      const domain::TwoCurrents& given = scenario_.currents[i];
      const auto player = play(given.current_1, given.current_2, scenario_.rig);
      return take(run, simulate(plan_of(scenario_, 0.0), *player), scenario_.rig);
    }
    const controllers::PairSettings& settings = settings_[run.followed->controller];
    for (const TunedPair& tuned : result_.tuned)
      if (tuned.controller == name_of(settings) && !tuned.failure.empty()) {
        run.failure = tuned.failure;
        return;
      }
    const auto controller = make(settings, knowledge_of(scenario_, scenario_.targets[run.followed->target]));
    take(run, simulate(plan_of(scenario_, run.followed->load_kg), *controller), scenario_.rig);
    judge(run, scenario_);
  }

  const domain::PairScenario& scenario_;
  unsigned threads_;
  const ProgressHook& progress_;
  std::vector<controllers::PairSettings> settings_;
  PairRuns result_;
};

}  // namespace

PairRuns run_pairs(const domain::PairScenario& scenario, unsigned threads, const ProgressHook& progress) {
  return RunningPairs(scenario, threads, progress)();
}

std::vector<std::string> warnings_of(const std::vector<PairRun>& runs) {
  std::vector<std::string> all;
  for (const PairRun& run : runs) {
    for (const std::string& doubt : doubts(run.recording)) all.push_back(warning_of_run(run.name, doubt));
    if (run.followed && run.failure.empty() && run.followed->at_limit >= mostly)
      all.push_back(warning_of_run(
          run.name,
          fmt::format("some current stood at an end of what its valve answers to for {:.0f} % of the "
                      "time: the stiffness, or co_contraction, leaves the angle nothing, or both ask "
                      "for more than the valves have",
                      100.0 * run.followed->at_limit)));
  }
  return grouped(all);
}

}  // namespace mckibben::run
