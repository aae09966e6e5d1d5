// The rig's parameters: muscle, friction, valve, hose, gas, joint and instruments, with the values of the
// shipped rig `thesis` as defaults. Laws that use them stand in the files beside this one.
//
// Each struct lists its fields once, in `fields`: key, member, unit, smallest and largest value, meaning.
// Reading, writing, checking, documentation and schema all walk that list. A visitor is anything that can be
// called so; `rules` holds what must be true between fields. SI inside; the unit is in the member's name.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <plant/command.hpp>
#include <plant/effects.hpp>
#include <plant/sensors.hpp>

namespace mckibben::plant {

inline constexpr double gravity_m_per_s2 = 9.80665;
inline constexpr double Pa_per_bar = 1e5;
inline constexpr double degree_rad = std::numbers::pi / 180.0;

/// How the thread contact surface is computed (T 4.3):
/// `squared` is exact geometry, `printed` as the thesis prints it.
enum class ContactSurface { squared, printed };
constexpr auto names(ContactSurface) {
  using enum ContactSurface;
  return std::array{std::pair{squared, std::string_view{"squared"}},
                    std::pair{printed, std::string_view{"printed"}}};
}

/// Which law gives the friction level from normal force and contact (T 4.6; T 1.1, 1.2, 1.3).
enum class FrictionLaw { superposition, area, logarithmic, power };
constexpr auto names(FrictionLaw) {
  using enum FrictionLaw;
  return std::array{
      std::pair{superposition, std::string_view{"superposition"}}, std::pair{area, std::string_view{"area"}},
      std::pair{logarithmic, std::string_view{"logarithmic"}}, std::pair{power, std::string_view{"power"}}};
}

/// What happens inside the friction level: a bristle that remembers (LuGre),
/// or exact stick and slip (Coulomb).
enum class FrictionMemory { lugre, coulomb };
constexpr auto names(FrictionMemory) {
  using enum FrictionMemory;
  return std::array{std::pair{lugre, std::string_view{"lugre"}},
                    std::pair{coulomb, std::string_view{"coulomb"}}};
}

/// How the encoder's pulses are counted: floor of the position,
/// or the thesis's two crosswise counters (T 3.1).
enum class EncoderWiring { ideal, crosswise };
constexpr auto names(EncoderWiring) {
  using enum EncoderWiring;
  return std::array{std::pair{ideal, std::string_view{"ideal"}},
                    std::pair{crosswise, std::string_view{"crosswise"}}};
}

/// What keeps the pressure: the thesis's servo valve, whose proportional band makes its dynamics, or a
/// regulator of which a data sheet tells the lag.
enum class ValveKind { servo, regulator };
constexpr auto names(ValveKind) {
  using enum ValveKind;
  return std::array{std::pair{servo, std::string_view{"servo"}},
                    std::pair{regulator, std::string_view{"regulator"}}};
}
/// Every valve is a servo valve unless it says otherwise.
constexpr bool absent(ValveKind kind) {
  return kind == ValveKind::servo;
}

/// How a regulator's pressure follows its command.
enum class RegulatorLag { first_order, second_order };
constexpr auto names(RegulatorLag) {
  using enum RegulatorLag;
  return std::array{std::pair{first_order, std::string_view{"first_order"}},
                    std::pair{second_order, std::string_view{"second_order"}}};
}

/// Whether a visitor of a field list wants fields as well that the struct's own choices rule out.
template <class Visitor>
concept ListsAll = requires {
  requires Visitor::lists_all;
};

/// Braid and tube of one muscle (T 2.4 to 2.10).
template <class P>
struct MuscleOf {
  P rest_length_m = 0.300;
  P rest_radius_m = 7.5e-3;
  P braid_angle_rad = 20.0 * degree_rad;
  P end_correction = 1.30;
  P dead_volume_m3 = 5.0e-6;
  P stop_stiffness_N_per_m = 3.0e5;
  P stop_damping_s_per_m = 19.0;
  ContactSurface contact_surface = ContactSurface::squared;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("rest_length", self.rest_length_m, "m", 0.01, 5.0, "length at rest, l0 (T 2.4)");
    visit("rest_radius", self.rest_radius_m, "m", 5e-4, 0.2, "radius at rest, r0 (T 2.5)");
    visit("braid_angle", self.braid_angle_rad, "rad", 5.0 * degree_rad, 50.0 * degree_rad,
          "angle between thread and axis at rest, alpha0 (T 2.6)");
    visit("end_correction", self.end_correction, "1", 1.0, 2.5, "correction for the conical ends, k (T 2.8)");
    visit("dead_volume", self.dead_volume_m3, "m3", 0.0, 1e-2, "gas volume of the fittings, V_d");
    visit("stop_stiffness", self.stop_stiffness_N_per_m, "N/m", 1e3, 1e8,
          "taut threads, e < 0: stiffness k_s");
    visit("stop_damping", self.stop_damping_s_per_m, "s/m", 0.0, 1e3,
          "taut threads: Hunt-Crossley damping chi");
    visit("contact_surface", self.contact_surface, "cos^2 (geometry) or cos (as the thesis prints 4.3)");
  }
  template <class Report>
  void rules(Report& report) const {
    if (3.0 * std::cos(braid_angle_rad) * std::cos(braid_angle_rad) <= 1.0)
      report("braid_angle", "must be below 54.7 deg, where the braid no longer pulls");
  }
};
using Muscle = MuscleOf<double>;

