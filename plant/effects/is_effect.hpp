// What makes a struct an effect: it has the functions of the hooks that it declares, and no others.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class E>
concept Remembers = requires {
  E::memory_size;
  E::memory_unit;
};

/// Remembers more than one number; what its functions get of the others is an array of so many.
template <class E>
concept RemembersMore = Remembers<E> && requires {
  E::further_memories;
};

template <class E>
constexpr bool declares(Hook hook) {
  return std::find(E::hooks.begin(), E::hooks.end(), hook) != E::hooks.end();
}

template <class E, class S>
using Further = std::array<S, E::further_memories>;

/// Whether an effect has the function of a hook, as it is called.
template <class E>
constexpr bool has(Hook hook) {
  using Now = const Instant<double>&;
  using enum Hook;
  switch (hook) {
    case pull:
      if constexpr (RemembersMore<E>)
        return requires(const E& e, Now now, double m, const Further<E, double>& more) {
          { e.pull_N(now, m, more) } -> std::same_as<double>;
        };
      else
        return requires(const E& e, Now now, double m) {
          { e.pull_N(now, m) } -> std::same_as<double>;
        };
    case friction_factor:
      return requires(const E& e, Now now, double m) {
        { e.friction_factor(now, m) } -> std::same_as<double>;
      };
    case end_correction_shift:
      return requires(const E& e, Now now) {
        { e.end_correction_shift(now) } -> std::same_as<double>;
      };
    case pressing_shift:
      return requires(const E& e, Now now) {
        { e.pressing_shift_Pa(now) } -> std::same_as<double>;
      };
    case outflow:
      return requires(const E& e, Now now) {
        { e.outflow_kg_per_s(now) } -> std::same_as<double>;
      };
    case gas_exponent:
      return requires(const E& e) {
        { e.gas_exponent() } -> std::same_as<double>;
      };
    case muscle_heating:
      return requires(const E& e, Now now, const Inflow<double>& in, double m) {
        { e.heating_Pa_per_s(now, in, m) } -> std::same_as<double>;
      };
    case valve_error_shift:
      return requires(const E& e, double p) {
        { e.valve_error_shift_Pa(p) } -> std::same_as<double>;
      };
    case valve_opening:
      return requires(const E& e, double u, double m) {
        { e.valve_opening(u, m) } -> std::same_as<double>;
      };
    case supply_drop:
      return requires(const E& e, double m) {
        { e.supply_drop_Pa(m) } -> std::same_as<double>;
      };
    case vent_factor:
      return requires(const E& e) {
        { e.vent_factor() } -> std::same_as<double>;
      };
    case command_delay:
      return requires(const E& e) {
        { e.command_delay_s() } -> std::same_as<double>;
      };
    case reading_delay:
      return requires(const E& e) {
        { e.reading_delay_s() } -> std::same_as<double>;
      };
    case reference:
      return requires(const E& e, double p, Play& play) {
        { e.reference_Pa(p, play) } -> std::same_as<double>;
      };
    case wheel:
      return requires(const E& e, double x, Play& play) {
        { e.wheel_m(x, play) } -> std::same_as<double>;
      };
    case reading_factor:
      return requires(const E& e) {
        { e.reading_factor() } -> std::same_as<double>;
      };
    case gauge:
      return requires(const E& e) {
        { e.gauge_offset_Pa() } -> std::same_as<double>;
        { e.gauge_factor() } -> std::same_as<double>;
      };
  }
  return false;
}

/// Exactly the hooks that are declared, at least one, and a rate for a memory: a misspelled function would
/// otherwise never be called.
template <class E>
concept IsEffect = !E::hooks.empty() && [] {
  for (std::size_t i = 0; i < hook_count; ++i)
    if (has<E>(static_cast<Hook>(i)) != declares<E>(static_cast<Hook>(i))) return false;
  return Remembers<E> ==
         requires(const E& e, const Instant<double>& now, const Inflow<double>& in, double m) {
    { e.memory_rate(now, in, m) } -> std::same_as<double>;
  };
}();

}  // namespace mckibben::plant
