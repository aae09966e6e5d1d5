// A rig as its file describes it, with the values of the shipped rig `thesis` as defaults: muscle
// (muscle.hpp), valve and hose (valve.hpp), gas, joint and instruments, what the muscle pulls on
// (mechanics.hpp), and how its equations are solved. Laws that use them stand in the files beside this one.
//
// Each struct lists its fields once, in `fields`: key, member, unit, smallest and largest value, meaning.
// Reading, writing, checking, documentation and schema all walk that list. A visitor is anything that can be
// called so; `rules` holds what must be true between fields. SI inside; the unit is in the member's name.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include <plant/effects.hpp>
#include <plant/geometry.hpp>
#include <plant/lever.hpp>
#include <plant/mechanics.hpp>
#include <plant/muscle.hpp>
#include <plant/sensors.hpp>
#include <plant/solver.hpp>
#include <plant/valve.hpp>

namespace mckibben::plant {

/// The gas and what surrounds it: isothermal ideal air.
template <class P>
struct GasOf {
  P gas_constant_J_per_kg_K = 287.05;
  P temperature_K = 293.15;
  P reference_density_kg_per_m3 = 1.185;
  P atmosphere_Pa = 101325.0;

  static void fields(auto& self, auto& visit) {
    visit("gas_constant", self.gas_constant_J_per_kg_K, "J/(kg.K)", 50.0, 5000.0, "specific gas constant R");
    visit("temperature", self.temperature_K, "K", 200.0, 400.0, "temperature of all gas, T");
    visit("reference_density", self.reference_density_kg_per_m3, "kg/m3", 0.05, 10.0,
          "ISO 6358 reference, rho0");
    visit("atmosphere", self.atmosphere_Pa, "Pa", 1e4, 2e5, "absolute pressure of the surroundings");
  }
};
using Gas = GasOf<double>;

/// What the muscle moves: hanging load on a wheel, the guide it runs in, a return spring and the ends of its
/// way.
template <class P>
struct JointOf {
  P wheel_radius_m = 0.030;
  P wheel_inertia_kg_m2 = 1.0e-4;
  P guide_damping_N_s_per_m = 20.0;
  P load_offset_kg = 0.0;
  P moving_mass_kg = 0.0;
  P spring_N_per_m = 0.0, spring_preload_N = 0.0;
  SpringWays spring_ways = SpringWays::both;
  P length_offset_m = 0.0;
  P reading_offset_m = 0.0;
  P lowest_ratio = nowhere_ratio[0], highest_ratio = nowhere_ratio[1];
  P lowest_rad = nowhere_rad[0], highest_rad = nowhere_rad[1];
  P stop_N_per_m = 3.0e5, stop_damping_s_per_m = 19.0;

  /// Ends that no joint gets to.
  static constexpr std::array nowhere_ratio{-1.0, 1.0}, nowhere_rad{-180.0 * degree_rad, 180.0 * degree_rad};

  static void fields(auto& self, auto& visit) {
    visit("wheel_radius", self.wheel_radius_m, "m", 1e-3, 1.0, "radius of the joint's wheel, R_w");
    visit("wheel_inertia", self.wheel_inertia_kg_m2, "kg.m2", 0.0, 10.0, "its moment of inertia, J");
    visit("guide_damping", self.guide_damping_N_s_per_m, "N.s/m", 0.0, 1e5,
          "viscous friction of the load guide, c");
    visit("load_offset", self.load_offset_kg, "kg", -5.0, 5.0,
          "mass on the wheel in addition to the load: hook, cord, error of the scales");
    visit("moving_mass", self.moving_mass_kg, "kg", 0.0, 500.0,
          "mass that moves with the cord and has no weight: a slide");
    visit("spring", self.spring_N_per_m, "N/m", 0.0, 1e7,
          "return spring at the cord (of the wheel: N.m/rad over wheel_radius^2)");
    visit("spring_preload", self.spring_preload_N, "N", -1e5, 1e5,
          "its force at rest length, of a pair at angle 0");
    visit("spring_ways", self.spring_ways, "one: it only pulls");
    visit("length_offset", self.length_offset_m, "m", -0.1, 0.1,
          "by how much a muscle whose length is given is shorter than is said: zero of the bench, clamps");
    visit("reading_offset", self.reading_offset_m, "m", -0.1, 0.1,
          "by how much the load is read higher than it stands: zero of a laser or a potentiometer");
    visit("lowest_contraction", self.lowest_ratio, "1", nowhere_ratio[0], nowhere_ratio[1],
          "a stop holds the load there; -1: nowhere");
    visit("highest_contraction", self.highest_ratio, "1", nowhere_ratio[0], nowhere_ratio[1],
          "the same above it; 1: nowhere");
    visit("lowest_angle", self.lowest_rad, "rad", nowhere_rad[0], nowhere_rad[1],
          "the same of a pair or a lever; -180 deg: nowhere");
    visit("highest_angle", self.highest_rad, "rad", nowhere_rad[0], nowhere_rad[1], "180 deg: nowhere");
    visit("stop_stiffness", self.stop_N_per_m, "N/m", 1e3, 1e8, "of both stops, as at the cord");
    visit("stop_damping", self.stop_damping_s_per_m, "s/m", 0.0, 1e3, "Hunt-Crossley");
  }

