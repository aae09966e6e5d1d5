// The nominal plant: one muscle side that lifts a hanging load, or two that pull on one wheel against each
// other (T 2.7). What one side is stands in side.hpp, docs/equations.md has it all.
//
//   State, Memory, Held --(moment)--> Moment: all that is known at this instant --(rates)--> dx/dt
//
// The joint moves as the first muscle contracts; a second one, `opposite`, is stretched by as much:
//   e2 = e20 - (e - e10) l0/l02    theta = (e - e10) l0/R
// S is double, a dual number where the Jacobian is wanted, or lanes that hold several rigs; P is what their
// parameters are made of: double, but for lanes; H what is held: P, or S where slopes by it are wanted.
#pragma once

#include <optional>
#include <stdexcept>
#include <string_view>

#include <plant/mechanics.hpp>
#include <plant/side.hpp>

namespace mckibben::plant {

/// Everything known at one instant: of the muscle, of the joint, of the opposite muscle if there is one.
template <class S>
struct Moment : SideMoment<S> {
  S guide_force_N;          // c v
  S spring_force_N;         // of the return spring, positive where it shortens the (first) muscle
  S bench_force_N;          // of what gives the muscle its length, or pulls on the joint from outside
  S acceleration_m_per_s2;  // dv/dt
  SideMoment<S> opposite;
};

template <class P>
class PlantOf {
 public:
  /// The rig with a load [kg] hung on it. The rig's values are taken as checked.
  PlantOf(const RigOf<P>& rig, const P& load_kg);
  /// Two rigs' sides on the wheel of the first. Throws std::invalid_argument unless both have the same kind
  /// of friction memory and breathe the same gas.
  PlantOf(const RigOf<P>& rig, const RigOf<P>& opposite, const LinkOf<P>& link);

  /// Gauge pressure [Pa] the valve is asked for at a current [mA] (T 3.2), clamped to its trimmed range.
  double reference_pressure_Pa(double current_mA) const { return side_.reference_pressure_Pa(current_mA); }
  const SideOf<P>& side() const { return side_; }
  const std::optional<SideOf<P>>& opposite() const { return opposite_; }
  const LinkOf<P>& link() const { return link_; }
  /// What returns the joint [N], at a contraction ratio of the (first) muscle.
  template <class S>
  S spring_force_N(const S& contraction_ratio) const {
    return -rig().joint.spring_force_N(S((contraction_ratio - spring_from_) * side_.braid().rest_length_m()));
  }

  /// State at the start of a run: at rest, pressures at the references of the first currents.
  State<double> at_rest(const HeldOf<P>& held) const;

  // What is called at each stage of a step is compiled for one side and for two; without a number it asks.

  /// The balances of the rig. Only for states inside `in_domain`.
  template <int sides, class S, class H>
  Moment<S> moment(const State<S>& state, const Memory<S>& memory, const HeldOf<H>& held) const;
  template <class S, class H>
  Moment<S> moment(const State<S>& state, const Memory<S>& memory, const HeldOf<H>& held) const {
    return opposite_ ? moment<2>(state, memory, held) : moment<1>(state, memory, held);
  }
  /// The same with effects as they are at rest.
  template <class S>
  Moment<S> moment(const State<S>& state, const HeldOf<P>& held) const {
    Memory<S> none;
    none.side.fill(S(0.0));
    none.opposite.fill(S(0.0));
    return moment(state, none, held);
  }

  template <int sides, class S>
  State<S> rates(const State<S>& state, const Moment<S>& now) const;
  template <class S>
  State<S> rates(const State<S>& state, const Moment<S>& now) const {
    return opposite_ ? rates<2>(state, now) : rates<1>(state, now);
  }

