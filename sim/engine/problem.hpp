// What an integrator sees: a right-hand side over a fixed number of components, frozen between ticks. The
// first `state_size` components are the plant's state; the rest, if any, its ledger, which is carried along
// but never steers the steps, so that a run with and without it takes the same steps bit for bit.
#pragma once

#include <array>
#include <bit>
#include <cstring>

#include <plant/plant.hpp>

namespace mckibben::engine {

/// State and ledger as they stand at one instant.
struct Flow {
  plant::State<double> state{};
  plant::Ledger<double> ledger{};
};

/// Working size of each state: an error of tolerance times this may be made in a step.
inline constexpr std::array<double, plant::state_size> working_size{0.3, 1.0, 5e5, 5e5, 1e-4};

template <int N>
class Problem {
 public:
  static constexpr bool keeps_ledger = N > plant::state_size;

  explicit Problem(const plant::Plant& rig) : plant_(rig) {}

  const plant::Plant& plant() const { return plant_; }
  plant::Held held;
  long refused = 0;  ///< trial states outside the domain of the laws, in this tick

  static plant::State<double> state_of(const double* y) {
    plant::State<double> state;
    std::memcpy(&state, y, sizeof state);
    return state;
  }

  static void store(const Flow& flow, double* y) {
    std::memcpy(y, &flow.state, sizeof flow.state);
    if constexpr (keeps_ledger) std::memcpy(y + plant::state_size, &flow.ledger, sizeof flow.ledger);
  }

  static void load(const double* y, Flow& flow) {
    std::memcpy(&flow.state, y, sizeof flow.state);
    if constexpr (keeps_ledger) std::memcpy(&flow.ledger, y + plant::state_size, sizeof flow.ledger);
  }

  /// dy/dt; false where a law is not defined (a trial stage of the solver may go there).
  bool rates(const double* y, double* dydt) const {
    const auto state = state_of(y);
    if (!plant_.in_domain(state)) return false;
    const auto now = plant_.moment(state, held);
    const auto rates = plant_.rates(state, now);
    std::memcpy(dydt, &rates, sizeof rates);
    if constexpr (keeps_ledger) {
      const auto ledger = plant_.ledger_rates(now);
      std::memcpy(dydt + plant::state_size, &ledger, sizeof ledger);
    }
    return true;
  }

 private:
  const plant::Plant& plant_;
};

}  // namespace mckibben::engine
