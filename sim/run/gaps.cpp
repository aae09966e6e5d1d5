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
  const bool counted = measured.counted, pair = rig.pair() != nullptr;
  const auto add = [&](std::string_view signal, std::size_t muscle, const std::vector<double>& values,
                       auto simulated) {
    if (values.empty()) return;
    const plant::Channel channel{&plant::signal_of(signal), muscle};
    const bool degrees = measured.angle_in_degrees && signal == "angle";
    const double factor = 1.0 / (degrees ? plant::degree_rad : channel.signal->unit.size);
    all.push_back({channel.key_in_dataset(), degrees ? "deg" : std::string(channel.signal->unit.name),
                   [factor, &values](std::size_t k) { return factor * values[k]; },
                   [factor, &recording, simulated](std::size_t k) {
                     return factor * simulated(recording.samples[k]);
                   }});
  };
  if (!measured.length_is_given)
    add("contraction_ratio", 0, measured.contraction_ratio,
        [counted](const Sample& row) { return counted ? row.read_ratio : row.shown_ratio(); });
  add("angle", 0, measured.angle_rad, [counted, &rig](const Sample& row) {
    return counted ? row.read_angle_rad : angle_at_rad(rig, row.shown_ratio());
  });
  // A cord cannot push: a load cell on one that hangs through reads nothing.
  add("force", 0, measured.force_N, [](const Sample& row) { return std::max(row.cord_force_N, 0.0); });
  for (std::size_t muscle = 1; muscle <= (pair ? 2 : 1); ++muscle) {
    const auto& side = measured.sides[muscle - 1];
    if (!side.pressure_is_given)
      add("muscle_pressure", pair ? muscle : 0, side.muscle_pressure_Pa,
          [muscle, effects = muscle == 2 ? rig.pair()->opposite.effects : rig.effects](const Sample& row) {
            return effects.shown_Pa(row.side_state(muscle).muscle_pressure_Pa);
          });
  }
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
