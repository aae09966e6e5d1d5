// A plant and an integrator, driven by hand; shared by the tests of this room.
#pragma once

#include <memory>

#include <plant/plant.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

class RigOnBench {
 public:
  RigOnBench(const plant::Rig& rig, double load_kg, Settings settings, bool keep_ledger = false)
      : plant(plant::plant_of(rig, load_kg)), integrator(make_integrator(plant, settings, keep_ledger)) {}

  void start(double current_mA) {
    held.reference_pressure_Pa = plant.reference_pressure_Pa(current_mA);
    flow.state = plant.at_rest(held);
    flow.ledger = plant.opened(flow.state);
    if (plant.has_events()) held.slip = plant.slip_from_rest(flow.state, flow.memory, held);
  }

  /// Holds a current for some ticks.
  void hold(double current_mA, int ticks = 1) {
    held.reference_pressure_Pa = plant.reference_pressure_Pa(current_mA);
    for (int i = 0; i < ticks; ++i, ++tick) integrator->advance(flow, held, 0.012 * tick, 0.012 * (tick + 1));
  }

  plant::Plant plant;
  std::unique_ptr<Integrator> integrator;
  Flow flow;
  plant::Held held;
  int tick = 0;
};

}  // namespace mckibben::engine
