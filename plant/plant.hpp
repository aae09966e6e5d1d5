// The nominal plant: one muscle side that lifts a hanging load, or two that pull on one wheel against each
// other (T 2.7). What one side is stands in side.hpp, docs/equations.md has it all.
//
//   State, Memory, Held --(moment)--> Moment: all that is known at this instant --(rates)--> dx/dt
//
// The joint moves as the first muscle contracts, x = (e - e10) l0; a second one, `opposite`, is stretched by
// as much:
//   e2 = e20 - x/l02    theta = x/R, or as a lever turns (lever.hpp)
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
  S joint_stop_force_N;     // of the ends of the joint's way, the same
  S bench_force_N;          // of what gives the muscle its length, or pulls on the joint from outside
  S acceleration_m_per_s2;  // dv/dt
  SideMoment<S> opposite;
};

template <class P>
class PlantOf {
 public:
  /// The rig with a load [kg] hung on it. The rig's values are taken as checked.
  PlantOf(const RigOf<P>& rig, const P& load_kg);
  /// The same with the load on a lever that the muscle turns.
  PlantOf(const RigOf<P>& rig, const P& load_kg, const LeverOf<P>& lever);
  /// Two rigs' sides on the wheel of the first. Throws std::invalid_argument unless both have the same kind
  /// of friction memory and breathe the same gas.
  PlantOf(const RigOf<P>& rig, const RigOf<P>& opposite, const LinkOf<P>& link);