/// Thread friction: level law and memory (T 2.11, 4.2, 4.6; Canudas de Wit et al. 1995 for the bristle).
template <class P>
struct FrictionOf {
  FrictionLaw law = FrictionLaw::superposition;
  FrictionMemory memory = FrictionMemory::lugre;
  P scale = 1.0;
  P f0 = 4.6937, f1_s2_per_mA2 = 0.0, f2 = -13.9715, f3 = 0.5306;
  P mu0 = 0.015, adhesion_Pa = 0.0;
  P log_A = 0.05, log_B = 0.004;
  P power_alpha = 0.005, power_b = 0.05, power_c = 0.8;
  P bristle_stiffness_N_per_m = 4.0e5;
  P bristle_damping_N_s_per_m = 400.0;
  P floor_N = 1.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("law", self.law,
          "friction level: T 4.6 (superposition), T 1.1 (area), T 1.2 (logarithmic), T 1.3 (power)");
    visit("memory", self.memory,
          "bristle with memory (lugre) or exact stick and slip by event detection (coulomb)");
    visit("scale", self.scale, "1", 0.0, 20.0, "factor on the whole friction level");
    visit("f0", self.f0, "1", -100.0, 100.0, "T 4.6, in per cent");
    visit("f1", self.f1_s2_per_mA2, "s2/mA2", -1.0, 1.0,
          "T 4.6: factor of the squared current speed, in per cent");
    visit("f2", self.f2, "1", -200.0, 200.0, "T 4.6: factor of the contraction ratio, in per cent");
    visit("f3", self.f3, "1", -20.0, 20.0, "T 4.6: factor of its logarithm, in per cent");
    visit("mu0", self.mu0, "1", 0.0, 1.0, "T 1.1: F = mu0 N + adhesion S");
    visit("adhesion", self.adhesion_Pa, "Pa", 0.0, 1e6,
          "T 1.1: friction force for each area of contact, alpha");
    visit("log_A", self.log_A, "1", -1.0, 1.0, "T 1.2: F/N = A - B log N, N in newton");
    visit("log_B", self.log_B, "1", -0.1, 0.1, "T 1.2");
    visit("power_alpha", self.power_alpha, "1", 0.0, 1.0, "T 1.3: F = alpha N + b N^c, N in newton");
    visit("power_b", self.power_b, "1", 0.0, 10.0, "T 1.3: b, in N^(1-c)");
    visit("power_c", self.power_c, "1", 0.1, 1.0, "T 1.3: exponent c");
    visit("bristle_stiffness", self.bristle_stiffness_N_per_m, "N/m", 1e3, 1e8, "sigma0");
    visit("bristle_damping", self.bristle_damping_N_s_per_m, "N.s/m", 0.0, 1e5, "sigma1");
    visit("floor", self.floor_N, "N", 1e-3, 100.0,
          "added to the level: keeps the bristle finite at zero pressure");
  }
};
using Friction = FrictionOf<double>;

/// Current to pressure reference, two proportional valves round a controlled volume (T 3.1, 3.2). They open
/// in proportion to the error (servo), or as far as it takes that the pressure follows with a lag (regulator;
/// docs/equations.md).
template <class P>
struct ValveOf {
  ValveKind kind = ValveKind::servo;
  P zero_current_mA = 4.0, span_current_mA = 20.0;
  P zero_pressure_Pa = 0.5e5, span_pressure_Pa = 5.0e5;
  P supply_pressure_Pa = 6.0e5;
  P conductance_m3_per_s_Pa = 4.0e-9;
  P critical_ratio = 0.30;
  P proportional_band_Pa = 0.3e5;
  P volume_m3 = 5.0e-5;
  RatedCommand zero_command, span_command;  ///< absent: currents are what it is commanded with
  // Of a regulator. Its lag is not said as long as it is 0.
  RegulatorLag lag = RegulatorLag::first_order;
  P time_constant_s = 0.0;
  P natural_frequency_Hz = 0.0, damping = 0.0;
  P venting_conductance_m3_per_s_Pa = 0.0;
  P dead_band_Pa = 0.0;
  P repeatability_Pa = 0.0;

