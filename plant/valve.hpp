// Parameters of what the gas comes through: servo valve or regulator, and hose. Laws: flow.hpp,
// valve_flow.hpp. How fields are listed: rig.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include <plant/command.hpp>

namespace mckibben::plant {

/// What keeps the pressure: the thesis's servo valve, whose proportional band makes its dynamics, or a
/// regulator of which a data sheet tells the lag. Or nothing does: valves that are open or shut, or none, and
/// the muscle is sealed.
enum class ValveKind { servo, regulator, on_off, none };
constexpr auto names(ValveKind) {
  using enum ValveKind;
  return std::array{std::pair{servo, std::string_view{"servo"}},
                    std::pair{regulator, std::string_view{"regulator"}},
                    std::pair{on_off, std::string_view{"on_off"}}, std::pair{none, std::string_view{"none"}}};
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

/// Valves that are open or shut: one that fills and one that vents, or one that does either.
enum class Ports { two, three };
constexpr auto names(Ports) {
  using enum Ports;
  return std::array{std::pair{two, std::string_view{"2/2"}}, std::pair{three, std::string_view{"3/2"}}};
}

/// What a command is to them: which one opens, or how much of each period of a pulse-width modulation, edge
/// by edge or as a valve that is open by so much.
enum class Switching { edges, pwm, averaged };
constexpr auto names(Switching) {
  using enum Switching;
  return std::array{std::pair{edges, std::string_view{"edges"}}, std::pair{pwm, std::string_view{"pwm"}},
                    std::pair{averaged, std::string_view{"averaged"}}};
}

/// From 4 to 20 mA.
inline constexpr double thesis_span_mA = 16.0;

/// Whether a visitor of a field list wants fields as well that the struct's own choices rule out.
template <class Visitor>
concept ListsAll = requires {
  requires Visitor::lists_all;
};

/// Command to pressure reference, two proportional valves round a controlled volume (T 3.1, 3.2). They open
/// in proportion to the error (servo), or as far as it takes that the pressure follows with a lag (regulator;
/// docs/equations.md).
template <class P>
struct ValveOf {
  ValveKind kind = ValveKind::servo;
  CommandUnit command_unit = CommandUnit::mA;  ///< of its commands, and of all that is measured in them
  P zero_command = 4.0, span_command = 20.0;
  P zero_pressure_Pa = 0.5e5, span_pressure_Pa = 5.0e5;
  P supply_pressure_Pa = 6.0e5, exhaust_pressure_Pa = 0.0;
  P conductance_m3_per_s_Pa = 4.0e-9;
  P critical_ratio = 0.30;
  P proportional_band_Pa = 0.3e5;
  P volume_m3 = 5.0e-5;
  // Of a regulator. Its lag is not said as long as it is 0.
  RegulatorLag lag = RegulatorLag::first_order;
  P time_constant_s = 0.0;
  P natural_frequency_Hz = 0.0, damping = 0.0;
  P venting_conductance_m3_per_s_Pa = 0.0;
  P dead_band_Pa = 0.0;
  P repeatability_Pa = 0.0;
  // Of valves that are open or shut.
  Ports ports = Ports::two;
  Switching switching = Switching::edges;
  P pwm_frequency_Hz = 0.0;
  P venting_critical_ratio = 0.0;
  P opening_delay_s = 0.0, closing_delay_s = 0.0;
  P leak_m3_per_s_Pa = 0.0;
  P fill_pressure_Pa = 3.0e5;  // of a muscle without a valve

  bool is_servo() const { return kind == ValveKind::servo; }
  bool is_on_off() const { return kind == ValveKind::on_off; }
  bool is_regulator() const { return kind == ValveKind::regulator; }
  /// Whether there is none: the muscle holds the gas that it was filled with.
  bool seals() const { return kind == ValveKind::none; }
  /// Whether its pressure swings: then it remembers how fast it was changing.
  bool swings() const { return is_regulator() && lag == RegulatorLag::second_order; }
  /// By what time a regulator's pressure stays behind a slow ramp.
  P slow_lag_s() const {
    return swings() ? damping / (std::numbers::pi * natural_frequency_Hz) : time_constant_s;
  }

  /// What does to it as 1 mA does to the thesis's valve of 4 to 20 mA: what is a number of mA there is as
  /// many of these here. 1 of any valve that takes a current.
  P per_mA() const {
    return command_unit == CommandUnit::mA ? 1.0 : (span_command - zero_command) / thesis_span_mA;
  }

  /// How far a command is on the way from zero_command to span_command, 0 to 1.
  double way(double command) const {
    return std::clamp((command - zero_command) / (span_command - zero_command), 0.0, 1.0);
  }

  /// The command at which valves that are open or shut are both shut; a valve for both has none.
  std::optional<double> closed_command() const {
    if (!is_on_off() || ports != Ports::two) return std::nullopt;
    return 0.5 * (zero_command + span_command);
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("kind", self.kind,
          "servo (if left out), a regulator by its data sheet, valves that are open or shut, or none: a "
          "sealed muscle");
    if (ListsAll<Visitor> || !self.seals()) fields_of_valves(self, visit);
    if (ListsAll<Visitor> || self.seals()) {
      visit("fill_pressure", self.fill_pressure_Pa, "Pa", -0.95e5, 2e6,
            "of none: gauge pressure to which the muscle is filled before a run");
      if (!ListsAll<Visitor>) visit_critical_ratio(self, visit);
    }
  }
  static void visit_critical_ratio(auto& self, auto& visit) {
    visit("critical_ratio", self.critical_ratio, "1", 0.01, 0.9,
          "critical pressure ratio of valve, hose and leaks, b_c");
  }
  template <class Self, class Visitor>
  static void fields_of_valves(Self& self, Visitor& visit) {
    visit("zero_command", self.zero_command, "mA", 0.0, 100.0,
          "command at zero pressure: mA, V or bar, as the valve takes it, and then all commands of the rig");
    visit("span_command", self.span_command, "mA", 0.1, 100.0, "command at span pressure, in the same unit");
    if (ListsAll<Visitor> || !self.is_on_off()) {
      visit("zero_pressure", self.zero_pressure_Pa, "Pa", -0.95e5, 2e6,
            "gauge pressure at zero_command (T 3.2)");
      visit("span_pressure", self.span_pressure_Pa, "Pa", 1e3, 2e6, "gauge pressure at span_command (T 3.2)");
    }
    visit("supply_pressure", self.supply_pressure_Pa, "Pa", 1e3, 2e6, "gauge pressure of the supply (T 3.1)");
    visit("exhaust_pressure", self.exhaust_pressure_Pa, "Pa", -0.95e5, 2e6,
          "gauge pressure of what it vents to: a vacuum pump's, below 0");
    visit("conductance", self.conductance_m3_per_s_Pa, "m3/(s.Pa)", 1e-12, 1e-5,
          "sonic conductance of each proportional valve, fully open, C_v");
    visit_critical_ratio(self, visit);
    if (ListsAll<Visitor> || self.is_servo())
      visit("proportional_band", self.proportional_band_Pa, "Pa", 10.0, 2e6,
            "pressure error that opens fully");
    visit("volume", self.volume_m3, "m3", 1e-7, 1e-2, "controlled volume, V_v");
    if (ListsAll<Visitor> || self.is_regulator()) fields_of_regulator(self, visit);
    if (ListsAll<Visitor> || !self.is_servo())
      visit("venting_conductance", self.venting_conductance_m3_per_s_Pa, "m3/(s.Pa)", 0.0, 1e-5,
            "of a regulator, of on_off: sonic conductance where it vents; 0: that of filling, C_v");
    if (ListsAll<Visitor> || self.is_on_off()) fields_of_on_off(self, visit);
  }
  template <class Self, class Visitor>
  static void fields_of_on_off(Self& self, Visitor& visit) {
    visit("ports", self.ports, "of on_off: one that fills and one that vents, or one for both");
    visit("switching", self.switching, "of on_off: what a command means (docs/equations.md)");
    if (ListsAll<Visitor> || self.switching == Switching::pwm)
      visit("pwm_frequency", self.pwm_frequency_Hz, "Hz", 0.1, 1e4, "of switching: pwm");
    visit("venting_critical_ratio", self.venting_critical_ratio, "1", 0.0, 0.9,
          "of on_off; 0: critical_ratio");
    visit("opening_delay", self.opening_delay_s, "s", 0.0, 10.0, "of on_off; shorter commands do nothing");
    visit("closing_delay", self.closing_delay_s, "s", 0.0, 10.0, "of on_off");
    visit("leak", self.leak_m3_per_s_Pa, "m3/(s.Pa)", 0.0, 1e-5, "of on_off: conductance while shut");
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
    visit("dead_band", self.dead_band_Pa, "Pa", 0.0, 2e5,
          "of a regulator: pressure errors, either way, about which it does nothing");
    visit("repeatability", self.repeatability_Pa, "Pa", 0.0, 1e5,
          "of a regulator: ± (one deviation) of the pressure at one command; in a diagnosis's noise floor, "
          "not simulated");
  }
  /// What no file says of valves that are open or shut: their line is of what they can reach. And of a sealed
  /// muscle, whose pressures are at least of the size of that to which it is filled.
  void resolve() {
    if (seals()) span_pressure_Pa = std::max(span_pressure_Pa, fill_pressure_Pa);
    if (!is_on_off()) return;
    zero_pressure_Pa = exhaust_pressure_Pa;
    span_pressure_Pa = supply_pressure_Pa;
  }
  void rules(auto& report) const {
    if (seals()) return;
    if (is_on_off() && leak_m3_per_s_Pa >= conductance_m3_per_s_Pa)
      report("leak", "a shut valve must pass less than an open one, conductance");
    if (is_on_off() && switching == Switching::pwm && pwm_frequency_Hz == 0.0)
      report("pwm_frequency", "a duty is of a period: say its frequency, as 50 Hz");
    if (is_on_off() && switching == Switching::averaged && (opening_delay_s > 0.0 || closing_delay_s > 0.0))
      report("switching",
             "an averaged duty has no edges that delays could shift: say pwm, or leave them out");
    if (span_command <= zero_command) report("span_command", "must be above zero_command");
    if (span_pressure_Pa <= zero_pressure_Pa) report("span_pressure", "must be above zero_pressure");
    if (zero_pressure_Pa < exhaust_pressure_Pa)
      report("zero_pressure",
             "must not be below exhaust_pressure, what the valve vents to: of a vacuum pump say "
             "exhaust_pressure: -0.9 bar");
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

  static void fields(auto& self, auto& visit) {
    visit("conductance", self.conductance_m3_per_s_Pa, "m3/(s.Pa)", 1e-12, 1e-5, "sonic conductance C_h");
    visit("linear_zone", self.linear_zone_Pa, "Pa", 1.0, 1e5,
          "pressure difference below which flow is linear (valve and hose)");
  }
};
using Hose = HoseOf<double>;

}  // namespace mckibben::plant
