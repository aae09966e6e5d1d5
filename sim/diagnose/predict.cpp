// A recorded current drives a ride; see the header.
#include <cmath>

#include <sim/diagnose/predict.hpp>

namespace mckibben::diagnose {

solver::Settings settings_for(std::span<const Hanging> rigs, solver::Method method) {
  return {method, ride::can_share_steps(rigs, method) ? tolerance : tolerance_alone};
}

std::vector<Readings> predict(const domain::Run& run, std::span<const Hanging> rigs, solver::Method method) {
  const plant::Rig& first = rigs.front().rig;
  const std::size_t rows = run.current_mA.size();
  const auto time_s = [&](long k) { return static_cast<double>(k) * first.tick_s; };
  std::vector<Readings> readings(rigs.size());
  for (Readings& list : readings) {
    list.contraction_ratio.reserve(rows);
    list.pressure_Pa.reserve(rows);
  }

  ride::Ride ride(rigs, settings_for(rigs, method));
  ride::Drive drive;
  drive.current_mA = run.current_mA.front();
  const long settling = std::lround(first.settling_time_s / first.tick_s);
  ride.start(drive, time_s(-settling));
  for (long k = -settling; k < 0; ++k) ride.step(drive, time_s(k + 1));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      const ride::Reading& seen = ride.reading(i);
      readings[i].contraction_ratio.push_back(seen.wheel_m / rigs[i].rig.muscle.rest_length_m);
      readings[i].pressure_Pa.push_back(seen.muscle_pressure_Pa);
    }
    readings[0].states.push_back(ride.flow().state);
    drive.current_mA = run.current_mA[row];
    if (row + 1 < rows) ride.step(drive, time_s(static_cast<long>(row) + 1));
  }
  return readings;
}

}  // namespace mckibben::diagnose