  bool is_regulator() const { return kind == ValveKind::regulator; }
  /// Whether its pressure swings: then it remembers how fast it was changing.
  bool swings() const { return is_regulator() && lag == RegulatorLag::second_order; }
  /// By what time a regulator's pressure stays behind a slow ramp.
  P slow_lag_s() const {
    return swings() ? damping / (std::numbers::pi * natural_frequency_Hz) : time_constant_s;
  }

  /// Whether it is commanded with volts or with a pressure; results hold the currents that would do the same.
  bool has_own_command() const { return !zero_command.absent(); }
  /// The current that does the same as `command`, a number in the unit of its own commands.
  double current_for_mA(double command) const {
    const double share = (command - zero_command.value) / (span_command.value - zero_command.value);
    return zero_current_mA + share * (span_current_mA - zero_current_mA);
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("kind", self.kind, "servo (if left out), or a regulator by its data sheet");
    visit("zero_current", self.zero_current_mA, "mA", 0.0, 100.0, "current at zero pressure");
    visit("span_current", self.span_current_mA, "mA", 0.1, 100.0, "current at span pressure");
    visit("zero_command", self.zero_command,
          "command at zero pressure, of a valve that takes volts or a pressure");
    visit("span_command", self.span_command, "command at span pressure, of such a valve");
    visit("zero_pressure", self.zero_pressure_Pa, "Pa", 0.0, 2e6, "gauge pressure at zero current (T 3.2)");
    visit("span_pressure", self.span_pressure_Pa, "Pa", 1e3, 2e6, "gauge pressure at span current (T 3.2)");
    visit("supply_pressure", self.supply_pressure_Pa, "Pa", 1e3, 2e6, "gauge pressure of the supply (T 3.1)");
    visit("conductance", self.conductance_m3_per_s_Pa, "m3/(s.Pa)", 1e-12, 1e-5,
          "sonic conductance of each proportional valve, fully open, C_v");
    visit("critical_ratio", self.critical_ratio, "1", 0.01, 0.9,
          "critical pressure ratio of valve and hose, b_c");
    if (ListsAll<Visitor> || !self.is_regulator())
      visit("proportional_band", self.proportional_band_Pa, "Pa", 10.0, 2e6,
            "pressure error that opens fully");
    visit("volume", self.volume_m3, "m3", 1e-7, 1e-2, "controlled volume, V_v");
    if (ListsAll<Visitor> || self.is_regulator()) fields_of_regulator(self, visit);
  }
  template <class Self, class Visitor>
  static void fields_of_regulator(Self& self, Visitor& visit) {
    visit("lag", self.lag, "of a regulator: how its pressure follows the command");
    if (ListsAll<Visitor> || !self.swings())
      visit("time_constant", self.time_constant_s, "s", 1e-4, 100.0, "of a lag of first order, T");
    if (ListsAll<Visitor> || self.swings()) {
      visit("natural_frequency", self.natural_frequency_Hz, "Hz", 1e-3, 1e3, "of a lag of second order, f");
      visit("damping", self.damping, "1", 0.01, 100.0, "of a lag of second order, D; 1: no overshoot");
    }
    visit("venting_conductance", self.venting_conductance_m3_per_s_Pa, "m3/(s.Pa)", 0.0, 1e-5,
          "of a regulator: sonic conductance where it vents; 0: that of filling, C_v");
    visit("dead_band", self.dead_band_Pa, "Pa", 0.0, 2e5,
          "of a regulator: pressure errors, either way, about which it does nothing");
    visit("repeatability", self.repeatability_Pa, "Pa", 0.0, 1e5,
          "of a regulator: the ± (one deviation) within which the same command gives the same pressure; "
          "counted in a diagnosis's noise floor, not simulated");
  }
  /// A command in mA is a current.
  void resolve() {
    const auto to_current = [](RatedCommand& command, P& current_mA) {
      if (command.unit != RatedCommand::Unit::mA) return;
      current_mA = command.value;
      command = {};
    };
    to_current(zero_command, zero_current_mA);
    to_current(span_command, span_current_mA);
  }
  template <class Report>
  void rules(Report& report) const {
    if (zero_command.unit != span_command.unit)
      report(zero_command.absent() ? "span_command" : "zero_command",
             "zero_command and span_command are both in V, both in bar, or both in mA");
    else if (has_own_command() && span_command.value <= zero_command.value)
      report("span_command", "must be above zero_command");
    if (span_current_mA <= zero_current_mA) report("span_current", "must be above zero_current");
    if (span_pressure_Pa <= zero_pressure_Pa) report("span_pressure", "must be above zero_pressure");
    if (supply_pressure_Pa < span_pressure_Pa) report("supply_pressure", "must not be below span_pressure");
    const auto say = [&](const P& value, std::string_view key, std::string_view message) {
      if (value == 0.0) report(key, message);
    };
    if (is_regulator() && !swings())
      say(time_constant_s, "time_constant",
          "a regulator's lag must be said, if only as a guess: 0.1 s ± unknown; or lag: second_order");
    if (swings()) {
      say(natural_frequency_Hz, "natural_frequency", "a lag of second order has one: say it, as 5 Hz");
      say(damping, "damping", "a lag of second order has one: say it, as 0.7");
    }
  }
};
using Valve = ValveOf<double>;

