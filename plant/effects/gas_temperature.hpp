// The muscle's gas warms up as it is compressed and filled, and gives the heat to the walls in its own time.
#pragma once

#include <algorithm>
#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct GasTemperatureOf {
  static constexpr std::string_view
      name = "gas_temperature",
      law = "dP_m/dt = 1.4 (R T q - P_abs dV/dt)/V - P_abs (1 - T/T_m)/tau, T_m by the first law",
      sentence = "the muscle's gas warms up and cools down, and takes the walls' temperature in its own time",
      source =
          "heat of the gas in a muscle: Doumit & Pardoel, Mech. Syst. Signal Process. 91 (2017) 93-110; thermal "
          "time constant: Pourmovahed & Otis, An experimental thermal time-constant correlation for hydraulic "
          "accumulators";
  static constexpr std::array hooks{Hook::muscle_exponent, Hook::heat_loss};
  static constexpr std::array variants{Variant{"", "time", 0.0, 0.1, Sign::positive, 0.01}};
  static constexpr double memory_size = 0.1;  // T_m/T - 1
  static constexpr double capacity_ratio = 1.4, coldest = 0.1;  // of air; of T, further no muscle goes

  P time_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("time", self.time_s, "s", 0.0, 100.0, "tau; 0: absent, the gas has the walls' temperature");
  }
  auto absent() const { return time_s == 0.0; }
  P muscle_exponent_shift() const { return capacity_ratio - 1.0; }

  template <class S>
  S heat_loss_per_s(const S& excess) const {
    using std::max;
    return excess / (max(time_s, P(fastest_s)) * ratio(excess));
  }
  template <class S>
  S memory_rate(const Instant<S>& now, const Inflow<S>& inflow, const S& excess) const {
    const S per_kg = now.gas_J_per_kg /
                     ((now.muscle_pressure_Pa + now.atmosphere_Pa) * inflow.volume_m3);  // R T/(P V)
    const S none = S(0.0);
    const S entering = select(inflow.hose_kg_per_s > 0.0, inflow.hose_kg_per_s, none);  // at T, and mixes
    const S compression =
        per_kg * (inflow.hose_kg_per_s - inflow.leak_kg_per_s) - inflow.volume_rate_m3_per_s / inflow.volume_m3;
    return ratio(excess) * ((capacity_ratio - 1.0) * compression - heat_loss_per_s(excess) -
                            excess * per_kg * entering);
  }

 private:
  template <class S>
  static S ratio(const S& excess) {  // T_m/T
    const S ratio = 1.0 + excess;
    return select(ratio > coldest, ratio, S(coldest));
  }
};
using GasTemperature = GasTemperatureOf<double>;

}  // namespace mckibben::plant
