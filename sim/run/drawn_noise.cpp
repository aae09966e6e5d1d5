// See the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <sim/run/drawn_noise.hpp>

namespace mckibben::run {
namespace {

using plant::Sensed;

/// By data sheets and what else there is, in units of the readings; of the position as contraction ratio.
plant::BySensed noise_of_sensors(const plant::Noise& noise, const plant::Rig& rig) {
  plant::BySensed sizes;
  for (const plant::Sensor& sensor : rig.sensors) sizes[sensor.signal] = sensor.noise;
  sizes[Sensed::contraction] = std::hypot(noise.encoder_jitter, position_noise(rig));
  sizes[Sensed::muscle_pressure] = std::hypot(noise.gauge_Pa, sizes[Sensed::muscle_pressure]);
  return sizes;
}

}  // namespace

double position_noise(const plant::Rig& rig) {
  const plant::Sensor& position = rig.sensors.position();
  return position.noise * position.rise_m(rig.joint.wheel_radius_m) / rig.muscle.rest_length_m;
}

DrawnNoise::DrawnNoise(const plant::Noise& noise, const plant::Rig& rig, std::uint64_t seed,
                       std::uint64_t stream)
    : noise_(noise),
      of_sensors_(noise_of_sensors(noise, rig)),
      is_none_(noise_.current_mA == 0.0 && noise_.wander_Pa == 0.0 &&
               std::ranges::all_of(of_sensors_.values, [](double size) { return size == 0.0; })),
      kept_(std::exp(-rig.tick_s / noise_.wander_time_s)) {
  std::seed_seq sequence{seed & 0xffffffffu, seed >> 32, stream & 0xffffffffu, stream >> 32};
  random_.seed(sequence);
  if (noise_.ripple_Pa > 0.0) phase_ = std::uniform_real_distribution(0.0, 2.0 * std::numbers::pi)(random_);
  if (noise_.wander_Pa > 0.0) wander_ = draw();
}

double DrawnNoise::reference_Pa(double time_s) {
  double sum_Pa = 0.0;
  if (noise_.ripple_Pa > 0.0)
    sum_Pa += noise_.ripple_Pa * std::sin(2.0 * std::numbers::pi * time_s / noise_.ripple_period_s + phase_);
  if (noise_.wander_Pa > 0.0) {
    sum_Pa += noise_.wander_Pa * wander_;
    wander_ = kept_ * wander_ + std::sqrt(1.0 - kept_ * kept_) * draw();  // exact over a tick
  }
  return sum_Pa;
}

}  // namespace mckibben::run
