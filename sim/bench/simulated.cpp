// A ride in real time; see the header.
#include <utility>

#include <sim/bench/simulated.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::bench {

namespace {

/// Or it shows the reading that it showed before.
bool takes_a_reading(const plant::Sensor& sensor, double now_s, double before_s) {
  return sensor.taken_s(now_s) != sensor.taken_s(before_s);  // NaN, before the first, equals nothing
}

}  // namespace

Simulated::Simulated(const plant::Rig& rig, double load_kg, const solver::Settings& integrator,
                     double current_mA, const plant::Noise& noise, std::uint64_t seed)
    : ride_(ride::Loaded{rig, load_kg}, integrator), counter_(rig), noise_(noise, rig, seed, 0) {
  drive_.current_mA = current_mA;
}

void Simulated::move_on(double now_s) {
  constexpr double nothing_s = 1e-9;
  try {
    if (!was_put_)
      ride_.start(drive_, now_s);
    else if (now_s - ride_.time_s() >= nothing_s)
      ride_.step(drive_, now_s);
  } catch (const engine::NumericalFailure& failure) {
    throw DeviceFailure(failure.what());
  }
}

std::int64_t Simulated::counts(double now_s) {
  move_on(now_s);
  const double noise_m = noise_.of(plant::Sensed::contraction) * rig().muscle.rest_length_m;
  if (takes_a_reading(rig().sensors.position(), now_s, std::exchange(counted_s_, now_s)))
    counts_ = counter_.count(ride_.reading().wheel_m + noise_m);
  return counts_;
}

double Simulated::gauge_Pa(double now_s) {
  if (!has_gauge()) return none;
  move_on(now_s);
  const double noise_Pa = noise_.of(plant::Sensed::muscle_pressure);
  if (takes_a_reading(*gauge(), now_s, std::exchange(gauged_s_, now_s)))
    gauge_Pa_ = plant::shown(gauge(), ride_.reading().of(plant::Sensed::muscle_pressure) + noise_Pa);
  return gauge_Pa_;
}

void Simulated::put(double current_mA, double now_s) {
  if (was_put_) move_on(now_s);
  drive_.current_mA = current_mA;
  drive_.stray_current_mA = noise_.current_mA();
  drive_.stray_pressure_Pa = noise_.reference_Pa(now_s);
  if (was_put_) return;
  move_on(now_s);
  was_put_ = true;
}

}  // namespace mckibben::bench