  /// What returns the cord, over its rise.
  SpringOf<P> spring() const { return {spring_preload_N, spring_N_per_m, spring_ways}; }
  bool has_spring() const { return spring().is_there(); }
  bool has_angle_stops() const {
    return any(lowest_rad > nowhere_rad[0]) || any(highest_rad < nowhere_rad[1]);
  }
  bool has_contraction_stops() const {
    return any(lowest_ratio > nowhere_ratio[0]) || any(highest_ratio < nowhere_ratio[1]);
  }
  void rules(auto& report) const {
    if (lowest_ratio >= highest_ratio) report("highest_contraction", "must be above lowest_contraction");
    if (lowest_rad >= highest_rad) report("highest_angle", "must be above lowest_angle");
  }
};
using Joint = JointOf<double>;

/// Digital-to-analogue converter that drives the valve (T 3.1; the 12 bits are an assumption).
struct Dac {
  double lowest_command = 0.0, largest_command = 20.0;
  int bits = 12;

  static void fields(auto& self, auto& visit) {
    visit("lowest_command", self.lowest_command, "mA", 0.0, 100.0,
          "bottom of its range, put out when all ends; in V or bar 0, or zero_command where that is below");
    visit("largest_command", self.largest_command, "mA", 0.1, 100.0,
          "top of its range; in V or bar the valve's span_command if left out");
    visit("bits", self.bits, 4, 24, "resolution: steps of the range / 2^bits");
  }
  void rules(auto& report) const {
    if (largest_command <= lowest_command) report("largest_command", "must be above lowest_command");
  }
};

/// How well parameters are known: standard deviations [in the field's SI unit] by path of keys,
/// `muscle.rest_radius`. Infinite: unknown. Of what is not listed nothing is stated.
using Spreads = std::map<std::string, double, std::less<>>;

/// The whole rig: the parts of one muscle's side and the joint it moves, what it pulls on, how well its
/// parameters are known, and how its equations are solved. Of P are the parts that laws calculate with.
template <class P>
struct RigOf {
  static constexpr bool by_name = true;  ///< other files may name it, or its path
  /// No valve or hose is quicker than this, and no step of a solver should have to be.
  static constexpr double quickest_s = 1e-6;

  MuscleOf<P> muscle;
  FrictionOf<P> friction;
  ValveOf<P> valve;
  HoseOf<P> hose;
  GasOf<P> gas;
  JointOf<P> joint;
  Dac dac;
  Sensors sensors;
  EffectsOf<P> effects;
  double tick_s = 0.012;
  double settling_time_s = 2.004;
  Mechanics mechanics;
  solver::Settings integrator;
  Spreads spreads;  ///< `6 mm ± 0.1 mm`

  /// The second muscle and the link, or null.
  const Pair* pair() const { return std::get_if<Pair>(&mechanics); }
  Pair* pair() { return std::get_if<Pair>(&mechanics); }
  /// What one muscle turns, or null.
  const Lever* lever() const { return std::get_if<Lever>(&mechanics); }
  Lever* lever() { return std::get_if<Lever>(&mechanics); }
  /// Whether the joint's angle is what is read and wanted, and not the height of a load.
  bool has_angle() const { return pair() != nullptr || lever() != nullptr; }
  bool lifts_a_load() const { return std::holds_alternative<HangingLoad>(mechanics) || lever() != nullptr; }
  bool holds_a_length() const { return std::holds_alternative<HeldLength>(mechanics); }
  /// Mass [kg] that moves with the cord under a load, the wheel as if it hung there.
  P moved_kg(const P& load_kg) const {
    return load_kg + joint.load_offset_kg + joint.moving_mass_kg +
           joint.wheel_inertia_kg_m2 / (joint.wheel_radius_m * joint.wheel_radius_m);
  }
  /// What pulls at the muscle at rest length under a load, with a return spring, as a load [kg].
  double pulled_kg(double load_kg) const {
    if (lever() != nullptr) return pulled_by_lever_kg(*this, load_kg);
    return load_kg + joint.load_offset_kg + joint.spring().pull(0.0) / gravity_m_per_s2;
  }
  /// Whether a load can hang there: it does not pull upwards, and something moves.
  bool can_hang(double load_kg) const {
    return load_kg + joint.load_offset_kg >= 0.0 && (lever() != nullptr || moved_kg(load_kg) > 0.0);
  }

