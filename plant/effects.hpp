// The table of effects, and what they do together: shifts and pulls add up, factors multiply.
// A further effect is a header in effects/, a line in the table and a test (docs/add_an_effect.md).
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include <plant/effects/bladder_creep.hpp>
#include <plant/effects/bladder_elasticity.hpp>
#include <plant/effects/bladder_hysteresis.hpp>
#include <plant/effects/command_delay.hpp>
#include <plant/effects/encoder_backlash.hpp>
#include <plant/effects/encoder_scale.hpp>
#include <plant/effects/end_cap_correction.hpp>
#include <plant/effects/exhaust_restriction.hpp>
#include <plant/effects/friction_warm_up.hpp>
#include <plant/effects/gas_temperature.hpp>
#include <plant/effects/gauge_error.hpp>
#include <plant/effects/guide_friction.hpp>
#include <plant/effects/is_effect.hpp>
#include <plant/effects/isometric_hysteresis.hpp>
#include <plant/effects/muscle_leak.hpp>
#include <plant/effects/own_laws.hpp>
#include <plant/effects/polytropic_gas.hpp>
#include <plant/effects/pressure_threshold.hpp>
#include <plant/effects/reading_delay.hpp>
#include <plant/effects/residual_force.hpp>
#include <plant/effects/speed_dependent_friction.hpp>
#include <plant/effects/supply_droop.hpp>
#include <plant/effects/valve_dead_band.hpp>
#include <plant/effects/valve_hysteresis.hpp>
#include <plant/effects/valve_lag.hpp>
#include <plant/effects/viscous_damping.hpp>

namespace mckibben::plant {

/// How much of what a side may remember a rig needs: the first numbers alone, or all.
enum class Memories { none, few, all };

template <class E>
constexpr std::size_t further_of() {
  if constexpr (RemembersMore<E>) return E::further_memories;
  return 0;
}

/// Effects with parameters of type P.
template <class P, class... Effect>
class EffectSet {
 public:
  using Table = std::tuple<Effect...>;
  static constexpr std::size_t count = sizeof...(Effect);

  Table all{};
  OwnLawsOf<P> laws{};

  template <class E>
  E& get() {
    return std::get<E>(all);
  }
  template <class E>
  const E& get() const {
    return std::get<E>(all);
  }

  static void fields(auto& self, auto& visit) {
    std::apply([&](auto&... effect) { (visit(effect.name, effect, effect.sentence), ...); }, self.all);
    visit("hypotheses", self.laws, "laws of your own: files, or written here (docs/hypotheses.md)");
  }

  bool absent() const {
    return laws.absent() &&
           std::apply([](const auto&... effect) { return !(any(!effect.absent()) || ...); }, all);
  }