  template <int sides, class S>
  Ledger<S> ledger_rates(const State<S>& state, const Moment<S>& now, const Ledger<P>& books) const;
  template <class S>
  Ledger<S> ledger_rates(const State<S>& state, const Moment<S>& now, const Ledger<P>& books) const {
    return opposite_ ? ledger_rates<2>(state, now, books) : ledger_rates<1>(state, now, books);
  }
  /// A ledger as it is opened: nothing has come or gone, and all gas has the walls' temperature.
  Ledger<double> opened(const State<double>& state) const;

  /// Whether every law is defined here: finite, braid neither folded nor torn, pressures above vacuum.
  template <int sides>
  auto in_domain(const State<P>& state) const {
    using std::isfinite;
    const auto one = isfinite(state.joint.contraction_speed_per_s) &&
                     side_.in_domain(state.joint.contraction_ratio, state.side);
    if constexpr (sides == 1)
      return one;
    else
      return one && opposite_->in_domain(opposite_stroke(state).contraction_ratio, state.opposite);
  }
  auto in_domain(const State<P>& state) const {
    return opposite_ ? in_domain<2>(state) : in_domain<1>(state);
  }

  /// Whether something has a memory: an effect that is on, or a regulator.
  bool remembers() const { return memories_ != Memories::none; }
  Memories memories() const { return memories_; }

  /// Whether gas has a temperature of its own, which its ledger follows.
  bool polytropic() const { return polytropic_; }

  /// Exact stick and slip: falls through zero when the slip mode must change. Only with Coulomb friction.
  bool has_events() const { return rig().friction.memory == FrictionMemory::coulomb; }
  double event_margin(const State<double>& state, const Memory<double>& memory, const HeldOf<P>& held) const;
  /// Mode after such an event (or at the start). Sets the speed to exactly zero.
  Slip slip_from_rest(State<double>& state, const Memory<double>& memory, const HeldOf<P>& held) const;

  /// A law of the user's own that is no number here or next to here, memories aside; empty if all are.
  std::string_view law_without_number(const State<double>& state) const;

  /// The joint goes on at another speed [1/s], as a bench that gives the muscle's length makes it; the work
  /// that this takes is the bench's.
  void take_speed(double speed_per_s, State<double>& state, Ledger<double>& books) const;

  const RigOf<P>& rig() const { return side_.rig(); }
  /// Weight [N] of what hangs on the wheel; 0 of a pair.
  const P& weight_N() const { return side_.weight_N(); }
  /// Mass [kg] that moves with the cord, wheel and link as if they were hung there.
  const P& moved_kg() const { return mass_kg_; }
  /// Mass [kg] hung on the wheel, without what hangs there besides; 0 of a pair.
  const P& load_kg() const { return load_kg_; }
  /// Joint angle [rad] of a pair.
  double angle_rad(double contraction_ratio) const {
    return (contraction_ratio - link_.contraction_ratio) * side_.braid().rest_length_m() / radius_m_;
  }
  /// Where the opposite cord's end is.
  template <class S>
  Stroke<S> opposite_stroke(const State<S>& state) const {
    return {link_.opposite_contraction_ratio -
                (state.joint.contraction_ratio - link_.contraction_ratio) * opposite_share_,
            -opposite_share_ * state.joint.contraction_speed_per_s};
  }
  /// Mass of gas [kg] in valves and muscles, at the walls' temperature.
  double gas_mass_kg(const State<double>& state) const;
  /// Kinetic and potential energy of the load [J], zero at rest at e = 0; of a link, at rest where it hangs.
  double mechanical_energy_J(const State<double>& state) const;
  /// What the ledger cannot account for of the way from one state to another.
  Imbalance imbalance(const State<double>& from, const State<double>& to, const Ledger<double>& books) const;

