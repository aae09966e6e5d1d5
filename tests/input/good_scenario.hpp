// A scenario that uses every kind of field, for tests that read, write and mutilate it.
#pragma once

#include <string>
#include <vector>

#include <sim/input/scenario_file.hpp>

namespace mckibben::input {

inline const std::string good_scenario = R"(schema: mckibben-scenario/1
name: five_loads   # a comment
rig:
  base: thesis
  muscle: {rest_length: 30 cm, braid_angle: 21 deg}
  friction: {law: area, memory: coulomb}
  gauge: {fitted: true, resolution: 10 mbar}
  gas:
    temperature: 18.5 degC
  integrator: {method: cvode, tolerance: 1e-9}
loads: [11.138 kg, 13870 g]
target:
  kind: minimum_jerk
  start: 0.02
  moves:
    - {at: 1 s, lasting: 2 s, to: 30 mm}
    - {at: 4 s, lasting: 1999 ms, to: 0.05}
duration: 10 s
controllers:
  - kind: pid
    name: pid_fast
    proportional: 100.1 mA
    integral_time: 2 s
    tuning_load: 14 kg
  - {kind: static_inverse, assumed_load: 12 kg, braid_angle: 21 deg}
  - {kind: triangle_current, low: 0 mA, high: 20 mA, speed: 5.6 mA/s}
  - {kind: step_current, moves: [{at: 1 s, to: 12 mA}, {at: 2 s, to: 4 mA}]}
noise: {encoder_jitter: 5e-5, gauge: 4 mbar, current: 0.01 mA}
seed: 18446744073709551615
criteria:
  - {controller: pid_fast, rmse_below: 0.01}
  - {spread_below: 5 %}
)";

inline Scenario read_text(const std::string& text, std::vector<Problem>* warnings = nullptr) {
  std::vector<Problem> ignored;
  return read_scenario(Source("test.yaml", text, ""), warnings != nullptr ? *warnings : ignored);
}

}  // namespace mckibben::input
