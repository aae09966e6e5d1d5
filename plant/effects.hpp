// The table of effects, and what they do together: shifts and pulls add up, factors multiply.
// A sixteenth effect is a header in effects/, a line in the table and a test (docs/add_an_effect.md).
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include <plant/effects/bladder_creep.hpp>
#include <plant/effects/bladder_elasticity.hpp>
#include <plant/effects/encoder_backlash.hpp>
#include <plant/effects/encoder_scale.hpp>
#include <plant/effects/end_cap_correction.hpp>
#include <plant/effects/friction_warm_up.hpp>
#include <plant/effects/guide_friction.hpp>
#include <plant/effects/muscle_leak.hpp>
#include <plant/effects/polytropic_gas.hpp>
#include <plant/effects/residual_force.hpp>
#include <plant/effects/speed_dependent_friction.hpp>
#include <plant/effects/supply_droop.hpp>
#include <plant/effects/valve_dead_band.hpp>
#include <plant/effects/valve_hysteresis.hpp>
#include <plant/effects/valve_lag.hpp>
#include <plant/effects/viscous_damping.hpp>

namespace mckibben::plant {

template <class E>
concept Remembers = requires {
  E::memory_size;
};

template <class... Effect>
class EffectSet {
 public:
  using Table = std::tuple<Effect...>;
  static constexpr std::size_t count = sizeof...(Effect);

  Table all{};

  template <class E>
  E& get() {
    return std::get<E>(all);
  }
  template <class E>
  const E& get() const {
    return std::get<E>(all);
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    std::apply([&](auto&... effect) { (visit(effect.name, effect, effect.sentence), ...); }, self.all);
  }

  bool absent() const {
    return std::apply([](const auto&... effect) { return (effect.absent() && ...); }, all);
  }

  /// How many effects of the table have a memory, and whether one of them is switched on.
  static constexpr std::size_t memories = (std::size_t{Remembers<Effect>} + ...);
  bool remember() const {
    bool any = false;
    each([&]<class E>(const E&, auto) { any = any || Remembers<E>; });
    return any;
  }
  /// Working sizes of the memories, in their own units.
  static constexpr std::array<double, memories> memory_sizes = [] {
    std::array<double, memories> sizes{};
    std::size_t next = 0;
    const auto add = [&]<class E>(std::type_identity<E>) {
      if constexpr (Remembers<E>) sizes[next++] = E::memory_size;
    };
    (add(std::type_identity<Effect>{}), ...);
    return sizes;
  }();

  template <class S>
  S pull_N(const Instant<S>& now, const std::array<S, memories>& memory) const {
    S sum = S(0.0);
    each([&](const auto& effect, auto slot) {
      if constexpr (requires { effect.pull_N(now, now.rise_m); })
        sum = sum + effect.pull_N(now, recall(memory, slot));
    });
    return sum;
  }
  template <class S>
  S friction_factor(const Instant<S>& now, const std::array<S, memories>& memory) const {
    S product = S(1.0);
    each([&](const auto& effect, auto slot) {
      if constexpr (requires { effect.friction_factor(now, now.rise_m); })
        product = product * effect.friction_factor(now, recall(memory, slot));
    });
    return product;
  }
  template <class S>
  S end_correction_shift(const Instant<S>& now) const {
    S sum = S(0.0);
    each([&](const auto& effect, auto) {
      if constexpr (requires { effect.end_correction_shift(now); })
        sum = sum + effect.end_correction_shift(now);
    });
    return sum;
  }
  template <class S>
  S outflow_kg_per_s(const Instant<S>& now) const {
    S sum = S(0.0);
    each([&](const auto& effect, auto) {
      if constexpr (requires { effect.outflow_kg_per_s(now); }) sum = sum + effect.outflow_kg_per_s(now);
    });
    return sum;
  }
  double gas_exponent() const {
    double product = 1.0;
    each([&](const auto& effect, auto) {
      if constexpr (requires { effect.gas_exponent(); }) product *= effect.gas_exponent();
    });
    return product;
  }
  template <class S>
  S valve_error_shift_Pa(const S& error_Pa) const {
    S sum = S(0.0);
    each([&](const auto& effect, auto) {
      if constexpr (requires { effect.valve_error_shift_Pa(error_Pa); })
        sum = sum + effect.valve_error_shift_Pa(error_Pa);
    });
    return sum;
  }
  template <class S>
  S valve_opening(const S& wanted, const std::array<S, memories>& memory) const {
    S opening = wanted;
    each([&](const auto& effect, auto slot) {
      if constexpr (requires { effect.valve_opening(wanted, wanted); })
        opening = effect.valve_opening(opening, recall(memory, slot));
    });
    return opening;
  }
  template <class S>
  S supply_drop_Pa(const std::array<S, memories>& memory) const {
    S sum = S(0.0);
    each([&](const auto& effect, auto slot) {
      if constexpr (requires { effect.supply_drop_Pa(sum); })
        sum = sum + effect.supply_drop_Pa(recall(memory, slot));
    });
    return sum;
  }
  template <class S>
  std::array<S, memories> memory_rates(const Instant<S>& now, const Inflow<S>& inflow,
                                       const std::array<S, memories>& memory) const {
    std::array<S, memories> rates;
    rates.fill(S(0.0));
    each([&]<class E>(const E& effect, auto slot) {
      if constexpr (Remembers<E>) rates[slot] = effect.memory_rate(now, inflow, memory[slot]);
    });
    return rates;
  }

