// Replay; see the header.
#include <algorithm>
#include <cmath>

#include <controllers/waveform.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/remembered.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

Recording recording_of(const domain::Run& measured, const domain::RigFile& rig) {
  if (measured.measured)
    return follow_as_seen(
        rig, measured.load_kg, course_of(*measured.measured, rig),
        {measured.contraction_ratio, measured.rest_length_m, measured.measured->time_s.front()});
  controllers::RecordedCurrent recorded;
  recorded.samples_mA = measured.current_mA;
  const auto controller = recorded.make(knowledge_of(rig, {}));
  return simulate({.rig = rig,
                   .load_kg = measured.load_kg,
                   .ticks = measured.current_mA.size(),
                   .engine = rig.integrator,
                   .keep_ledger = true},
                  *controller);
}

/// What a row of the measurement would read: counts, or where its rows were made of stamps the load's place,
/// the joint's angle, or the cord's force.
double read_of(const Sample& sample, const domain::Run& measured, const domain::RigFile& rig) {
  if (measured.kind_of_judged() == domain::Judged::angle) return angle_rad(rig, sample);
  if (measured.kind_of_judged() == domain::Judged::force) return sample.cord_force_N;
  if (!measured.measured) return static_cast<double>(sample.counts) * contraction_per_count(rig);
  return sample.shown_ratio() * rig.muscle.rest_length_m / measured.rest_length_m;
}

ReplayedRun replay_one(const domain::Run& measured, const domain::RigFile& rig) {
  ReplayedRun run{.id = measured.id, .load_kg = measured.load_kg};
  run.recording = recording_of(measured, rig);
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
  for_each_result(runs.size(), threads, "replaying", progress,
                  [&](std::size_t i) { runs[i] = replay_one(dataset.runs[i], dataset.rig); });
  return runs;
}

}  // namespace mckibben::run
