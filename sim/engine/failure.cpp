// Words for a numerical failure.
#include <fmt/format.h>

#include <sim/engine/failure.hpp>

namespace mckibben::engine {

NumericalFailure::NumericalFailure(double at_s, const plant::State<double>& where, const std::string& why)
    : std::runtime_error(fmt::format(
          "integration failed at t = {:.6g} s{}: {}\n"
          "  state: contraction_ratio = {:.9g}, contraction_speed = {:.6g} 1/s, valve_pressure = {:.6g} bar, "
          "muscle_pressure = {:.6g} bar, bristle = {:.6g} m",
          at_s, at_s < 0.0 ? " (settling)" : "", why, where.joint.contraction_ratio,
          where.joint.contraction_speed_per_s, where.side.valve_pressure_Pa / 1e5,
          where.side.muscle_pressure_Pa / 1e5, where.side.bristle_m)),
      time_s(at_s),
      state(where),
      cause(why) {}

}  // namespace mckibben::engine
