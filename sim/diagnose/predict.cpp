// What drove a run drives a ride; see the header.
#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::diagnose {

solver::Settings settings_for(std::span<const Hanging> rigs, solver::Method method) {
  return {method, ride::can_share_steps(rigs, method) ? thresholds.predict.tolerance
                                                      : thresholds.predict.tolerance_alone};
}

std::vector<Readings> predict(const domain::Run& run, std::span<const Hanging> rigs, solver::Method method) {
  const plant::Rig& first = rigs.front().rig;
  const run::Course course = run::course_of(run, first);
  std::vector<Readings> readings(rigs.size());
  for (Readings& list : readings) {
    list.contraction_ratio.reserve(course.rows.size());
    list.pressure_Pa.reserve(course.rows.size());
  }
  const auto length_m = [&](std::size_t i) {
    return run.rest_length_m > 0.0 ? run.rest_length_m : rigs[i].rig.muscle.rest_length_m;
  };

  ride::Ride ride(rigs, settings_for(rigs, method));
  run::for_first_stamp(ride, course, first);
  for (std::size_t k = 0, row = 0; row < course.rows.size(); ++k) {
    if (course.rows[row] == k) {
      for (std::size_t i = 0; i < rigs.size(); ++i) {
        const ride::Reading& seen = ride.reading(i);
        readings[i].contraction_ratio.push_back(seen.wheel_m / length_m(i));
        readings[i].pressure_Pa.push_back(seen.muscle_pressure_Pa);
      }
      readings[0].states.push_back(ride.flow().state);
      ++row;
    }
    if (row < course.rows.size()) ride.step(course.toward(k), course.time_s[k + 1]);
  }
  return readings;
}

}  // namespace mckibben::diagnose
