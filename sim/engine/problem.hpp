// What an integrator sees: a right-hand side over a fixed number of components, frozen between ticks. First
// the plant's state; then what its effects remember, if one does; then its ledger, if it is kept, which never
// steers the steps, so that a run with and without it takes the same steps bit for bit.
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
inline constexpr std::array<double, plant::state_size> working_size{0.3, 1.0, 5e5, 5e5, 1e-4};

/// How much of the ledger is kept: nothing, what isothermal gas needs, or all.
enum class Books { none, isothermal, polytropic };

/// Which components there are.
template <bool remembers_, Books books_>
struct Layout {
  static constexpr bool remembers = remembers_, audits = books_ != Books::none;
  static constexpr int steering = plant::state_size + (remembers ? static_cast<int>(plant::memory_size) : 0);
  static constexpr int entries = books_ == Books::none         ? 0
                                 : books_ == Books::isothermal ? plant::isothermal_ledger_size
                                                               : plant::ledger_size;
  static constexpr int size = steering + entries;
  static constexpr std::size_t ledger_bytes = entries * sizeof(double);
};

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
    std::memcpy(&state, y, sizeof state);
    return state;
  }

  static plant::Memory<double> memory_of(const double* y) {
    plant::Memory<double> memory{};
    if constexpr (L::remembers) std::memcpy(memory.data(), y + plant::state_size, sizeof memory);
    return memory;
  }

  static plant::Ledger<double> ledger_of(const double* y) {
    plant::Ledger<double> ledger{};
    if constexpr (L::audits) std::memcpy(&ledger, y + L::steering, L::ledger_bytes);
    return ledger;
  }

  static void store(const Flow& flow, double* y) {
    std::memcpy(y, &flow.state, sizeof flow.state);
    if constexpr (L::remembers) std::memcpy(y + plant::state_size, flow.memory.data(), sizeof flow.memory);
    if constexpr (L::audits) std::memcpy(y + L::steering, &flow.ledger, L::ledger_bytes);
  }

  static void load(const double* y, Flow& flow) {
    std::memcpy(&flow.state, y, sizeof flow.state);
    if constexpr (L::remembers) std::memcpy(flow.memory.data(), y + plant::state_size, sizeof flow.memory);
    if constexpr (L::audits) std::memcpy(&flow.ledger, y + L::steering, L::ledger_bytes);
  }

  /// dy/dt; false where a law is not defined (a trial stage of the solver may go there).
  bool rates(const double* y, double* dydt) const {
    const auto state = state_of(y);
    if (!plant_.in_domain(state)) return false;
    const auto now = plant_.moment(state, memory_of(y), held);
    const auto rates = plant_.rates(state, now);
    std::memcpy(dydt, &rates, sizeof rates);
    if constexpr (L::remembers) {  // a plant beside others may have no effects at all
      const auto memories = plant_.remembers() ? now.memory_rates : plant::Memory<double>{};
      std::memcpy(dydt + plant::state_size, memories.data(), sizeof memories);
    }
    if constexpr (L::audits) {
      const auto ledger = plant_.ledger_rates(state, now, ledger_of(y));
      std::memcpy(dydt + L::steering, &ledger, L::ledger_bytes);
    }
    return true;
  }

 private:
  const plant::Plant& plant_;
};

}  // namespace mckibben::engine
