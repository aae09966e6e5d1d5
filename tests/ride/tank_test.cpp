// Two muscles on one tank: what either draws is missing to both.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {
namespace {

// Choked by both valves, which fill no more than their own volumes, a tank empties as
// exp(-2 n R T C rho0 t/V).
TEST(Tank, IsEmptiedByBothMuscles) {
  for (const double n : {1.0, 1.4}) {
    plant::Rig rig;
    rig.hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
    rig.valve.volume_m3 = 5e-4;
    rig.valve.supply_pressure_Pa = 20e5;
    auto& tank = rig.effects.get<plant::SupplyDroop>();
    tank = {.volume_m3 = 2e-4, .line_resistance_s_Pa_per_kg = 1e15, .exponent = n};  // nothing refills it
    Ride both(Loaded{plant::pair_of(rig, rig)}, {solver::Method::erk, 1e-9});
    const auto commanded = [](double first_mA, double second_mA) {
      Drive drive{{.current_mA = first_mA}};
      drive.opposite.current_mA = second_mA;
      return drive;
    };
    both.start(commanded(4.0, 4.0), 0.0);
    both.step(commanded(20.0, 20.0), 0.06);
    const double full_Pa = 20e5 + 101325.0;
    const double left_Pa = full_Pa * std::exp(-2.0 * n * 287.05 * 293.15 * 4e-9 * 1.185 * 0.06 / 2e-4);
    const auto drop_Pa = [&](const plant::SideMemory<double>& memory) {
      return both.plant().side().rig().effects.supply_drop_Pa(memory);
    };
    EXPECT_GT(drop_Pa(both.flow().memory.side), 4e5);
    EXPECT_NEAR(full_Pa - drop_Pa(both.flow().memory.side), left_Pa, 2e-5 * full_Pa) << n;
    EXPECT_EQ(drop_Pa(both.flow().memory.side), drop_Pa(both.flow().memory.opposite));
    // One that asks for nothing fills from what the other has left.
    Ride one(Loaded{plant::pair_of(rig, rig)}, {solver::Method::erk, 1e-9});
    one.start(commanded(4.0, 4.0), 0.0);
    one.step(commanded(20.0, 4.0), 0.06);
    EXPECT_EQ(drop_Pa(one.flow().memory.side), drop_Pa(one.flow().memory.opposite));
    EXPECT_LT(drop_Pa(one.flow().memory.side), drop_Pa(both.flow().memory.side));
    EXPECT_GT(drop_Pa(one.flow().memory.opposite), 2e5);
  }
}

}  // namespace
}  // namespace mckibben::ride
