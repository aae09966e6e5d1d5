// A law that a user wrote (sim/law reads it): a short program in postfix order over a stack of numbers,
// evaluated for any kind of number S: double, a dual number, or lanes. Choices are selects, so that all lanes
// go one way; nothing here allocates or looks up a name. What a law sees and adds to: docs/hypotheses.md.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/choose.hpp>

namespace mckibben::plant {

/// What a law may be about: of the muscle it acts on, at this instant.
enum class LawInput { ratio, rise, speed, pressure, valve_pressure, braid_force, load, command, time };
inline constexpr std::size_t law_inputs = static_cast<std::size_t>(LawInput::time) + 1;

/// Which quantity a law adds to: force on the load, upwards [N]; the factor of the friction level [1]; gas
/// that leaves the muscle [kg/s]; the pressure that the valve follows [Pa]; the rise that is read [m].
enum class LawTarget { force, friction_factor, outflow, command, reading };
constexpr auto names(LawTarget) {
  using enum LawTarget;
  return std::array{std::pair{force, std::string_view{"force"}},
                    std::pair{friction_factor, std::string_view{"friction_factor"}},
                    std::pair{outflow, std::string_view{"outflow"}},
                    std::pair{command, std::string_view{"command"}},
                    std::pair{reading, std::string_view{"reading"}}};
}

/// Where a force pulls: at the muscle, so that its cord carries it; or at the load or the joint, beyond the
/// cord.
enum class LawPlace { side, joint };
constexpr auto names(LawPlace) {
  using enum LawPlace;
  return std::array{std::pair{side, std::string_view{"side"}}, std::pair{joint, std::string_view{"joint"}}};
}

enum class LawOperation : std::uint8_t {
  constant,
  input,
  parameter,
  memory,
  add,
  subtract,
  multiply,
  divide,
  power,               // to a constant exponent
  power_of_parameter,  // to a parameter's
  negate,
  minimum,
  maximum,
  absolute,
  tanh,
  exp,
  log,
  sqrt,
  sin,
  cos,
  less,        // 1 or 0
  less_equal,  // 1 or 0
  choose       // of condition, then, else
};

struct LawStep {
  LawOperation operation{};
  std::uint8_t index = 0;  ///< of an input, a parameter, a memory
  double number = 0.0;     ///< a constant, an exponent

  bool operator==(const LawStep&) const = default;
};

/// Limits that keep a law as quick as one that is compiled.
inline constexpr std::size_t most_law_parameters = 6, most_law_memories = 12, most_law_steps = 64,
                             deepest_law_stack = 16;
/// Of a rig's side: laws at work, laws in its file, and how many numbers those at work remember together,
/// with the time.
inline constexpr std::size_t most_laws = 4, most_written_laws = 16, law_slots = most_law_memories + 1;

using LawProgram = std::vector<LawStep>;

/// A law as it is written, with its programs.
struct LawText {
  struct Parameter {
    std::string name, unit;                             ///< the unit is that of SI
    double typical = 0.0, lowest = 0.0, highest = 0.0;  ///< SI

    bool operator==(const Parameter&) const = default;
  };
  struct Memory {
    std::string name, rate, unit;  ///< its rate as written; its SI unit
    double size = 1.0;             ///< SI: what integrators carry is the memory in this
    LawProgram program;            ///< of d(memory)/dt [SI]

    bool operator==(const Memory&) const = default;
  };

  std::string name, sentence;
  LawTarget adds = LawTarget::force;
  LawPlace at = LawPlace::side;
  std::string law;
  std::vector<Parameter> parameters;  ///< the first is the size: at 0 the law adds nothing
  std::vector<Memory> memories;
  LawProgram program;
  bool knows_time = false;  ///< the law or a memory is about t

  /// How many numbers integrators carry for it: its memories, and the time.
  std::size_t slots() const { return memories.size() + (knows_time ? 1 : 0); }
  bool operator==(const LawText&) const = default;
};

/// What a program is run on. S is made of numbers, P of parameters.
template <class S, class P>
struct LawNumbers {
  std::array<S, law_inputs> inputs;
  const std::array<P, most_law_parameters>& parameters;
  std::array<S, most_law_memories> memories;
};

/// The value of a program. Not inlined: it would be compiled into each law of each kind of rig.
template <class S, class P>
[[gnu::noinline]] S value_of(const LawProgram& program, const LawNumbers<S, P>& known) {
  using std::abs;
  using std::cos;
  using std::exp;
  using std::log;
  using std::pow;
  using std::sin;
  using std::sqrt;
  using std::tanh;
  std::array<S, deepest_law_stack> stack;
  std::size_t top = 0;  // one above the last
  for (const LawStep& step : program) {
    const auto last = [&]() -> S& { return stack[top - 1]; };
    const auto two = [&](const auto& f) {
      --top;
      stack[top - 1] = f(stack[top - 1], stack[top]);
    };
    // At 0 the slope of a root is infinite: there it counts as level.
    const auto raised = [&](const P& exponent) {
      constexpr double endless = std::numeric_limits<double>::infinity();
      const P at_zero = select(exponent > 0.0, P(0.0), select(exponent == 0.0, P(1.0), P(endless)));
      last() = select((last() == 0.0) && (exponent < 1.0), S(at_zero), S(pow(last(), exponent)));
    };
    switch (step.operation) {
      case LawOperation::constant:
        stack[top++] = S(step.number);
        break;
      case LawOperation::input:
        stack[top++] = known.inputs[step.index];
        break;
      case LawOperation::parameter:
        stack[top++] = S(known.parameters[step.index]);
        break;
      case LawOperation::memory:
        stack[top++] = known.memories[step.index];
        break;
      case LawOperation::add:
        two([](const S& a, const S& b) { return S(a + b); });
        break;
      case LawOperation::subtract:
        two([](const S& a, const S& b) { return S(a - b); });
        break;
      case LawOperation::multiply:
        two([](const S& a, const S& b) { return S(a * b); });
        break;
      case LawOperation::divide:
        two([](const S& a, const S& b) { return S(a / b); });
        break;
      case LawOperation::power:
        raised(P(step.number));
        break;
      case LawOperation::power_of_parameter:
        raised(known.parameters[step.index]);
        break;
      case LawOperation::negate:
        last() = -last();
        break;
      case LawOperation::minimum:
        two([](const S& a, const S& b) { return select(b < a, b, a); });
        break;
      case LawOperation::maximum:
        two([](const S& a, const S& b) { return select(a < b, b, a); });
        break;
      case LawOperation::absolute:
        last() = abs(last());
        break;
      case LawOperation::tanh:
        last() = tanh(last());
        break;
      case LawOperation::exp:
        last() = exp(last());
        break;
      case LawOperation::log:
        last() = log(last());
        break;
      case LawOperation::sqrt:
        last() = select(last() == 0.0, S(0.0), S(sqrt(last())));
        break;
      case LawOperation::sin:
        last() = sin(last());
        break;
      case LawOperation::cos:
        last() = cos(last());
        break;
      case LawOperation::less:
        two([](const S& a, const S& b) { return select(a < b, S(1.0), S(0.0)); });
        break;
      case LawOperation::less_equal:
        two([](const S& a, const S& b) { return select(a <= b, S(1.0), S(0.0)); });
        break;
      case LawOperation::choose:
        top -= 2;
        stack[top - 1] = select(stack[top - 1] > 0.5, stack[top], stack[top + 1]);
        break;
    }
  }
  return stack[0];
}

}  // namespace mckibben::plant
