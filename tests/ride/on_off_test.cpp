// Valves that are open or shut: choked flow into and out of a constant volume, delays, a shut valve that
// holds.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {
namespace {

constexpr double atmosphere_Pa = 101325.0, gas_J_per_kg = 287.05 * 293.15, rho_kg_per_m3 = 1.185;
constexpr double fill_mA = 20.0, shut_mA = 12.0, vent_mA = 4.0;

/// The hose as good as shut, so that the valve's volume of 50 cm3 is what is filled.
plant::Rig of_a_constant_volume() {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::on_off;
  rig.valve.supply_pressure_Pa = 20e5;
  rig.valve.venting_conductance_m3_per_s_Pa = 2e-9;
  rig.valve.resolve();
  rig.hose.conductance_m3_per_s_Pa = 1e-12;
  return rig;
}

constexpr double filling_Pa_per_s = gas_J_per_kg / 5e-5 * 4e-9 * rho_kg_per_m3 * (20e5 + atmosphere_Pa);

class OnOff : public testing::TestWithParam<solver::Method> {
 protected:
  Ride ride(const plant::Rig& rig, double first_mA) {
    Ride one(Loaded{rig, 10.0}, {GetParam(), 1e-9}, true);
    one.start({{.current_mA = first_mA}}, 0.0);
    return one;
  }
  static double valve_Pa(const Ride& ride) { return ride.flow().state.side.valve_pressure_Pa; }
};

TEST_P(OnOff, ChokedFillingIsLinear) {
  Ride filled = ride(of_a_constant_volume(), shut_mA);
  EXPECT_EQ(valve_Pa(filled), 0.0);
  filled.step({{.current_mA = fill_mA}}, 0.012);
  EXPECT_NEAR(valve_Pa(filled), 0.012 * filling_Pa_per_s, 1e-4 * valve_Pa(filled));
  EXPECT_LT(valve_Pa(filled), 5.3e5);  // choked until then
  EXPECT_NEAR(filled.flow().ledger.air_drawn_kg, 0.012 * 4e-9 * rho_kg_per_m3 * (20e5 + atmosphere_Pa),
              1e-12);
}

// p falls by e in V/(R T C rho0) as long as it is choked, by its own conductance and critical ratio.
TEST_P(OnOff, ChokedVentingIsExponential) {
  plant::Rig rig = of_a_constant_volume();
  rig.valve.venting_critical_ratio = 0.5;
  Ride vented = ride(rig, shut_mA);
  vented.step({{.current_mA = fill_mA}}, 0.010);
  const double before_Pa = valve_Pa(vented) + atmosphere_Pa;
  vented.step({{.current_mA = vent_mA}}, 0.020);
  const double expected_Pa = before_Pa * std::exp(-0.010 * gas_J_per_kg * 2e-9 * rho_kg_per_m3 / 5e-5);
  EXPECT_GT(expected_Pa, 2.0 * atmosphere_Pa);
  EXPECT_NEAR(valve_Pa(vented) + atmosphere_Pa, expected_Pa, 1e-4 * expected_Pa);
}

// Open for as long as the command and the difference of the delays; no command shorter than the delay opens.
TEST_P(OnOff, OpensAndShutsAfterItsDelays) {
  plant::Rig rig = of_a_constant_volume();
  rig.valve.opening_delay_s = 5e-3;
  rig.valve.closing_delay_s = 2e-3;
  Ride pulsed = ride(rig, shut_mA);
  pulsed.step({{.current_mA = fill_mA}}, 0.005 - 1e-3);
  pulsed.step({{.current_mA = shut_mA}}, 0.020);
  EXPECT_NEAR(valve_Pa(pulsed), 0.0, 1.0);
  pulsed.step({{.current_mA = fill_mA}}, 0.032);
  pulsed.step({{.current_mA = shut_mA}}, 0.050);
  EXPECT_NEAR(valve_Pa(pulsed), 0.009 * filling_Pa_per_s, 1e-3 * valve_Pa(pulsed));
  EXPECT_EQ(pulsed.moment().supply_flow, 0.0);
}

// A duty is the edges that it stands for, to 2e-5 bar; averaged it comes near them.
TEST_P(OnOff, ADutyIsItsEdges) {
  plant::Rig rig = of_a_constant_volume();
  rig.valve.opening_delay_s = 2e-3;
  rig.valve.closing_delay_s = 1e-3;
  Ride edges = ride(rig, shut_mA);
  rig.valve.switching = plant::Switching::pwm;
  rig.valve.pwm_frequency_Hz = 50.0;
  Ride duty = ride(rig, shut_mA);
  rig.valve.opening_delay_s = rig.valve.closing_delay_s = 0.0;
  rig.valve.switching = plant::Switching::averaged;
  Ride mean = ride(rig, shut_mA);
  // 0.4 to fill in three periods of 20 ms, then 0.7 to vent in two.
  for (int k = 0; k < 5; ++k) {
    const double begun_s = 0.02 * k, off_s = begun_s + (k < 3 ? 0.4 : 0.7) * 0.02;
    edges.step({{.current_mA = k < 3 ? fill_mA : vent_mA}}, off_s);
    edges.step({{.current_mA = shut_mA}}, begun_s + 0.02);
  }
  for (int k = 1; k <= 10; ++k)  // commands need not come with the periods
    for (Ride* one : {&duty, &mean}) one->step({{.current_mA = k <= 6 ? 15.2 : 6.4}}, 0.01 * k);
  EXPECT_GT(valve_Pa(edges), 1e5);
  EXPECT_NEAR(valve_Pa(duty), valve_Pa(edges), 2.0);
  EXPECT_NEAR(valve_Pa(mean), valve_Pa(edges), 0.2 * valve_Pa(edges));
}

// With three ports a valve fills or vents: what it no longer is asked to fill it vents.
TEST_P(OnOff, OfThreePortsIsNeverShut) {
  plant::Rig rig = of_a_constant_volume();
  rig.valve.ports = plant::Ports::three;
  Ride both = ride(rig, vent_mA);
  both.step({{.current_mA = fill_mA}}, 0.012);
  EXPECT_GT(valve_Pa(both), 1e5);
  both.hold({{.current_mA = vent_mA}}, 0.024);
  EXPECT_GT(both.moment().vent_flow, 0.0);
  EXPECT_EQ(both.moment().supply_flow, 0.0);
}

TEST(OnOffValve, ShutItHoldsForAnHour) {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::on_off;
  rig.valve.resolve();
  Ride held(Loaded{rig, 10.0}, {solver::Method::cvode, 1e-9}, true);
  held.start({{.current_mA = shut_mA}}, 0.0);
  held.step({{.current_mA = fill_mA}}, 0.5);
  for (double t = 0.6; t < 20.0; t += 0.1) held.step({{.current_mA = shut_mA}}, t);
  const auto before = held.flow().state;
  const double gas_kg = held.plant().gas_mass_kg(before);
  EXPECT_GT(before.joint.contraction_ratio, 0.05);
  for (int minute = 1; minute <= 60; ++minute) held.step({{.current_mA = shut_mA}}, 20.0 + 60.0 * minute);
  const auto& after = held.flow().state;
  EXPECT_NEAR(held.plant().gas_mass_kg(after), gas_kg, 1e-9 * gas_kg);
  EXPECT_NEAR(after.side.muscle_pressure_Pa, before.side.muscle_pressure_Pa, 1.0);
  EXPECT_NEAR(after.joint.contraction_ratio, before.joint.contraction_ratio, 1e-6);
}

// Choked by the supply; nothing flows from the atmosphere to itself.
TEST_P(OnOff, AShutValveMayLeak) {
  plant::Rig rig = of_a_constant_volume();
  rig.valve.leak_m3_per_s_Pa = 1e-12;
  Ride leaking = ride(rig, shut_mA);
  leaking.hold({{.current_mA = shut_mA}}, 0.012);
  EXPECT_NEAR(leaking.moment().supply_flow, 1e-12 * rho_kg_per_m3 * (20e5 + atmosphere_Pa), 1e-15);
  EXPECT_EQ(leaking.moment().vent_flow, 0.0);
}

// A pulse that is under way when the ride is saved ends as it would have.
TEST_P(OnOff, GoesOnFromWhatWasSaved) {
  plant::Rig rig = of_a_constant_volume();
  rig.valve.opening_delay_s = 5e-3;
  Ride first = ride(rig, shut_mA);
  first.step({{.current_mA = fill_mA}}, 0.003);
  Ride second = first;
  for (Ride* one : {&first, &second}) one->step({{.current_mA = fill_mA}}, 0.012);
  EXPECT_EQ(valve_Pa(first), valve_Pa(second));
  EXPECT_GT(valve_Pa(first), 1e4);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, OnOff, testing::Values(solver::Method::erk, solver::Method::cvode),
                         [](const auto& p) { return p.param == solver::Method::erk ? "erk" : "cvode"; });

}  // namespace
}  // namespace mckibben::ride