/// Hose between valve and muscle (ISO 6358).
template <class P>
struct HoseOf {
  P conductance_m3_per_s_Pa = 1.5e-8;
  P linear_zone_Pa = 1.0e3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("conductance", self.conductance_m3_per_s_Pa, "m3/(s.Pa)", 1e-12, 1e-5, "sonic conductance C_h");
    visit("linear_zone", self.linear_zone_Pa, "Pa", 1.0, 1e5,
          "pressure difference below which flow is linear (valve and hose)");
  }
};
using Hose = HoseOf<double>;

/// The gas and what surrounds it: isothermal ideal air.
template <class P>
struct GasOf {
  P gas_constant_J_per_kg_K = 287.05;
  P temperature_K = 293.15;
  P reference_density_kg_per_m3 = 1.185;
  P atmosphere_Pa = 101325.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("gas_constant", self.gas_constant_J_per_kg_K, "J/(kg.K)", 50.0, 5000.0, "specific gas constant R");
    visit("temperature", self.temperature_K, "K", 200.0, 400.0, "temperature of all gas, T");
    visit("reference_density", self.reference_density_kg_per_m3, "kg/m3", 0.05, 10.0,
          "ISO 6358 reference, rho0");
    visit("atmosphere", self.atmosphere_Pa, "Pa", 1e4, 2e5, "absolute pressure of the surroundings");
  }
};
using Gas = GasOf<double>;

/// What the muscle moves: hanging load on a wheel, and the guide it runs in.
template <class P>
struct JointOf {
  P wheel_radius_m = 0.030;
  P wheel_inertia_kg_m2 = 1.0e-4;
  P guide_damping_N_s_per_m = 20.0;
  P load_offset_kg = 0.0;
  P length_offset_m = 0.0;
  P reading_offset_m = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("wheel_radius", self.wheel_radius_m, "m", 1e-3, 1.0, "radius of the joint's wheel, R_w");
    visit("wheel_inertia", self.wheel_inertia_kg_m2, "kg.m2", 0.0, 10.0, "its moment of inertia, J");
    visit("guide_damping", self.guide_damping_N_s_per_m, "N.s/m", 0.0, 1e5,
          "viscous friction of the load guide, c");
    visit("load_offset", self.load_offset_kg, "kg", -5.0, 5.0,
          "what hangs on the wheel beside the load: hook, cord, error of the scales");
    visit("length_offset", self.length_offset_m, "m", -0.1, 0.1,
          "by how much a muscle whose length is given is shorter than is said: zero of the bench, clamps");
    visit("reading_offset", self.reading_offset_m, "m", -0.1, 0.1,
          "by how much the load is read higher than it stands: zero of a laser or a potentiometer");
  }
};
using Joint = JointOf<double>;

/// Digital-to-analogue converter that drives the valve (T 3.1; the 12 bits are an assumption).
struct Dac {
  double largest_current_mA = 20.0;
  int bits = 12;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("largest_current", self.largest_current_mA, "mA", 0.1, 100.0,
          "top of the range that starts at 0 mA");
    visit("bits", self.bits, 4, 24, "resolution: steps of largest_current / 2^bits");
  }
};

