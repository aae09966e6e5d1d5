// Measuring: every used row once with the pressure from the current, once with the muscle's own.
#include <sim/run/simulate.hpp>
#include <sim/study/lag.hpp>

namespace mckibben::study {
namespace {

using thesis::Direction;

/// T 4.2 with T 4.1, as the calibration has it.
double coefficient(const Row& row, double pressure_Pa) {
  const double weight_N = row.load_kg * (row.counted.acceleration_m_per_s2 + plant::gravity_m_per_s2);
  return row.up() * (row.generated_N_per_Pa * pressure_Pa - weight_N) / (row.surface_m2 * pressure_Pa);
}

double weighed(const Row& row, double pressure_Pa, double friction_N) {
  return weighed_kg(row.generated_N_per_Pa * pressure_Pa, friction_N, row.counted.acceleration_m_per_s2);
}

double friction_N(const Row& row, double pressure_Pa, const controllers::FrictionModel& model) {
  return model.coefficient(row.contraction_ratio, row.speed_mA_per_s) * row.surface_m2 * pressure_Pa;
}

LagAtSpeed at_speed(const Evidence& evidence, Direction direction, double speed) {
  const double slope_Pa_per_mA = run::knowledge_of(evidence.campaign.rig, {}).valve.slope_Pa_per_mA();
  LagAtSpeed at;
  at.speed_mA_per_s = speed;
  double along = 0.0, squares = 0.0;
  for (const Row& row : evidence.rows) {
    if (row.direction != direction || row.speed_mA_per_s != speed) continue;
    const double shift_Pa = row.line_Pa - row.muscle_Pa, rate = slope_Pa_per_mA * row.slope_mA_per_s;
    at.shift_Pa.add(shift_Pa);
    along += shift_Pa * rate;
    squares += rate * rate;
    at.from_current.add(coefficient(row, row.line_Pa));
    at.from_gauge.add(coefficient(row, row.muscle_Pa));
    at.truly.add(row.friction_N / (row.surface_m2 * row.muscle_Pa));
  }
  at.lag_s = along / squares;
  return at;
}

}  // namespace

Lag measure_lag(const Evidence& evidence) {
  Lag lag;
  for (const Direction direction : thesis::directions)
    for (const double speed : evidence.from_current.grid.speeds_mA_per_s)
      lag.speeds[static_cast<std::size_t>(direction)].push_back(at_speed(evidence, direction, speed));
  const auto& by_current = evidence.from_current.calibration.contraction_friction;
  const auto& by_gauge = evidence.from_gauge.calibration.contraction_friction;
  for (const Row& row : evidence.rows) {
    if (row.direction != Direction::contraction) continue;
    for (Weighed* each : {&lag.weighed[row.load_kg], &lag.weighed_all}) {
      each->from_current.add(weighed(row, row.line_Pa, friction_N(row, row.line_Pa, by_current)) -
                             row.load_kg);
      each->from_gauge.add(weighed(row, row.muscle_Pa, friction_N(row, row.muscle_Pa, by_gauge)) -
                           row.load_kg);
      each->true_friction.add(weighed(row, row.line_Pa, row.friction_N) - row.load_kg);
    }
  }
  return lag;
}

}  // namespace mckibben::study