 private:
  template <class S>
  void books_of_gas(const Stroke<S>& stroke, const SideOf<P>& side, const SideState<S>& state,
                    const SideMoment<S>& now, const P& valve_air_kg, const P& muscle_air_kg, Ledger<S>& rates,
                    S& valve_rate, S& muscle_rate) const;
  /// Of the threads of both sides, as the joint feels them.
  template <int sides, class S>
  static S friction_force_N(const Moment<S>& now) {
    if constexpr (sides == 1) return now.friction_force_N;
    return now.friction_force_N - now.opposite.friction_force_N;
  }
  template <int sides, class S>
  static S friction_level_N(const Moment<S>& now) {
    if constexpr (sides == 1) return now.friction_level_N;
    return now.friction_level_N + now.opposite.friction_level_N;
  }
  double friction_force_N(const Moment<double>& now) const {
    return opposite_ ? friction_force_N<2>(now) : friction_force_N<1>(now);
  }
  double friction_level_N(const Moment<double>& now) const {
    return opposite_ ? friction_level_N<2>(now) : friction_level_N<1>(now);
  }
  template <int sides, class S, class H>
  void joint_balance(const State<S>& state, const HeldOf<H>& held, Moment<S>& now) const;

  SideOf<P> side_;
  std::optional<SideOf<P>> opposite_;
  LinkOf<P> link_{};
  Memories memories_;
  bool polytropic_, springs_;  // gas not isothermal, a return spring
  P load_kg_ = 0.0, radius_m_, opposite_share_ = 0.0, mass_kg_, damping_N_s_per_m_;
  P spring_from_ = 0.0;  // the contraction ratio that its rise counts from
};
using Plant = PlantOf<double>;

/// What a rig's mechanics make of it: a load [kg] hangs on one muscle, two turn a link.
inline Plant plant_of(const Rig& rig, double load_kg = 0.0) {
  return rig.pair() != nullptr ? Plant(rig, opposite_rig(rig), *rig.pair()) : Plant(rig, load_kg);
}

template <class P>
PlantOf<P>::PlantOf(const RigOf<P>& rig, const P& load_kg)
    : side_(rig, (load_kg + rig.joint.load_offset_kg) * gravity_m_per_s2),
      memories_(rig.memories()),
      polytropic_(rig.effects.warm()),
      springs_(rig.joint.has_spring()),
      load_kg_(load_kg),
      radius_m_(rig.joint.wheel_radius_m),
      mass_kg_(rig.moved_kg(load_kg)),
      damping_N_s_per_m_(rig.joint.guide_damping_N_s_per_m) {}

template <class P>
PlantOf<P>::PlantOf(const RigOf<P>& rig, const RigOf<P>& opposite, const LinkOf<P>& link)
    : side_(rig, P(0.0)),
      opposite_(std::in_place, opposite, P(0.0)),
      link_(link),
      memories_(std::max(rig.memories(), opposite.memories())),
      polytropic_(rig.effects.warm() || opposite.effects.warm()),
      springs_(rig.joint.has_spring()),
      radius_m_(rig.joint.wheel_radius_m),
      opposite_share_(rig.muscle.rest_length_m / opposite.muscle.rest_length_m),
      mass_kg_((rig.joint.wheel_inertia_kg_m2 + link.inertia_kg_m2) / (radius_m_ * radius_m_) +
               rig.joint.moving_mass_kg),
      damping_N_s_per_m_(link.damping_N_m_s_per_rad / (radius_m_ * radius_m_)),
      spring_from_(link.contraction_ratio) {
  if (rig.friction.memory != opposite.friction.memory)
    throw std::invalid_argument("both sides of a pair have the same friction memory");
  if (any(side_.gas_energy_J_per_kg() != opposite_->gas_energy_J_per_kg()) ||
      any(rig.effects.gas_exponent() != opposite.effects.gas_exponent()))
    throw std::invalid_argument("both sides of a pair have the same gas");
}

template <class P>
template <int sides, class S, class H>
Moment<S> PlantOf<P>::moment(const State<S>& state, const Memory<S>& memory, const HeldOf<H>& held) const {
  Moment<S> now;
  const Stroke<S> stroke{state.joint.contraction_ratio, state.joint.contraction_speed_per_s};
  side_.gas_balance(stroke, state.side, memory.side, held, now);
  if constexpr (sides == 1) {
    if (side_.may_remember()) side_.remember(stroke, state.side, memory.side, held, now.supply_flow, now);
    side_.forces(stroke, state.side, memory.side, held, now);
  } else {
    const Stroke<S> other = opposite_stroke(state);
    opposite_->gas_balance(other, state.opposite, memory.opposite, held.opposite, now.opposite);
    const S drawn = now.supply_flow + now.opposite.supply_flow;  // both hang on one supply
    side_.remember(stroke, state.side, memory.side, held, drawn, now);
    opposite_->remember(other, state.opposite, memory.opposite, held.opposite, drawn, now.opposite);
    side_.forces(stroke, state.side, memory.side, held, now);
    opposite_->forces(other, state.opposite, memory.opposite, held.opposite, now.opposite);
  }
  joint_balance<sides>(state, held, now);
  return now;
}

// Hanging load, or the link that two muscles turn.
template <class P>
template <int sides, class S, class H>
void PlantOf<P>::joint_balance(const State<S>& state, const HeldOf<H>& held, Moment<S>& now) const {
  using std::sin;
  now.guide_force_N = -damping_N_s_per_m_ * now.speed_m_per_s;
  S others = now.braid_force_N + now.stop_force_N + now.guide_force_N - weight_N() + now.effects_pull_N -
             held.joint_force_N;
  now.spring_force_N = S(0.0);
  if (springs_) {
    now.spring_force_N = spring_force_N(state.joint.contraction_ratio);
    others = others + now.spring_force_N;
  }
  if constexpr (sides == 2) {
    const S lean = (state.joint.contraction_ratio - link_.contraction_ratio) *
                       (side_.braid().rest_length_m() / radius_m_) -
                   link_.hangs_at_rad;
    others = others - now.opposite.braid_force_N - now.opposite.stop_force_N - now.opposite.effects_pull_N -
             link_.mass_kg * gravity_m_per_s2 * link_.length_m / radius_m_ * sin(lean);
  }
  if (has_events()) {  // the joint sticks or slips as a whole, the opposite threads the other way
    const S level = friction_level_N<sides>(now);
    S whole = held.slip == Slip::rising ? S(-level) : level;
    if (held.slip == Slip::sticking) whole = held.length_is_given ? S(0.0) : S(-others);
    now.friction_force_N = whole;
    if constexpr (sides == 2) {
      now.friction_force_N = whole * (now.friction_level_N / level);
      now.opposite.friction_force_N = now.friction_force_N - whole;
    }
  }
  const S all = others + friction_force_N<sides>(now);
  now.bench_force_N = (held.length_is_given ? S(-all) : S(0.0)) - held.joint_force_N;
  now.acceleration_m_per_s2 = held.length_is_given ? S(0.0) : S(all / mass_kg_);
}

template <class P>
template <int sides, class S>
State<S> PlantOf<P>::rates(const State<S>& state, const Moment<S>& now) const {
  const S& w = state.joint.contraction_speed_per_s;
  State<S> dt;
  dt.joint.contraction_ratio = w;
  dt.joint.contraction_speed_per_s = now.acceleration_m_per_s2 / side_.braid().rest_length_m();
  dt.side = side_.rates({state.joint.contraction_ratio, w}, state.side, now);
  if constexpr (sides == 2)
    dt.opposite = opposite_->rates(opposite_stroke(state), state.opposite, now.opposite);
  return dt;
}

template <class P>
template <int sides, class S>
Ledger<S> PlantOf<P>::ledger_rates(const State<S>& state, const Moment<S>& now,
                                   const Ledger<P>& books) const {
  const S& v = now.speed_m_per_s;
  const S none = S(0.0);
  Ledger<S> rates{now.supply_flow,
                  now.vent_flow,
                  now.leak_flow,
                  S(now.braid_force_N * v),
                  S(-now.friction_force_N * v),
                  S(-now.guide_force_N * v),
                  S(now.stop_force_N * v),
                  S(now.effects_pull_N * v),
                  S(now.bench_force_N * v),
                  none,
                  none,
                  none,
                  none,
                  none,
                  none,
                  none};
  if constexpr (sides == 2) {
    const SideMoment<S>& other = now.opposite;
    const S& u = other.speed_m_per_s;
    rates.air_drawn_kg = rates.air_drawn_kg + other.supply_flow;
    rates.air_vented_kg = rates.air_vented_kg + other.vent_flow;
    rates.air_leaked_kg = rates.air_leaked_kg + other.leak_flow;
    rates.braid_work_J = rates.braid_work_J + other.braid_force_N * u;
    rates.thread_friction_work_J = rates.thread_friction_work_J - other.friction_force_N * u;
    rates.stop_work_J = rates.stop_work_J + other.stop_force_N * u;
    rates.effects_work_J = rates.effects_work_J + other.effects_pull_N * u;
  }
  if (polytropic_) {
    rates.air_drawn_kg = rates.air_vented_kg = rates.air_leaked_kg = none;
    books_of_gas({state.joint.contraction_ratio, state.joint.contraction_speed_per_s}, side_, state.side, now,
                 books.valve_air_kg, books.muscle_air_kg, rates, rates.valve_air_kg, rates.muscle_air_kg);
    if constexpr (sides == 2)
      books_of_gas(opposite_stroke(state), *opposite_, state.opposite, now.opposite,
                   books.opposite_valve_air_kg, books.opposite_muscle_air_kg, rates,
                   rates.opposite_valve_air_kg, rates.opposite_muscle_air_kg);
  }
  return rates;
}

// With polytropic gas the pressure rates count each flow q as the enthalpy of q at the walls' temperature T.
// Gas of another temperature carries it with another mass: q T/T_gas of the volume it leaves, where
// p V = m R T_gas. Else q is the mass.
template <class P>
template <class S>
void PlantOf<P>::books_of_gas(const Stroke<S>& stroke, const SideOf<P>& side, const SideState<S>& state,
                              const SideMoment<S>& now, const P& valve_air_kg, const P& muscle_air_kg,
                              Ledger<S>& rates, S& valve_rate, S& muscle_rate) const {
  const P &atmosphere = side.rig().gas.atmosphere_Pa, &RT = side.gas_energy_J_per_kg();
  const S muscle_Pa = state.muscle_pressure_Pa + atmosphere;
  S in_valve = S(1.0), in_muscle = S(1.0);  // T/T_gas
  if (any(side.rig().effects.gas_exponent() != 1.0)) {
    in_valve = valve_air_kg * RT / ((state.valve_pressure_Pa + atmosphere) * side.rig().valve.volume_m3);
    in_muscle = muscle_air_kg * RT / (muscle_Pa * now.volume_m3);
  }
  const auto carried = [](const S& flow, const S& from, const S& back) {
    return S(flow * select(flow < 0.0, back, from));
  };
  const S outside = S(1.0);
  const S drawn = carried(now.supply_flow, outside, in_valve);
  const S vented = carried(now.vent_flow, in_valve, outside);
  const S leaked = carried(now.leak_flow, in_muscle, outside);
  const S through_hose = carried(now.hose_flow, in_valve, in_muscle);
  rates.air_drawn_kg = rates.air_drawn_kg + drawn;
  rates.air_vented_kg = rates.air_vented_kg + vented;
  rates.air_leaked_kg = rates.air_leaked_kg + leaked;
  valve_rate = drawn - vented - through_hose;
  muscle_rate = through_hose - leaked;
  rates.air_inflow_J = rates.air_inflow_J + RT * (now.supply_flow - now.vent_flow - now.leak_flow);
  rates.gas_work_J = rates.gas_work_J + muscle_Pa * now.volume_slope_m3 * stroke.speed_per_s;
  rates.gas_heat_J = rates.gas_heat_J + now.volume_m3 * now.heating_Pa_per_s;
}

}  // namespace mckibben::plant