  static void fields(auto& self, auto& visit) {
    parts(self, visit);
    visit("mechanics", self.mechanics,
          "what the muscle pulls on: hanging_load (if left out), lever (docs/lever.md), held_length or pair "
          "(docs/two_muscles.md)");
    visit("integrator", self.integrator, "how the equations are solved");
  }
  static void parts(auto& self, auto& visit) {
    visit("muscle", self.muscle, "braid and tube");
    visit("friction", self.friction, "thread friction");
    visit("valve", self.valve, "what fills the muscle and vents it, and supply");
    visit("hose", self.hose, "hose from valve to muscle");
    visit("gas", self.gas, "air and atmosphere");
    visit("joint", self.joint, "wheel, inertia and load guide");
    visit("dac", self.dac, "output of commands");
    visit("sensors", self.sensors,
          "what reads the rig, one for each signal; those of the base that are not named here stay, "
          "`kind: none` takes one away");
    visit("effects", self.effects, "what the nominal rig leaves out; each absent unless given a size");
    visit("tick", self.tick_s, "s", 1e-4, 1.0, "time between two readings; the command is held in between");
    visit("settling_time", self.settling_time_s, "s", 0.0, 1000.0,
          "how long the first command is held before the first reading (rounded to ticks)");
  }
  CommandUnit command_unit() const { return valve.command_unit; }
  /// What of it has a memory: effects, laws, a regulator that swings, or a cord that stretches.
  Memories memories() const {
    return std::max({effects.memories_used(), valve.swings() ? Memories::few : Memories::none,
                     any(!muscle.cord.absent()) ? Memories::all : Memories::none});
  }
  bool remembers() const { return memories() != Memories::none; }

  void rules(auto& report) const {
    side_rules(report);
    if (holds_a_length() && joint.has_spring())
      report("joint", "spring and spring_preload act on a joint that moves, not on a muscle of held_length");
    if (joint.has_angle_stops() && !has_angle())
      report("joint",
             "lowest_angle and highest_angle are of a pair or a lever: say lowest_contraction, "
             "highest_contraction");
    if (joint.has_contraction_stops() && !std::holds_alternative<HangingLoad>(mechanics))
      report("joint", has_angle() ? "lowest_contraction and highest_contraction are of a hanging load: say "
                                    "lowest_angle, highest_angle"
                                  : "stops are of a joint that moves, not of a muscle of held_length");
    if (lever() != nullptr) lever_rules(*this, report);
    if (pair() == nullptr) return;
    pair_rules(report);
  }

 private:
  /// Threads stick where the joint does, unless a bristle follows them; volumes must not fill in no time.
  void side_rules(auto& report) const {
    if (!muscle.cord.absent() && friction.memory == FrictionMemory::coulomb)
      report(
          "muscle",
          "on a cord that stretches its threads stick and slip apart from the joint, which friction.memory: "
          "lugre can follow, coulomb cannot");
    if (valve.seals()) return;
    const double supply_Pa = valve.supply_pressure_Pa + gas.atmosphere_Pa;
    const double volume_rate_m3_per_s_Pa =
        gas.gas_constant_J_per_kg_K * gas.temperature_K * gas.reference_density_kg_per_m3;
    const auto filling_s = [&](double conductance_m3_per_s_Pa, double volume_m3, double difference_Pa) {
      return volume_m3 * difference_Pa / (volume_rate_m3_per_s_Pa * conductance_m3_per_s_Pa * supply_Pa);
    };
    const double conductance = std::max(valve.conductance_m3_per_s_Pa,
                                        valve.is_servo() ? 0.0 : valve.venting_conductance_m3_per_s_Pa);
    const double band_Pa = valve.is_servo() ? valve.proportional_band_Pa : hose.linear_zone_Pa;
    if (filling_s(conductance, valve.volume_m3, band_Pa) < quickest_s)
      report(
          "valve",
          !valve.is_servo()
              ? "open, it would move its volume by a whole linear_zone of the hose in less than 1 us: take a "
                "smaller conductance, a larger volume or a wider linear_zone"
              : "the open valve would move its volume by a whole proportional_band in less than 1 us: take a "
                "smaller conductance, a larger volume or a wider proportional_band");
    if (filling_s(hose.conductance_m3_per_s_Pa, valve.volume_m3, hose.linear_zone_Pa) < quickest_s)
      report("hose",
             "it would move the valve's volume by a whole linear_zone in less than 1 us: take a smaller "
             "conductance, a larger linear_zone or a larger volume of the valve");
  }

