// Words for what the solvers report.
#include <string_view>

#include <fmt/format.h>

#include <sim/engine/sundials.hpp>

namespace mckibben::engine {

namespace {

/// Which of the domain's edges the state has come to, in words; empty if to none.
std::string edge_of_domain(const plant::Plant& rig, const plant::State<double>& state) {
  const auto leaves = [&](double ratio, double pressure_Pa) {
    plant::State<double> moved = state;
    moved.joint.contraction_ratio += ratio;
    moved.side.valve_pressure_Pa += pressure_Pa;
    moved.side.muscle_pressure_Pa += pressure_Pa;
    return !rig.in_domain(moved);
  };
  if (const std::string_view law = rig.law_without_number(state); !law.empty())
    return fmt::format("the law {} (effects.hypotheses) is not a number here", law);
  // Within a fiftieth of what lays the threads along the axis, or there within a millisecond.
  const double e = state.joint.contraction_ratio, soon = 1e-3 * state.joint.contraction_speed_per_s;
  if ((e < 0.0 && leaves(0.02 * e - 1e-4, 0.0)) || (soon < 0.0 && leaves(soon, 0.0)))
    return "the load has stretched the taut threads until they lie along the muscle: take a smaller load, a "
           "stiffer stop (muscle.stop_stiffness) or more stop_damping";
  if (leaves(std::max(1e-3, soon), 0.0))
    return "the muscle has been thrown past its shortest length: look at the load, and at how fast valve and "
           "hose fill the muscle";
  if (leaves(0.0, -500.0))
    return "a pressure has fallen to vacuum: look at how fast the load moves, and at the conductances of "
           "valve and hose";
  return "";
}

}  // namespace

std::string cause_of(Trouble trouble, const char* solver, const std::string& message, const plant::Plant& rig,
                     const plant::State<double>& state) {
  const bool explicit_method = solver == std::string_view("ERKStep");
  const std::string edge = edge_of_domain(rig, state);
  if (trouble != Trouble::too_accurate && trouble != Trouble::events && !edge.empty())
    trouble = Trouble::outside_domain;
  std::string likely;
  switch (trouble) {
    case Trouble::too_many_steps:
      likely =
          "the steps became too small for one tick; "
          "the rig is probably stiff (bristle_stiffness, braid stop, hose)";
      break;
    case Trouble::too_accurate:
      likely = "the tolerance needs more digits than double precision has - loosen it";
      break;
    case Trouble::error_test:
      likely =
          "no step was small enough to pass the error test; "
          "a law of the rig probably jumps here, or is very stiff";
      break;
    case Trouble::outside_domain:
      likely = "the state left the range in which the rig's laws are defined - " +
               (edge.empty() ? "it is not a number: look at the rig's values and the load" : edge);
      break;
    case Trouble::convergence:
      likely = "Newton's iteration did not converge - try method: erk, or a tighter tolerance";
      break;
    case Trouble::events:
      likely = "stick and slip changed more than a thousand times in one tick - use memory: lugre";
      break;
    case Trouble::other:
      likely = "this is not expected of a checked rig; please report it";
      break;
  }
  if (trouble == Trouble::too_many_steps || trouble == Trouble::error_test)
    likely += explicit_method ? " - try method: cvode, or a looser tolerance" : " - try a looser tolerance";
  return fmt::format("{}: {}{}", solver, likely, message.empty() ? "" : " [" + message + "]");
}

void keep_message(int code, const char*, const char*, char* message, void* text) {
  if (code < 0) *static_cast<std::string*>(text) = message;
}

}  // namespace mckibben::engine