  /// What effects keep between ticks.
  using Plays = std::array<Play, count>;
  /// The reference pressure [Pa] that the valve follows, of the one that the current asks for.
  double reference_Pa(double wanted_Pa, Plays& plays) const {
    std::size_t index = 0;
    return at_tick(wanted_Pa, [&](const auto& effect, double value) {
      Play& play = plays[index++];
      if constexpr (requires { effect.reference_Pa(value, play); })
        return effect.absent() ? value : effect.reference_Pa(value, play);
      else
        return value;
    });
  }
  /// What the encoder's wheel says of the load's rise [m].
  double wheel_m(double rise_m, Plays& plays) const {
    std::size_t index = 0;
    const double wheel_m = at_tick(rise_m, [&](const auto& effect, double value) {
      Play& play = plays[index++];
      if constexpr (requires { effect.wheel_m(value, play); })
        return effect.absent() ? value : effect.wheel_m(value, play);
      else
        return value;
    });
    double factor = 1.0;
    each([&](const auto& effect, auto) {
      if constexpr (requires { effect.reading_factor(); }) factor *= effect.reading_factor();
    });
    return factor * wheel_m;
  }

 private:
  // Slot of the memory of the effect at an index of the table.
  template <std::size_t index>
  static constexpr std::size_t slot_of = []<std::size_t... before>(std::index_sequence<before...>) {
    return (std::size_t{0} + ... + std::size_t{Remembers<std::tuple_element_t<before, Table>>});
  }
  (std::make_index_sequence<index>());

  // Calls f(effect, slot) for each effect that is switched on.
  template <class F>
  void each(const F& f) const {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      const auto call = [&]<std::size_t at>(std::integral_constant<std::size_t, at>) {
        const auto& effect = std::get<at>(all);
        if (!effect.absent()) f(effect, std::integral_constant<std::size_t, slot_of<at>>{});
      };
      (call(std::integral_constant<std::size_t, i>{}), ...);
    }
    (std::make_index_sequence<count>());
  }

  // An effect without a memory of its own is handed another's, or nothing, and does not look.
  template <class S, std::size_t slot>
  static const S& recall(const std::array<S, memories>& memory, std::integral_constant<std::size_t, slot>) {
    return memory[slot < memories ? slot : 0];
  }

  template <class F>
  double at_tick(double value, const F& f) const {
    std::apply([&](const auto&... effect) { ((value = f(effect, value)), ...); }, all);
    return value;
  }
};

/// The catalogue, and last the sum of terms for what it has no name for.
using Effects =
    EffectSet<ViscousDamping, GuideFriction, SpeedDependentFriction, BladderElasticity, BladderCreep,
              EndCapCorrection, MuscleLeak, PolytropicGas, ValveLag, ValveDeadBand, ValveHysteresis,
              SupplyDroop, FrictionWarmUp, EncoderBacklash, EncoderScale, ResidualForce>;

}  // namespace mckibben::plant
