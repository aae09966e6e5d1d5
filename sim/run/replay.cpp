// Replay; see the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <controllers/waveform.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/remembered.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

/// Of a run with the tick's own rows: its current, as a controller.
Order order_of(const domain::Run& measured, const domain::RigFile& rig) {
  controllers::RecordedCurrent recorded;
  recorded.samples_mA = measured.current_mA;
  return {{.rig = rig,
           .load_kg = measured.load_kg,
           .ticks = measured.current_mA.size(),
           .engine = rig.integrator,
           .keep_ledger = true},
          recorded.make(knowledge_of(rig, {}))};
}

/// Of a run with stamps of its own.
Recording followed(const domain::Run& measured, const domain::RigFile& rig) {
  return follow_as_seen(
      rig, measured.load_kg, course_of(*measured.measured, rig),
      {measured.contraction_ratio, measured.rest_length_m, measured.measured->time_s.front()});
}

/// What a row of the measurement would read: counts, or where its rows were made of stamps the load's place,
/// the joint's angle, or the cord's force.
double read_of(const Sample& sample, const domain::Run& measured, const domain::RigFile& rig) {
  if (measured.kind_of_judged() == domain::Judged::angle) return angle_rad(rig, sample);
  if (measured.kind_of_judged() == domain::Judged::force) return sample.cord_force_N;
  if (!measured.measured) return static_cast<double>(sample.counts) * contraction_per_count(rig);
  return sample.shown_ratio() * rig.muscle.rest_length_m / measured.rest_length_m;
}

ReplayedRun compared(const domain::Run& measured, const domain::RigFile& rig, Recording recording) {
  ReplayedRun run{.id = measured.id, .load_kg = measured.load_kg, .recording = std::move(recording)};
  run.failure = run.recording.failure;
  if (!run.failure.empty()) return run;
  const auto rows = static_cast<double>(measured.judged().size());
  double squares = 0.0, sum = 0.0, pressure_squares = 0.0;
  for (std::size_t k = 0; k < measured.judged().size(); ++k) {
    const auto& sample = run.recording.samples[k];
    const double error = read_of(sample, measured, rig) - measured.judged()[k];
    squares += error * error;
    sum += error;
    run.largest_error = std::max(run.largest_error, std::abs(error));
    if (measured.muscle_pressure_Pa) {
      const double off_Pa =
          rig.effects.shown_Pa(sample.state.side.muscle_pressure_Pa) - (*measured.muscle_pressure_Pa)[k];
      pressure_squares += off_Pa * off_Pa;
    }
  }
  run.rmse = std::sqrt(squares / rows);
  run.mean_error = sum / rows;
  if (measured.muscle_pressure_Pa) run.pressure_rmse_Pa = std::sqrt(pressure_squares / rows);
  return run;
}

}  // namespace

std::vector<ReplayedRun> replay(const domain::Dataset& dataset, unsigned threads,
                                const ProgressHook& progress) {
  std::vector<ReplayedRun> runs;
  runs.reserve(dataset.runs.size());
  for (const auto& run : dataset.runs)
    runs.push_back({.id = run.id, .load_kg = run.load_kg, .failure = not_begun});
  std::vector<std::size_t> by_stamps, by_ticks;
  for (std::size_t i = 0; i < runs.size(); ++i)
    (dataset.runs[i].measured ? by_stamps : by_ticks).push_back(i);
  std::atomic<std::size_t> done{0};
  const auto take = [&](std::size_t i, Recording recording) {
    runs[i] = compared(dataset.runs[i], dataset.rig, std::move(recording));
    progress("replaying", ++done, runs.size());
  };
  progress("replaying", 0, runs.size());
  try {
    simulate_all(
        by_ticks.size(), threads,
        [&](std::size_t i) { return order_of(dataset.runs[by_ticks[i]], dataset.rig); },
        [&](std::size_t i, Recording recording) { take(by_ticks[i], std::move(recording)); });
    for_each_job(
        by_stamps.size(), threads,
        [&](std::size_t i) { take(by_stamps[i], followed(dataset.runs[by_stamps[i]], dataset.rig)); },
        [](std::size_t) {});
  } catch (const Interrupted&) {  // what was not begun says so
  }
  return runs;
}

}  // namespace mckibben::run