  /// Gauge pressure [Pa] the valve is asked for at a current [mA] (T 3.2), clamped to its trimmed range.
  double reference_pressure_Pa(double current_mA) const { return side_.reference_pressure_Pa(current_mA); }
  const SideOf<P>& side() const { return side_; }
  const std::optional<SideOf<P>>& opposite() const { return opposite_; }
  const LinkOf<P>& link() const { return link_; }
  const std::optional<LeverOf<P>>& lever() const { return lever_; }
  /// What returns the joint [N], at a contraction ratio of the (first) muscle.
  template <class S>
  S spring_force_N(const S& contraction_ratio) const {
    const S rise = rise_m(contraction_ratio);
    if (!lever_) return -rig().joint.spring().pull(rise);
    const Stand<S> stand = turning_->at(rise);
    return -lever_->spring().pull(stand.angle_rad) / stand.arm_m;
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
  Ledger<double> opened(const State<double>& state, const Memory<double>& memory = {}) const;

  /// Whether every law is defined here: finite, braid neither folded nor torn, pressures above vacuum.
  template <int sides>
  auto in_domain(const State<P>& state, const Memory<P>& memory) const {
    using std::isfinite;
    const auto one = isfinite(state.joint.contraction_speed_per_s) &&
                     side_.in_domain(joint_stroke(state), state.side, memory.side);
    if constexpr (sides == 1)
      return turning_ ? decltype(one)(one && turning_->in_domain(rise_m(state.joint.contraction_ratio)))
                      : one;
    else
      return one && opposite_->in_domain(opposite_stroke(state), state.opposite, memory.opposite);
  }
  auto in_domain(const State<P>& state, const Memory<P>& memory = {}) const {
    return opposite_ ? in_domain<2>(state, memory) : in_domain<1>(state, memory);
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
  /// Weight [N] of what hangs on the wheel or on the lever; 0 of a pair.
  const P& weight_N() const { return side_.weight_N(); }
  /// Mass [kg] that moves with the cord, wheel and link as if they were hung there; a lever apart.
  const P& moved_kg() const { return mass_kg_; }
  /// The same with the lever, as it is felt at a contraction ratio.
  double moved_kg(double contraction_ratio) const {
    if (!lever_) return mass_kg_;
    const double arm_m = turning_->at(rise_m(contraction_ratio)).arm_m;
    return mass_kg_ + inertia_kg_m2_ / (arm_m * arm_m);
  }
  /// Mass [kg] that is hung on the rig, without what hangs there besides; 0 of a pair.
  const P& load_kg() const { return load_kg_; }
  /// Whether the joint's angle is what is read, and not the height of a load.
  bool has_angle() const { return opposite_ || lever_; }
  /// Joint angle [rad], its speed for a speed of the contraction ratio, and the arm [m] of the (first) cord.
  double angle_rad(double contraction_ratio) const {
    const double rise = (contraction_ratio - mounted_) * side_.braid().rest_length_m();
    return lever_ ? turning_->at(rise).angle_rad : rise / radius_m_;
  }
  double angle_speed_rad_per_s(const JointState<double>& joint) const {
    return side_.braid().rest_length_m() / arm_m(joint.contraction_ratio) * joint.contraction_speed_per_s;
  }
  /// The same in rest lengths.
  double shown_ratio(double contraction_ratio) const {
    return lever_ ? shown_m(contraction_ratio) / side_.braid().rest_length_m() : contraction_ratio - mounted_;
  }
  double shown_speed_m_per_s(const JointState<double>& joint) const {
    return lever_ ? radius_m_ * angle_speed_rad_per_s(joint)
                  : joint.contraction_speed_per_s * side_.braid().rest_length_m();
  }
  double arm_m(double contraction_ratio) const {
    return lever_ ? turning_->at(rise_m(contraction_ratio)).arm_m : radius_m_;
  }
  double arm_at_rest_m() const { return arm_m(mounted_); }
  /// What the wheel that reads the joint shows [m]: the rise of the cord, of a lever its angle on that wheel.
  double shown_m(double contraction_ratio) const {
    return lever_ ? radius_m_ * angle_rad(contraction_ratio) : rise_m(contraction_ratio);
  }
  /// How the cord has risen since the muscle was mounted.
  template <class S>
  S rise_m(const S& contraction_ratio) const {
    return (contraction_ratio - mounted_) * side_.braid().rest_length_m();
  }
  /// The contraction ratio of a joint angle [rad].
  double ratio_at_rad(double angle_rad) const {
    const double rise = lever_ ? turning_->rise_m(angle_rad) : radius_m_ * angle_rad;
    return mounted_ + rise / side_.braid().rest_length_m();
  }
  /// Where the joint has the cord's end, and the opposite one's.
  template <class S>
  static Stroke<S> joint_stroke(const State<S>& state) {
    return {state.joint.contraction_ratio, state.joint.contraction_speed_per_s};
  }
  template <class S>
  Stroke<S> opposite_stroke(const State<S>& state) const {
    return {link_.opposite_contraction_ratio -
                (state.joint.contraction_ratio - link_.contraction_ratio) * opposite_share_,
            -opposite_share_ * state.joint.contraction_speed_per_s};
  }
  /// Mass of gas [kg] in valves and muscles, at the walls' temperature.
  double gas_mass_kg(const State<double>& state, const Memory<double>& memory = {}) const;
  /// Kinetic and potential energy of the load [J], zero at rest at e = 0; of a link, at rest where it hangs;
  /// and of cords that stretch.
  double mechanical_energy_J(const State<double>& state, const Memory<double>& memory = {}) const;
  /// What the ledger cannot account for of the way from one state to another; of memories, that of cords
  /// counts.
  Imbalance imbalance(const State<double>& from, const State<double>& to, const Ledger<double>& books,
                      const Memory<double>& memory_from = {}, const Memory<double>& memory_to = {}) const;

 private:
  template <class S>
  void books_of_gas(const SideOf<P>& side, const SideState<S>& state, const SideMoment<S>& now,
                    const P& valve_air_kg, const P& muscle_air_kg, Ledger<S>& rates, S& valve_rate,
                    S& muscle_rate) const;
  /// Of the threads of both sides, as the joint feels them.
  template <int sides, class S>
  S friction_force_N(const Moment<S>& now) const {
    if constexpr (sides == 1) return side_.felt_friction_N(now);
    return side_.felt_friction_N(now) - opposite_->felt_friction_N(now.opposite);
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
  /// What a lever adds to the other forces at the cord, and to the mass that moves there.
  template <class S>
  void lever_balance(const Stand<S>& stand, const S& v, const S& outer_N, Moment<S>& now, S& others,
                     S& mass_kg) const;
  template <class S>
  S joint_stop_force_N(const S& rise_m, const S& speed_m_per_s) const;
  void take_stops();

  SideOf<P> side_;
  std::optional<SideOf<P>> opposite_;
  LinkOf<P> link_{};
  std::optional<LeverOf<P>> lever_{};
  std::optional<TurningOf<P>> turning_{};
  Memories memories_;
  bool polytropic_, springs_;  // gas not isothermal, a return spring
  bool stops_ = false;         // the joint's way has ends
  P load_kg_ = 0.0, radius_m_, opposite_share_ = 0.0, mass_kg_, damping_N_s_per_m_;
  P mounted_ = 0.0;                                  // the contraction ratio that the cord's rise counts from
  P hanging_N_ = 0.0;                                // straight on the cord
  P inertia_kg_m2_ = 0.0, weight_moment_N_m_ = 0.0;  // of a lever with its load
  P lowest_m_ = 0.0, highest_m_ = 0.0;               // rise of the cord at the joint's stops
};
using Plant = PlantOf<double>;

/// What a rig's mechanics make of it: a load [kg] hangs on one muscle, two turn a link.
inline Plant plant_of(const Rig& rig, double load_kg = 0.0) {
  if (rig.pair() != nullptr) return Plant(rig, opposite_rig(rig), *rig.pair());
  return rig.lever() != nullptr ? Plant(rig, load_kg, *rig.lever()) : Plant(rig, load_kg);
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
      damping_N_s_per_m_(rig.joint.guide_damping_N_s_per_m),
      hanging_N_(side_.weight_N()) {
  take_stops();
}

template <class P>
PlantOf<P>::PlantOf(const RigOf<P>& rig, const P& load_kg, const LeverOf<P>& lever) : PlantOf(rig, load_kg) {
  const P hung_kg = load_kg + rig.joint.load_offset_kg;
  lever_ = lever;
  turning_.emplace(lever);
  mounted_ = lever.contraction_ratio;
  mass_kg_ = rig.joint.moving_mass_kg;
  damping_N_s_per_m_ = P(0.0);
  hanging_N_ = P(0.0);
  springs_ = lever.spring().is_there();
  inertia_kg_m2_ =
      lever.inertia_kg_m2 + rig.joint.wheel_inertia_kg_m2 + hung_kg * lever.load_at_m * lever.load_at_m;
  if (lever.plane == Plane::vertical)
    weight_moment_N_m_ = gravity_m_per_s2 * (lever.mass_kg * lever.centre_m + hung_kg * lever.load_at_m);
  take_stops();
}

template <class P>
void PlantOf<P>::take_stops() {
  const JointOf<P>& joint = rig().joint;
  const bool angles = has_angle();
  stops_ = angles ? joint.has_angle_stops() : joint.has_contraction_stops();
  constexpr double far_m = 1e6;
  const auto at = [&](const P& angle_rad, const P& ratio) {
    if (!angles) return rise_m(ratio);
    return lever_ ? turning_->rise_m(angle_rad) : P(radius_m_ * angle_rad);
  };
  const auto &low = angles ? joint.lowest_rad : joint.lowest_ratio,
             &high = angles ? joint.highest_rad : joint.highest_ratio;
  const auto& nowhere = angles ? joint.nowhere_rad : joint.nowhere_ratio;
  lowest_m_ = select(low > nowhere[0], at(joint.lowest_rad, joint.lowest_ratio), P(-far_m));
  highest_m_ = select(high < nowhere[1], at(joint.highest_rad, joint.highest_ratio), P(far_m));
}

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
      mounted_(link.contraction_ratio) {
  take_stops();
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
  const Stroke<S> stroke = side_.stroke(joint_stroke(state), memory.side);
  side_.gas_balance(stroke, state.side, memory.side, held, now);
  if constexpr (sides == 1) {
    if (side_.may_remember()) side_.remember(stroke, state.side, memory.side, held, now.supply_flow, now);
    side_.forces(stroke, state.side, memory.side, held, now);
  } else {
    const Stroke<S> other = opposite_->stroke(opposite_stroke(state), memory.opposite);
    opposite_->gas_balance(other, state.opposite, memory.opposite, held.opposite, now.opposite);
    const S drawn = now.supply_flow + now.opposite.supply_flow;  // both hang on one supply
    side_.remember(stroke, state.side, memory.side, held, drawn, now);
    opposite_->remember(other, state.opposite, memory.opposite, held.opposite, drawn, now.opposite);
    side_.forces(stroke, state.side, memory.side, held, now);
    opposite_->forces(other, state.opposite, memory.opposite, held.opposite, now.opposite);
  }
  if (side_.stretches()) side_.stretch(joint_stroke(state), state.side, memory.side, held, now);
  if constexpr (sides == 2)
    if (opposite_->stretches())
      opposite_->stretch(opposite_stroke(state), state.opposite, memory.opposite, held.opposite,
                         now.opposite);
  joint_balance<sides>(state, held, now);
  return now;
}

template <class P>
template <int sides, class S>
State<S> PlantOf<P>::rates(const State<S>& state, const Moment<S>& now) const {
  const S& w = state.joint.contraction_speed_per_s;
  State<S> dt;
  dt.joint.contraction_ratio = w;
  dt.joint.contraction_speed_per_s = now.acceleration_m_per_s2 / side_.braid().rest_length_m();
  dt.side = side_.rates(state.side, now);
  if constexpr (sides == 2) dt.opposite = opposite_->rates(state.opposite, now.opposite);
  return dt;
}

}  // namespace mckibben::plant

#include <plant/books.hpp>
#include <plant/joint_balance.hpp>
