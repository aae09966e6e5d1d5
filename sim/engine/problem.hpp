// What an integrator sees: a right-hand side over a fixed number of components, frozen between ticks. First
// the plant's state, with one muscle or two; then what their effects remember, if one does; then the ledger,
// if it is kept, which never steers the steps, so that a run with
// and without it takes the same steps bit for bit.
#pragma once

#include <array>
#include <cstring>

#include <plant/plant.hpp>

namespace mckibben::engine {

/// State, memory and ledger as they stand at one instant.
struct Flow {
  plant::State<double> state{};
  plant::Memory<double> memory{};
  plant::Ledger<double> ledger{};
};

/// Working size of each state: an error of tolerance times this may be made in a step.
inline constexpr std::array<double, plant::pair_size> working_size{0.3, 1.0, 5e5, 5e5, 1e-4, 5e5, 5e5, 1e-4};

/// How much of the ledger is kept: nothing, what isothermal gas needs, or all.
enum class Books { none, isothermal, polytropic };

/// Memories that the error norm counts, of each side, however many the table of effects has.
inline constexpr int counted_memories = 5;

/// Which components there are.
template <int sides_, plant::Memories memories_, Books books_>
struct Layout {
  static constexpr int sides = sides_;
  static constexpr int of_side = plant::carried(memories_);  ///< memories
  static constexpr bool remembers = of_side > 0, audits = books_ != Books::none;
  static constexpr int states = sides == 1 ? plant::single_size : plant::pair_size;
  static constexpr int memories = sides * of_side;
  static constexpr int steering = states + memories;
  /// What the error norm is a mean over: a number that a further effect does not change, so that rigs without
  /// it are integrated in the same steps.
  static constexpr int counted = states + (remembers ? sides * counted_memories : 0);
  static constexpr int entries = books_ == Books::none         ? 0
                                 : books_ == Books::isothermal ? plant::isothermal_ledger_size
                                                               : plant::ledger_size;
  static constexpr int size = steering + entries;
  static constexpr std::size_t state_bytes = states * sizeof(double), memory_bytes = of_side * sizeof(double),
                               ledger_bytes = entries * sizeof(double);
};

/// Working size of a component that steers the steps.
template <class L>
constexpr double size_of(int component) {
  if (component < L::states) return working_size[static_cast<std::size_t>(component)];
  return plant::memory_sizes[static_cast<std::size_t>((component - L::states) % L::of_side)];
}

template <class L>
class Problem {
 public:
  static constexpr int size = L::size;

  explicit Problem(const plant::Plant& rig) : plant_(rig) {}

  const plant::Plant& plant() const { return plant_; }
  plant::Held held;
  long refused = 0;  ///< trial states outside the domain of the laws, in this tick

  static plant::State<double> state_of(const double* y) {
    plant::State<double> state;
    state.joint = {y[0], y[1]};
    state.side = {y[2], y[3], y[4]};
    if constexpr (L::sides == 2) state.opposite = {y[5], y[6], y[7]};
    return state;
  }

  // One by one: bytes copied at once wait until all that was written there is in memory.
  static void put(const plant::State<double>& state, double* y) {
    y[0] = state.joint.contraction_ratio;
    y[1] = state.joint.contraction_speed_per_s;
    put(state.side, y + 2);
    if constexpr (L::sides == 2) put(state.opposite, y + 5);
  }

  static plant::Memory<double> memory_of(const double* y) {
    plant::Memory<double> memory{};
    load_memory(y, memory);
    return memory;
  }

  static plant::Ledger<double> ledger_of(const double* y) {
    plant::Ledger<double> ledger{};
    if constexpr (L::audits) std::memcpy(&ledger, y + L::steering, L::ledger_bytes);
    return ledger;
  }

  static void store(const Flow& flow, double* y) {
    put(flow.state, y);
    put(flow.memory, y);
    if constexpr (L::audits) std::memcpy(y + L::steering, &flow.ledger, L::ledger_bytes);
  }

  static void load(const double* y, Flow& flow) {
    std::memcpy(&flow.state, y, L::state_bytes);
    load_memory(y, flow.memory);
    if constexpr (L::audits) std::memcpy(&flow.ledger, y + L::steering, L::ledger_bytes);
  }

  /// dy/dt; false where a law is not defined (a trial stage of the solver may go there).
  [[gnu::flatten]] bool rates(const double* y, double* dydt) const {
    const auto state = state_of(y);
    const auto memory = memory_of(y);
    if (!plant_.template in_domain<L::sides>(state, memory)) return false;
    const auto now = plant_.template moment<L::sides>(state, memory, held);
    const auto rates = plant_.template rates<L::sides>(state, now);
    put(rates, dydt);
    if constexpr (L::remembers) {  // a plant beside others may have no effects at all
      plant::Memory<double> memories{};
      if (plant_.remembers()) memories.side = now.memory_rates;
      if constexpr (L::sides == 2) memories.opposite = now.opposite.memory_rates;
      put(memories, dydt);
    }
    if constexpr (L::audits) {
      const auto ledger = plant_.template ledger_rates<L::sides>(state, now, ledger_of(y));
      std::memcpy(dydt + L::steering, &ledger, L::ledger_bytes);
    }
    return true;
  }

 private:
  static void put(const plant::Memory<double>& memory, double* y) {
    if constexpr (L::remembers) std::memcpy(y + L::states, memory.side.data(), L::memory_bytes);
    if constexpr (L::remembers && L::sides == 2)
      std::memcpy(y + L::states + L::of_side, memory.opposite.data(), L::memory_bytes);
  }
  static void load_memory(const double* y, plant::Memory<double>& memory) {
    if constexpr (L::remembers) std::memcpy(memory.side.data(), y + L::states, L::memory_bytes);
    if constexpr (L::remembers && L::sides == 2)
      std::memcpy(memory.opposite.data(), y + L::states + L::of_side, L::memory_bytes);
  }
  static void put(const plant::SideState<double>& side, double* y) {
    y[0] = side.valve_pressure_Pa;
    y[1] = side.muscle_pressure_Pa;
    y[2] = side.bristle_m;
  }

  const plant::Plant& plant_;
};

}  // namespace mckibben::engine
