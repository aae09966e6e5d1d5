// A random rig under a random current, known by its seed; shared by tests and benchmark.
#pragma once

#include <algorithm>

#include <controllers/waveform.hpp>
#include <sim/run/simulate.hpp>

#include "random_rigs.hpp"

namespace mckibben::run {

struct RandomRide {
  RunPlan plan;
  controllers::RecordedCurrent current;

  RandomRide(unsigned seed, bool whole_range) {
    plant::Chance chance(seed);
    const auto [rig, load_kg] = plant::random_rig(chance, whole_range);
    plan.rig = rig;
    plan.load_kg = load_kg;
    plan.ticks = static_cast<std::size_t>(std::clamp(5.0 / rig.tick_s, 50.0, 600.0));
    plan.keep_ledger = true;
    current.samples_mA = plant::random_current(chance, plan.ticks, rig.dac.largest_command);
    plant::draw_cord(chance, plan.rig.muscle, rig.friction.memory);
  }
};

inline Recording random_ride(unsigned seed, bool whole_range, solver::Method method) {
  RandomRide ride(seed, whole_range);
  ride.plan.rig.integrator.method = method;
  return simulate(ride.plan, *ride.current.make(knowledge_of(ride.plan.rig, {})));
}

}  // namespace mckibben::run
