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
      law =
          "first law of the muscle's gas: c_v d(m T_m)/dt = c_p (T q_in - T_m q_out) - P_abs dV/dt - "
          "c_v m (T_m - T)/tau",
      sentence = "the muscle's gas warms up and cools down, and takes the walls' temperature in its own time",
      source =
          "heat of the gas in a muscle: Doumit & Pardoel, Mech. Syst. Signal Process. 91 (2017) 93-110; "
          "thermal time constant: Pourmovahed & Otis, An experimental thermal time-constant correlation for "
          "hydraulic accumulators";
  static constexpr std::array hooks{Hook::muscle_heating};
  static constexpr std::array variants{Variant{"", "time", 0.0, 0.1, Sign::positive, 0.01}};
  static constexpr double memory_size = 0.1;  // T_m/T - 1
  static constexpr std::string_view memory_unit = "1";
  static constexpr double capacity_ratio = 1.4, coldest = 0.1;  // of air; of T, further no muscle goes

  P time_s = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("time", self.time_s, "s", 0.0, 100.0, "tau; 0: absent, the gas has the walls' temperature");
  }
  auto absent() const { return time_s == 0.0; }

  template <class S>
  S heating_Pa_per_s(const Instant<S>& now, const Inflow<S>& inflow, const S& excess) const {
    const Exchange<S> gas(now, inflow);
    const S isothermal = gas.entering_per_s - gas.leaving_per_s - gas.growing_per_s;
    return (now.muscle_pressure_Pa + now.atmosphere_Pa) *
           ((capacity_ratio - 1.0) * isothermal - capacity_ratio * excess * gas.leaving_per_s -
            loss_per_s(excess));
  }
  template <class S>
  S memory_rate(const Instant<S>& now, const Inflow<S>& inflow, const S& excess) const {
    const Exchange<S> gas(now, inflow);
    return ratio(excess) * ((capacity_ratio - 1.0 - excess) * gas.entering_per_s -
                            (capacity_ratio - 1.0) * (ratio(excess) * gas.leaving_per_s + gas.growing_per_s) -
                            loss_per_s(excess));
  }

 private:
  /// What comes and goes, in shares of the gas that would be there at T, and the volume's growth in its own.
  template <class S>
  struct Exchange {
    S entering_per_s, leaving_per_s, growing_per_s;
    Exchange(const Instant<S>& now, const Inflow<S>& inflow) {
      const S none = S(0.0), absolute_Pa = now.muscle_pressure_Pa + now.atmosphere_Pa;
      const S per_kg = now.gas_J_per_kg / (absolute_Pa * inflow.volume_m3);
      const auto in = inflow.hose_kg_per_s > 0.0;
      entering_per_s = per_kg * select(in, inflow.hose_kg_per_s, none);
      leaving_per_s = per_kg * (inflow.leak_kg_per_s - select(in, none, inflow.hose_kg_per_s));
      growing_per_s = inflow.volume_rate_m3_per_s / inflow.volume_m3;
    }
  };

  template <class S>
  S loss_per_s(const S& excess) const {
    using std::max;
    return excess / (max(time_s, P(fastest_s)) * ratio(excess));
  }
  template <class S>
  static S ratio(const S& excess) {  // T_m/T
    const S ratio = 1.0 + excess;
    return select(ratio > coldest, ratio, S(coldest));
  }
};
using GasTemperature = GasTemperatureOf<double>;

}  // namespace mckibben::plant