  /// What must be true between the sides of a pair.
  void pair_rules(auto& report) const {
    const OppositeSide& two = pair()->opposite;
    if (valve.seals() || two.valve.seals())
      report("mechanics",
             "a sealed muscle, valve: {kind: none}, is of rigs with one muscle: a pair has a command for "
             "each of two valves");
    if (friction.memory != two.friction.memory)
      report("mechanics", "friction.memory must be the same on both sides of a pair");
    if (effects.gas_exponent() != two.effects.gas_exponent())
      report("mechanics", "effects.polytropic_gas must be the same on both sides of a pair");
    if (valve.supply_pressure_Pa != two.valve.supply_pressure_Pa)
      report("mechanics",
             "valve.supply_pressure must be the same on both sides of a pair: there is one supply");
    const auto tank = [](const Effects& of) {
      const auto& one = of.get<SupplyDroop>();
      return std::array{one.volume_m3, one.line_resistance_s_Pa_per_kg, one.exponent};
    };
    if (tank(effects) != tank(two.effects))
      report("mechanics",
             "effects.supply_droop must be the same on both sides of a pair: both draw from one tank");
    if (!effects.template get<GuideFriction>().absent() || !two.effects.get<GuideFriction>().absent())
      report("mechanics", "effects.guide_friction is of a hanging load's guide, which a pair has not");
    if (pair()->contraction_ratio >= Braid(muscle).largest_contraction_ratio())
      report("mechanics", "contraction_1 is more than muscle 1 can contract (T 2.10)");
    if (pair()->opposite_contraction_ratio >= Braid(two.muscle).largest_contraction_ratio())
      report("mechanics", "contraction_2 is more than muscle 2 can contract (T 2.10)");
    const auto of_two = [&](std::string_view, std::string_view message) {
      report("mechanics", std::string("the side of muscle 2: ").append(message));
    };
    opposite_rig(*this).side_rules(of_two);
  }
};
using Rig = RigOf<double>;

/// A side (a rig, or the second muscle's) with a valve that is commanded otherwise: friction is as it was at
/// the same speeds of the pressure. The caller sees to it that the span is above zero.
void command_in(auto& side, CommandUnit unit, double zero, double span) {
  const double ratio = (side.valve.span_command - side.valve.zero_command) / (span - zero);
  side.friction.f1_s2_per_mA2 *= ratio * ratio;
  side.valve.command_unit = unit;
  side.valve.zero_command = zero;
  side.valve.span_command = span;
}

/// The range of its own unit: the thesis's in mA, in another the valve's, with 0 in it.
inline Dac dac_for(const Valve& valve) {
  if (valve.command_unit == CommandUnit::mA) return {};
  return {.lowest_command = std::min(0.0, valve.zero_command), .largest_command = valve.span_command};
}

/// A rig as its owner believes it to be: without effects, and with nothing beside the load on the wheel.
inline Rig nominal(Rig rig) {
  rig.effects = {};
  rig.joint.load_offset_kg = 0.0;
  if (Pair* pair = rig.pair()) pair->opposite.effects = {};
  return rig;
}

inline OppositeSide side_of(const Rig& rig) {
  return {rig.muscle, rig.friction, rig.valve, rig.hose, rig.effects};
}

/// Two muscles on one wheel: this rig's, and against it that of the other.
inline Rig pair_of(Rig rig, const Rig& opposite, const Link& link = {}) {
  rig.mechanics = Pair{link, side_of(opposite)};
  return rig;
}

/// The shipped rig of that name: two of the thesis's muscles on one wheel.
inline Rig thesis_pair() {
  return pair_of({}, {});
}

/// The second side with all that both share, as a rig of its own. Of a pair only.
inline Rig opposite_rig(const Rig& rig) {
  const Pair& pair = *rig.pair();
  Rig other = rig;
  other.mechanics = HangingLoad{};
  other.muscle = pair.opposite.muscle;
  other.friction = pair.opposite.friction;
  other.valve = pair.opposite.valve;
  other.hose = pair.opposite.hose;
  other.effects = pair.opposite.effects;
  return other;
}

}  // namespace mckibben::plant

#include <plant/lever_rules.hpp>