/// Optical encoder on the joint (T 3.1).
struct Encoder {
  int pulses_per_turn = 720;
  double wheel_ratio = 2.0;
  EncoderWiring wiring = EncoderWiring::ideal;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("pulses_per_turn", self.pulses_per_turn, 1, 10000000, "pulses of one turn of the encoder's disk");
    visit("wheel_ratio", self.wheel_ratio, "1", 0.01, 1000.0, "turns of the disk for one turn of the joint");
    visit("wiring", self.wiring, "ideal: floor of the position; crosswise: the thesis's two gated counters");
  }
};

/// Pressure gauge on the muscle, if one is fitted. It is recorded; controllers do not see it.
struct Gauge {
  bool fitted = false;
  double resolution_Pa = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("fitted", self.fitted, "whether muscle pressure is recorded as a gauge would show it");
    visit("resolution", self.resolution_Pa, "Pa", 0.0, 1e5, "smallest step of the gauge; 0 for none");
  }
};

/// The whole rig, all parts of one muscle side and the joint it moves.
template <class P>
struct RigOf {
  /// No valve or hose is quicker than this, and no step of a solver should have to be.
  static constexpr double quickest_s = 1e-6;

  MuscleOf<P> muscle;
  FrictionOf<P> friction;
  ValveOf<P> valve;
  HoseOf<P> hose;
  GasOf<P> gas;
  JointOf<P> joint;
  Dac dac;
  Encoder encoder;
  Gauge gauge;
  Sensor sensor;
  LoadCell load_cell;
  EffectsOf<P> effects;
  double tick_s = 0.012;
  double settling_time_s = 2.004;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("muscle", self.muscle, "braid and tube");
    visit("friction", self.friction, "thread friction");
    visit("valve", self.valve, "servo valve or regulator, and supply");
    visit("hose", self.hose, "hose from valve to muscle");
    visit("gas", self.gas, "air and atmosphere");
    visit("joint", self.joint, "wheel, inertia and load guide");
    visit("dac", self.dac, "current output");
    visit("encoder", self.encoder, "position input");
    visit("gauge", self.gauge, "optional pressure gauge");
    visit("sensor", self.sensor, "what reads the position, if not the encoder");
    visit("load_cell", self.load_cell, "optional load cell on the cord");
    visit("effects", self.effects, "what the nominal rig leaves out; each absent unless given a size");
    visit("tick", self.tick_s, "s", 1e-4, 1.0, "time between two readings; the current is held in between");
    visit("settling_time", self.settling_time_s, "s", 0.0, 1000.0,
          "how long the first current is held before the first reading (rounded to ticks)");
  }
  /// Whether something in it has a memory: an effect, or a regulator that swings.
  bool remembers() const { return effects.remember() || valve.swings(); }

  /// Volumes must not fill in no time.
  template <class Report>
  void rules(Report& report) const {
    const double supply_Pa = valve.supply_pressure_Pa + gas.atmosphere_Pa;
    const double volume_rate_m3_per_s_Pa =
        gas.gas_constant_J_per_kg_K * gas.temperature_K * gas.reference_density_kg_per_m3;
    const auto filling_s = [&](double conductance_m3_per_s_Pa, double volume_m3, double difference_Pa) {
      return volume_m3 * difference_Pa / (volume_rate_m3_per_s_Pa * conductance_m3_per_s_Pa * supply_Pa);
    };
    const double conductance = std::max(valve.conductance_m3_per_s_Pa,
                                        valve.is_regulator() ? valve.venting_conductance_m3_per_s_Pa : 0.0);
    const double band_Pa = valve.is_regulator() ? hose.linear_zone_Pa : valve.proportional_band_Pa;
    if (filling_s(conductance, valve.volume_m3, band_Pa) < quickest_s)
      report(
          "valve",
          valve.is_regulator()
              ? "open, it would move its volume by a whole linear_zone of the hose in less than 1 us: take a "
                "smaller conductance, a larger volume or a wider linear_zone"
              : "the open valve would move its volume by a whole proportional_band in less than 1 us: take a "
                "smaller conductance, a larger volume or a wider proportional_band");
    if (filling_s(hose.conductance_m3_per_s_Pa, valve.volume_m3, hose.linear_zone_Pa) < quickest_s)
      report("hose",
             "it would move the valve's volume by a whole linear_zone in less than 1 us: take a smaller "
             "conductance, a larger linear_zone or a larger volume of the valve");
  }
};
using Rig = RigOf<double>;

/// A rig as its owner believes it to be: without effects, and with nothing beside the load on the wheel.
template <class R>
R nominal(R rig) {
  rig.effects = {};
  rig.joint.load_offset_kg = 0.0;
  return rig;
}

}  // namespace mckibben::plant