  /// How many effects of the table have a memory. These numbers come first; then one of a regulator; then
  /// what effects remember besides; then what laws of a user's own do, and the time.
  static constexpr std::size_t memories = (std::size_t{Remembers<Effect>} + ...), few_memories = memories + 1,
                               from_laws = few_memories + (further_of<Effect>() + ...),
                               all_memories = from_laws + law_slots;
  /// Where what an effect remembers besides begins.
  template <class E>
  static constexpr std::size_t further_from = [] {
    std::size_t from = few_memories;
    bool before = true;
    ((before = before && !std::same_as<E, Effect>, from += before ? further_of<Effect>() : 0), ...);
    return from;
  }();
  Memories memories_used() const {
    Memories used = laws.remember() ? Memories::all : Memories::none;
    each([&]<class E>(const E& effect, auto, auto) {
      if constexpr (Remembers<E>) used = std::max(used, Memories::few);
      if constexpr (RemembersMore<E>)
        if (effect.remembers_more()) used = Memories::all;
    });
    return used;
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

  // What laws are handed is a copy: an instant whose address is taken stands in memory, laws or not.
  template <class S, std::size_t slots>
  Pull<S> pull(const Instant<S>& now, const std::array<S, slots>& memory) const {
    Pull<S> sum{S(0.0), S(0.0)};
    each([&]<class E>(const E& effect, auto on, auto slot) {
      if constexpr (declares<E>(Hook::pull)) {
        const S pull_N = [&] {
          if constexpr (RemembersMore<E>)
            return effect.pull_N(now, memory[slot], further<E>(memory));
          else
            return effect.pull_N(now, recall(memory, slot));
        }();
        sum.all_N = select(on, S(sum.all_N + pull_N), sum.all_N);
        if constexpr (ActsOnLoad<E>) sum.on_load_N = select(on, S(sum.on_load_N + pull_N), sum.on_load_N);
      }
    });
    if (!laws.list.empty()) {
      const Pull<S> own = laws.pull(Instant<S>(now), std::array(memory), from_laws);
      sum = {sum.all_N + own.all_N, sum.on_load_N + own.on_load_N};
    }
    return sum;
  }
  template <class S, std::size_t slots>
  S friction_factor(const Instant<S>& now, const std::array<S, slots>& memory) const {
    S product = S(1.0);
    each([&]<class E>(const E& effect, auto on, auto slot) {
      if constexpr (declares<E>(Hook::friction_factor))
        product = select(on, S(product * effect.friction_factor(now, recall(memory, slot))), product);
    });
    if (!laws.list.empty())
      product = product *
                (1.0 + laws.sum(LawTarget::friction_factor, Instant<S>(now), std::array(memory), from_laws));
    return product;
  }
  template <class S>
  S end_correction_shift(const Instant<S>& now) const {
    S sum = S(0.0);
    each([&]<class E>(const E& effect, auto on, auto) {
      if constexpr (declares<E>(Hook::end_correction_shift))
        sum = select(on, S(sum + effect.end_correction_shift(now)), sum);
    });
    return sum;
  }
  template <class S>
  S pressing_shift_Pa(const Instant<S>& now) const {
    S sum = S(0.0);
    each([&]<class E>(const E& effect, auto on, auto) {
      if constexpr (declares<E>(Hook::pressing_shift))
        sum = select(on, S(sum + effect.pressing_shift_Pa(now)), sum);
    });
    return sum;
  }
  template <class S, std::size_t slots>
  S outflow_kg_per_s(const Instant<S>& now, const std::array<S, slots>& memory) const {
    S sum = S(0.0);
    each([&]<class E>(const E& effect, auto on, auto) {
      if constexpr (declares<E>(Hook::outflow)) sum = select(on, S(sum + effect.outflow_kg_per_s(now)), sum);
    });
    if (!laws.list.empty()) {
      const S own = laws.sum(LawTarget::outflow, Instant<S>(now), std::array(memory), from_laws);
      sum = sum + own;
    }
    return sum;
  }
  P gas_exponent() const {
    P product = 1.0;  // of one that is absent it is 1
    each_of<Hook::gas_exponent>([&](const auto& effect) { product = product * effect.gas_exponent(); });
    return product;
  }
  template <class S, std::size_t slots>
  S heating_Pa_per_s(const Instant<S>& now, const Inflow<S>& inflow,
                     const std::array<S, slots>& memory) const {
    S sum = S(0.0);
    each([&]<class E>(const E& effect, auto on, auto slot) {
      if constexpr (declares<E>(Hook::muscle_heating))
        sum = select(on, S(sum + effect.heating_Pa_per_s(now, inflow, recall(memory, slot))), sum);
    });
    return sum;
  }
  /// Whether gas gets another temperature than the walls'.
  bool warm() const {
    bool one = any(gas_exponent() != 1.0);
    each([&]<class E>(const E&, auto, auto) { one = one || declares<E>(Hook::muscle_heating); });
    return one;
  }
  template <class S>
  S valve_error_shift_Pa(const S& error_Pa) const {
    S sum = S(0.0);
    each([&]<class E>(const E& effect, auto on, auto) {
      if constexpr (declares<E>(Hook::valve_error_shift))
        sum = select(on, S(sum + effect.valve_error_shift_Pa(error_Pa)), sum);
    });
    return sum;
  }
  template <class S, std::size_t slots>
  S valve_opening(const S& wanted, const std::array<S, slots>& memory) const {
    S opening = wanted;
    each([&]<class E>(const E& effect, auto on, auto slot) {
      if constexpr (declares<E>(Hook::valve_opening))
        opening = select(on, S(effect.valve_opening(opening, recall(memory, slot))), opening);
    });
    return opening;
  }
  template <class S, std::size_t slots>
  S supply_drop_Pa(const std::array<S, slots>& memory) const {
    S sum = S(0.0);
    each([&]<class E>(const E& effect, auto on, auto slot) {
      if constexpr (declares<E>(Hook::supply_drop))
        sum = select(on, S(sum + effect.supply_drop_Pa(recall(memory, slot))), sum);
    });
    return sum;
  }
  P vent_factor() const {
    P product = 1.0;
    each_of<Hook::vent_factor>([&](const auto& effect) { product = product * effect.vent_factor(); });
    return product;
  }
  P command_delay_s() const {
    P sum = 0.0;
    each_of<Hook::command_delay>([&](const auto& effect) { sum = sum + effect.command_delay_s(); });
    return sum;
  }
  P reading_delay_s() const {
    P sum = 0.0;
    each_of<Hook::reading_delay>([&](const auto& effect) { sum = sum + effect.reading_delay_s(); });
    return sum;
  }
  template <class S, std::size_t slots>
  std::array<S, slots> memory_rates(const Instant<S>& now, const Inflow<S>& inflow,
                                    const std::array<S, slots>& memory) const {
    std::array<S, slots> rates;
    rates.fill(S(0.0));
    each([&]<class E>(const E& effect, auto on, auto slot) {
      if constexpr (Remembers<E>)
        rates[slot] = select(on, S(effect.memory_rate(now, inflow, memory[slot])), rates[slot]);
      if constexpr (RemembersMore<E>)
        if (effect.remembers_more()) {
          const auto more = effect.further_rates(now, further<E>(memory));
          for (std::size_t i = 0; i < more.size(); ++i) {
            S& rate = rates[further_from<E> + i];
            rate = select(on, more[i], rate);
          }
        }
    });
    if (!laws.list.empty()) {
      const auto own = laws.memory_rates(Instant<S>(now), std::array(memory), from_laws);
      std::copy(own.begin(), own.end(), rates.begin() + from_laws);
    }
    return rates;
  }

  /// What laws add to the pressure that the valve follows [Pa], and to the rise that is read [m].
  template <class S, std::size_t slots>
  S command_shift_Pa(const Instant<S>& now, const std::array<S, slots>& memory) const {
    return laws.sum(LawTarget::command, now, memory, from_laws);
  }
  double reading_shift_m(const Instant<double>& now, const auto& memory) const {
    return laws.sum(LawTarget::reading, now, memory, from_laws);
  }

  /// What effects keep between ticks.
  using Plays = std::array<Play, count>;
  /// The reference pressure [Pa] that the valve follows, of the one that the current asks for.
  double reference_Pa(double wanted_Pa, Plays& plays) const {
    std::size_t index = 0;
    return at_tick(wanted_Pa, [&]<class E>(const E& effect, double value) {
      Play& play = plays[index++];
      if constexpr (declares<E>(Hook::reference))
        return effect.absent() ? value : effect.reference_Pa(value, play);
      else
        return value;
    });
  }
  /// What the encoder's wheel says of the load's rise [m].
  double wheel_m(double rise_m, Plays& plays) const {
    std::size_t index = 0;
    const double wheel_m = at_tick(rise_m, [&]<class E>(const E& effect, double value) {
      Play& play = plays[index++];
      if constexpr (declares<E>(Hook::wheel))
        return effect.absent() ? value : effect.wheel_m(value, play);
      else
        return value;
    });
    double factor = 1.0;
    each_of<Hook::reading_factor>([&](const auto& effect) { factor *= effect.reading_factor(); });
    return factor * wheel_m;
  }
  /// What a gauge shows [Pa] of a muscle's pressure, and the pressure at which it shows that.
  double shown_Pa(double pressure_Pa) const {
    const auto [offset_Pa, factor] = gauge();
    return factor * pressure_Pa + offset_Pa;
  }
  double true_Pa(double shown_Pa) const {
    const auto [offset_Pa, factor] = gauge();
    return (shown_Pa - offset_Pa) / factor;
  }

 private:
  std::pair<double, double> gauge() const {
    double offset_Pa = 0.0, factor = 1.0;
    each_of<Hook::gauge>([&](const auto& effect) {
      offset_Pa += effect.gauge_offset_Pa();
      factor *= effect.gauge_factor();
    });
    return {offset_Pa, factor};
  }

  // Slot of the memory of the effect at an index of the table.
  template <std::size_t index>
  static constexpr std::size_t slot_of = []<std::size_t... before>(std::index_sequence<before...>) {
    return (std::size_t{0} + ... + std::size_t{Remembers<std::tuple_element_t<before, Table>>});
  }
  (std::make_index_sequence<index>());

  template <class E, class S, std::size_t slots>
  static Further<E, S> further(const std::array<S, slots>& memory) {
    Further<E, S> more;
    std::copy_n(memory.begin() + further_from<E>, more.size(), more.begin());
    return more;
  }

  // Calls f(effect, on, slot) for each effect that is switched on; `on`: for which of several rigs it is.
  void each(const auto& f) const {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      const auto call = [&]<std::size_t at>(std::integral_constant<std::size_t, at>) {
        const auto& effect = std::get<at>(all);
        const auto on = !effect.absent();
        if (any(on)) f(effect, on, std::integral_constant<std::size_t, slot_of<at>>{});
      };
      (call(std::integral_constant<std::size_t, i>{}), ...);
    }
    (std::make_index_sequence<count>());
  }

