// What drove a run drives a ride; see the header.
#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::diagnose {

solver::Settings settings_for(std::span<const Hanging> rigs, solver::Method method) {
  return {method, ride::can_share_steps(rigs, method) ? thresholds.predict.tolerance
                                                      : thresholds.predict.tolerance_alone};
}

std::vector<Readings> predict(const domain::Run& run, std::span<const Hanging> rigs, solver::Method method,
                              std::span<const double> memories) {
  const plant::Rig& first = rigs.front().rig;
  const run::Course course = run::course_of(run, first);
  std::vector<Readings> readings(rigs.size());
  for (Readings& list : readings) {
    list.judged.reserve(course.rows.size());
    list.pressure_Pa.reserve(course.rows.size());
  }
  const auto length_m = [&](std::size_t i) {
    return run.rest_length_m > 0.0 ? run.rest_length_m : rigs[i].rig.muscle.rest_length_m;
  };

  ride::Ride ride(rigs, settings_for(rigs, method));
  const auto force_N = [&](std::size_t i) { return ride.moment(i).cord_force_N(); };
  run::for_first_stamp(ride, course, first, memories);
  for (std::size_t k = 0, row = 0; row < course.rows.size(); ++k) {
    ride.hold(course.toward(k), course.until_s(k, first.tick_s));  // forces are those of the way ahead
    if (course.rows[row] == k) {
      for (std::size_t i = 0; i < rigs.size(); ++i) {
        const ride::Reading& seen = ride.reading(i);
        readings[i].judged.push_back(run.length_is_given() ? force_N(i) : seen.wheel_m / length_m(i));
        readings[i].pressure_Pa.push_back(seen.muscle_pressure_Pa);
      }
      readings[0].states.push_back(ride.flow().state);
      ++row;
    }
    if (row < course.rows.size()) ride.advance();
  }
  return readings;
}

}  // namespace mckibben::diagnose
