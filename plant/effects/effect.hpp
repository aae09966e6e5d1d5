// What every effect can see and say. An effect is a departure from the nominal rig: a plain struct in a
// header of its own, over the type P of its parameters (double, or lanes with a value for each of several
// rigs), with
//   name, law, sentence, source            what `mckibben effects` prints
//   hooks                                  which of the functions below it has: one that is declared and not
//                                          there, or there and not declared, does not compile
//   its parameters and `fields`            as every settings struct
//   absent()                               true where the rig is the nominal one, bit for bit
//   variants                               how a diagnosis looks for it, one entry for each law variant
//   in_motion                              true where it depends on speed or time: points at rest do not show
//   it
// and those of these functions that it needs (S is double, a dual number, or lanes):
//   S pull_N(now, memory)                  force on the load, positive upwards; `acts_on_load = true` where
//   it
//                                          acts there and not on the muscle
//   S friction_factor(now, memory)         multiplies the friction level G
//   S end_correction_shift(now)            added to k, in the braid force only
//   S pressing_shift_Pa(now)               added to P_m, in what presses on braid and threads
//   S outflow_kg_per_s(now)                gas that leaves the muscle
//   P gas_exponent()                       multiplies both pressure rates
//   S heating_Pa_per_s(now, inflow, memory)   added to dP_m/dt
//   S valve_error_shift_Pa(error)          added to P_ref - P_v
//   S valve_opening(wanted, memory)        by how much the valve opens
//   S supply_drop_Pa(memory)               taken from the supply pressure
//   P vent_factor()                        multiplies what the valve vents
//   S memory_rate(now, inflow, memory)     d(memory)/dt; a memory starts at zero; `memory_size` is its scale,
//                                          in `memory_unit`
//   P command_delay_s()                    by how much commands come late
//   P reading_delay_s()                    by how much the load's position is read late
//   double reference_Pa(wanted, play)      at each tick: the reference that the valve follows
//   double wheel_m(rise, play)             at each tick: where the encoder's wheel stands
//   P reading_factor()                     multiplies what the encoder reads of it
//   P gauge_offset_Pa(), P gauge_factor()  added to what the gauge shows of P_m times this
// Effects never see each other: shifts add up, factors multiply, plays in series are one play as wide as all
// of them. So their order cannot matter.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include <plant/flow.hpp>

namespace mckibben::plant {

/// What is known at an instant, before any effect. Pressures gauge.
template <class S>
struct Instant {
  using P = AsParameter<S>;
  S contraction_ratio;         ///< e
  S rise_m;                    ///< x = l0 e
  S speed_m_per_s;             ///< v = l0 w
  S muscle_pressure_Pa;        ///< P_m
  P weight_N;                  ///< m g
  P atmosphere_Pa;             ///< absolute
  P gas_J_per_kg;              ///< R T
  RestrictionOf<P> unit_flow;  ///< of a conductance of 1 m3/(s Pa)
  S valve_pressure_Pa{};       ///< P_v
  S reference_Pa{};            ///< P_ref, what the valve follows
  S braid_force_N{};           ///< F, Tondu-Lopez (T 2.8), by e and P_m
};

/// What flows into the plant at that instant, after all effects on it.
template <class S>
struct Inflow {
  S wanted_opening;                   ///< u, what the proportional band asks for
  S supply_kg_per_s;                  ///< drawn from the supply
  S hose_kg_per_s, leak_kg_per_s;     ///< into the muscle, and out of it besides
  S volume_m3, volume_rate_m3_per_s;  ///< V, dV/dt
  S pressure_rate_Pa_per_s{};         ///< dP_m/dt; to a `memory_rate` only
};

/// What effects pull with [N].
template <class S>
struct Pull {
  S all_N, on_load_N;  ///< together; of that at the load itself, beyond the cord
};

/// Pulls at the load or its guide, not at the muscle: the cord carries none of it.
template <class E>
concept ActsOnLoad = requires {
  requires E::acts_on_load;
};

/// What moves only when pushed: stays where it is until its input is more than half a width away.
struct Play {
  std::optional<double> at{};
  double follow(double input, double half_width) {
    const double before = at.value_or(input);
    at = std::min(std::max(before, input - half_width), input + half_width);
    return *at;
  }
};

/// Memories follow within this time at the fastest, so that a tiny time constant asks for no infinite rate.
inline constexpr double fastest_s = 1e-6;

/// Where an effect acts: the functions above, but for `memory_rate`, which goes with `memory_size`.
enum class Hook {
  pull,
  friction_factor,
  end_correction_shift,
  pressing_shift,
  outflow,
  gas_exponent,
  muscle_heating,
  valve_error_shift,
  valve_opening,
  supply_drop,
  vent_factor,
  command_delay,
  reading_delay,
  reference,
  wheel,
  reading_factor,
  gauge
};
inline constexpr std::size_t hook_count = static_cast<std::size_t>(Hook::gauge) + 1;

/// What the hook acts on, for people.
constexpr std::string_view words(Hook hook) {
  constexpr std::array<std::string_view, hook_count> list{"pull",
                                                          "friction level",
                                                          "braid force",
                                                          "braid force and friction level",
                                                          "gas",
                                                          "gas",
                                                          "gas",
                                                          "valve",
                                                          "valve",
                                                          "supply",
                                                          "exhaust",
                                                          "command",
                                                          "reading, at ticks",
                                                          "valve, at ticks",
                                                          "reading, at ticks",
                                                          "reading",
                                                          "gauge"};
  return list[static_cast<std::size_t>(hook)];
}

enum class Sign { positive, either };

/// One law variant, as a diagnosis fits it. Values in the units of the field list.
struct Variant {
  std::string_view name;       ///< of the variant; empty if the effect has one law only
  std::string_view amplitude;  ///< key of the parameter that switches it on
  double absent;               ///< its value without the effect
  double typical;              ///< deviation from it that matters, with the sign that is likelier
  Sign sign;                   ///< whether the deviation may have the other sign too
  double step;                 ///< deviation for differences: small where the law is smooth at `absent`
  std::string_view shape{};    ///< key of the parameter that shapes it; empty if there is none
  double low = 0.0, middle = 0.0, high = 0.0;  ///< shapes to begin from
  std::string_view adds_to{};  ///< the law that this one is with a term more; it is looked for beside that
};

}  // namespace mckibben::plant