  // Calls f(effect) for each of these that has the hook.
  template <Hook hook, class F>
  void each_of(const F& f) const {
    each([&]<class E>(const E& effect, auto, auto) {
      if constexpr (declares<E>(hook)) f(effect);
    });
  }

  // An effect without a memory of its own is handed another's, or nothing, and does not look.
  template <class S, std::size_t slots, std::size_t slot>
  static const S& recall(const std::array<S, slots>& memory, std::integral_constant<std::size_t, slot>) {
    return memory[slot < memories ? slot : 0];
  }

  double at_tick(double value, const auto& f) const {
    std::apply([&](const auto&... effect) { ((value = f(effect, value)), ...); }, all);
    return value;
  }
};

/// The catalogue, and last the sum of terms for what it has no name for.
template <class P>
using EffectsOf =
    EffectSet<P, ViscousDampingOf<P>, GuideFrictionOf<P>, SpeedDependentFrictionOf<P>, BladderElasticityOf<P>,
              BladderCreepOf<P>, BladderHysteresisOf<P>, IsometricHysteresisOf<P>, EndCapCorrectionOf<P>,
              PressureThresholdOf<P>, MuscleLeakOf<P>, PolytropicGasOf<P>, GasTemperatureOf<P>, ValveLagOf<P>,
              ValveDeadBandOf<P>, ValveHysteresisOf<P>, SupplyDroopOf<P>, ExhaustRestrictionOf<P>,
              CommandDelayOf<P>, FrictionWarmUpOf<P>, EncoderBacklashOf<P>, EncoderScaleOf<P>,
              ReadingDelayOf<P>, GaugeErrorOf<P>, ResidualForceOf<P>>;
using Effects = EffectsOf<double>;
static_assert([]<class... E>(const std::tuple<E...>*) {
  return (IsEffect<E> && ...);
}(static_cast<const Effects::Table*>(nullptr)));

}  // namespace mckibben::plant
