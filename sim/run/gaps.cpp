// Readings beside their simulation; see the header.
#include <algorithm>
#include <cmath>

#include <plant/instruments.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/remembered.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {

using domain::Measurement;

namespace {

double angle_at_rad(const domain::RigFile& rig, double contraction_ratio) {
  const double turned = contraction_ratio - rig.pair()->contraction_ratio;
  return turned * rig.muscle.rest_length_m / rig.joint.wheel_radius_m;
}

}  // namespace

double angle_rad(const domain::RigFile& rig, const Sample& row) {
  return angle_at_rad(rig, row.state.joint.contraction_ratio);
}

double counted_angle_rad(const domain::RigFile& rig, const Sample& row) {
  return static_cast<double>(row.counts) * plant::count_height_m(rig) / rig.joint.wheel_radius_m;
}

std::vector<Compared> compared(const Measurement& measured, const domain::RigFile& rig,
                               const Recording& recording) {
  std::vector<Compared> all;
  const auto add = [&](const char* reading, const char* unit, double factor,
                       const std::vector<double>& values, auto simulated) {
    if (values.empty()) return;
    all.push_back({reading, unit, [factor, &values](std::size_t k) { return factor * values[k]; },
                   [factor, &recording, simulated](std::size_t k) {
                     return factor * simulated(recording.samples[k]);
                   }});
  };
  const bool counted = measured.counted, pair = rig.pair() != nullptr;
  if (!measured.length_is_given)
    add("contraction", "1", 1.0, measured.contraction_ratio,
        [counted, per_count = contraction_per_count(rig)](const Sample& row) {
          return counted ? static_cast<double>(row.counts) * per_count : row.shown_ratio();
        });
  const double of_angle = measured.angle_in_degrees ? 1.0 / plant::degree_rad : 1.0;
  add("angle", measured.angle_in_degrees ? "deg" : "rad", of_angle, measured.angle_rad,
      [counted, &rig](const Sample& row) {
        return counted ? counted_angle_rad(rig, row) : angle_at_rad(rig, row.shown_ratio());
      });
  // A cord cannot push: a load cell on one that hangs through reads nothing.
  add("force", "N", 1.0, measured.force_N, [](const Sample& row) { return std::max(row.cord_force_N, 0.0); });
  const auto& [one, two] = measured.sides;
  if (!one.pressure_is_given)
    add(pair ? "muscle_pressure_1" : "muscle_pressure", "bar", 1.0 / plant::Pa_per_bar,
        one.muscle_pressure_Pa,
        [&rig](const Sample& row) { return rig.effects.shown_Pa(row.state.side.muscle_pressure_Pa); });
  if (!two.pressure_is_given)
    add("muscle_pressure_2", "bar", 1.0 / plant::Pa_per_bar, two.muscle_pressure_Pa,
        [effects = pair ? plant::opposite_rig(rig, *rig.pair()).effects : plant::Effects{}](
            const Sample& row) { return effects.shown_Pa(row.state.opposite.muscle_pressure_Pa); });
  return all;
}

std::vector<Gap> gaps_of(const Measurement& measured, const domain::RigFile& rig,
                         const Recording& recording) {
  std::vector<Gap> gaps;
  for (const Compared& one : compared(measured, rig, recording)) {
    Gap gap{.reading = one.reading, .unit = one.unit};
    double squares = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < recording.samples.size(); ++k) {
      if (measured.time_s[k] - measured.time_s.front() < measured.recorded.skip_s) continue;
      const double error = one.simulated(k) - one.measured(k);
      if (std::isnan(error)) continue;
      ++gap.rows;
      squares += error * error;
      sum += error;
      gap.largest = std::max(gap.largest, std::abs(error));
    }
    if (gap.rows > 0) {
      gap.rmse = std::sqrt(squares / static_cast<double>(gap.rows));
      gap.mean = sum / static_cast<double>(gap.rows);
    }
    gaps.push_back(gap);
  }
  return gaps;
}

std::vector<StampedRun> replay_stamped(const domain::Dataset& dataset, unsigned threads,
                                       const ProgressHook& progress) {
  std::vector<StampedRun> runs;
  for (const auto& run : dataset.runs)
    runs.push_back({.id = run.id, .load_kg = run.load_kg, .failure = not_begun});
  const auto replay_one = [&](std::size_t i) {
    const Measurement& measured = *dataset.runs[i].measured;
    runs[i].recording = follow_as_seen(dataset.rig, runs[i].load_kg, course_of(measured, dataset.rig),
                                       {measured.contraction_ratio, dataset.runs[i].rest_length_m,
                                        measured.time_s.front() + measured.recorded.skip_s});
    runs[i].failure = runs[i].recording.failure;
    runs[i].recording.driven.force = !measured.force_N.empty();
    if (runs[i].failure.empty()) runs[i].gaps = gaps_of(measured, dataset.rig, runs[i].recording);
  };
  for_each_result(runs.size(), threads, "replaying", progress, replay_one);
  return runs;
}

}  // namespace mckibben::run
