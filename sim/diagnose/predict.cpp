// Simulation of recorded runs; the order of things within a tick is that of the tick loop (sim/run).
#include <cmath>

#include <plant/plant.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/engine/flock.hpp>

namespace mckibben::diagnose {

std::vector<Readings> predict(const input::Run& run, std::span<const Hanging> rigs) {
  const plant::Rig& first = rigs.front().rig;
  const std::size_t rows = run.current_mA.size(), lanes = rigs.size();
  std::vector<plant::Plant> plants;
  for (const Hanging& hanging : rigs) plants.emplace_back(hanging.rig, hanging.load_kg);
  const auto flock = engine::make_flock(plants, tolerance);
  std::vector<engine::Flow> flows(lanes);
  std::vector<plant::Held> held(lanes);
  std::vector<plant::Effects::Plays> plays(lanes);
  std::vector<Readings> readings(lanes);
  double current_mA = run.current_mA.front();

  const auto hold = [&](double next_mA, bool moving) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const auto& effects = plants[i].rig().effects;
      held[i].reference_pressure_Pa =
          effects.reference_Pa(plants[i].reference_pressure_Pa(next_mA), plays[i]);
      held[i].current_speed_mA_per_s = moving ? (next_mA - current_mA) / first.tick_s : 0.0;
    }
    current_mA = next_mA;
  };
  const auto read = [&](std::size_t i) {
    const double length_m = plants[i].rig().muscle.rest_length_m;
    return plants[i].rig().effects.wheel_m(length_m * flows[i].state.joint.contraction_ratio, plays[i]) /
           length_m;
  };

  for (std::size_t i = 0; i < lanes; ++i) {
    readings[i].contraction_ratio.reserve(rows);
    readings[i].pressure_Pa.reserve(rows);
    plants[i].rig().effects.wheel_m(0.0, plays[i]);
  }
  hold(current_mA, false);
  for (std::size_t i = 0; i < lanes; ++i) flows[i].state = plants[i].at_rest(held[i]);
  const long settling = std::lround(first.settling_time_s / first.tick_s);
  for (long k = -settling; k < static_cast<long>(rows); ++k) {
    if (k >= 0) {
      const auto row = static_cast<std::size_t>(k);
      for (std::size_t i = 0; i < lanes; ++i) {
        readings[i].contraction_ratio.push_back(read(i));
        readings[i].pressure_Pa.push_back(flows[i].state.side.muscle_pressure_Pa);
      }
      readings[0].states.push_back(flows[0].state);
      hold(run.current_mA[row], true);
    } else if (k > -settling) {
      for (std::size_t i = 0; i < lanes; ++i) read(i);
    }
    if (k + 1 < static_cast<long>(rows))
      flock->advance(flows, held, static_cast<double>(k) * first.tick_s,
                     static_cast<double>(k + 1) * first.tick_s);
  }
  return readings;
}

}  // namespace mckibben::diagnose
