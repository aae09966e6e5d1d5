// A ride in real time; see the header.
#include <utility>

#include <sim/bench/simulated.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::bench {

Simulated::Simulated(const plant::Rig& rig, double load_kg, const solver::Settings& integrator,
                     double current_mA)
    : ride_(ride::Loaded{rig, load_kg}, integrator), counter_(rig) {
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
  move_on(now_s);
  return counter_.count(ride_.reading().wheel_m);
}

void Simulated::put(double current_mA, double now_s) {
  if (was_put_) move_on(now_s);
  drive_.current_mA = current_mA;
  if (std::exchange(was_put_, true)) return;
  begun_ = false;
  move_on(now_s);
}

}  // namespace mckibben::bench
