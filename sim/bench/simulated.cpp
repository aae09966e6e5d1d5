// A ride in real time; see the header.
#include <utility>

#include <sim/bench/simulated.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::bench {

Simulated::Simulated(const plant::Rig& rig, double load_kg, const solver::Settings& integrator,
                     double current_mA, const plant::Noise& noise, std::uint64_t seed)
    : ride_(ride::Loaded{rig, load_kg}, integrator),
      sensor_(rig.sensors.position()),
      counter_(rig),
      noise_(noise, rig, seed, 0) {
  drive_.current_mA = current_mA;
}

void Simulated::move_on(double now_s) {
  constexpr double nothing_s = 1e-9;
  try {
    if (!std::exchange(begun_, true)) ride_.start(drive_, now_s);
    if (now_s - ride_.time_s() < nothing_s) return;
    ride_.step(drive_, now_s);
  } catch (const engine::NumericalFailure& failure) {
    throw DeviceFailure(failure.what());
  }
}

std::int64_t Simulated::counts(double now_s) {
  const bool first = !begun_;
  move_on(now_s);
  const double noise_m = noise_.of(plant::Sensed::contraction) * ride_.plant().rig().muscle.rest_length_m;
  if (first || sensor_.taken_s(now_s) != sensor_.taken_s(read_s_))  // else it shows the one before
    counts_ = counter_.count(ride_.reading().wheel_m + noise_m);
  read_s_ = now_s;
  return counts_;
}

void Simulated::put(double current_mA, double now_s) {
  if (was_put_) move_on(now_s);
  drive_.current_mA = current_mA;
  drive_.stray_current_mA = noise_.current_mA();
  drive_.stray_pressure_Pa = noise_.reference_Pa(now_s);
  if (std::exchange(was_put_, true)) return;
  begun_ = false;
  move_on(now_s);
}

}  // namespace mckibben::bench
