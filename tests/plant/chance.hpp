// States and instants by chance, and all that the plant computes of one: for tests of every effect.
#pragma once

#include <cstddef>
#include <cstring>
#include <random>
#include <vector>

#include <plant/plant.hpp>

namespace mckibben::plant {

class Chance {
 public:
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  bool coin() { return between(0.0, 1.0) < 0.5; }
  State<double> state() {
    return {{between(-0.05, 0.6), between(-20.0, 20.0)},
            {between(-0.9e5, 10e5), between(-0.9e5, 10e5), between(-1e-3, 1e-3)},
            {}};
  }
  Memory<double> memory() {
    Memory<double> memory{};
    for (std::size_t i = 0; i < memory.side.size(); ++i)
      memory.side[i] = between(-1.0, 2.0) * memory_sizes[i];
    return memory;
  }
  /// At an instant in the range of use.
  Instant<double> instant() {
    const double e = between(-0.01, 0.28);
    return {e,       0.3 * e,           between(-0.5, 0.5), between(0.0, 5e5), between(50.0, 300.0), 101325.0,
            84150.0, {1.185, 0.3, 1e3}, between(0.0, 5e5),  between(0.0, 5e5), between(0.0, 300.0)};
  }

 private:
  std::mt19937_64 random_{5};
};

/// All that the plant computes, as bytes would be compared.
inline std::vector<double> all_of(const Plant& plant, const State<double>& state,
                                  const Memory<double>& memory) {
  Held held;
  held.reference_pressure_Pa = 3e5;
  held.current_speed_mA_per_s = 8.0;
  const auto now = plant.moment(state, memory, held);
  const auto dt = plant.rates(state, now);
  const auto books = plant.ledger_rates(state, now, plant.opened(state));
  constexpr std::size_t rates = single_size;  // nobody is on the other side
  std::vector<double> values(rates + sizeof books / sizeof(double));
  std::memcpy(values.data(), &dt, rates * sizeof(double));
  std::memcpy(values.data() + rates, &books, sizeof books);
  values.insert(values.end(), {now.valve_opening, now.supply_flow, now.friction_level_N});
  if (plant.remembers()) values.insert(values.end(), now.memory_rates.begin(), now.memory_rates.end());
  return values;
}

}  // namespace mckibben::plant
