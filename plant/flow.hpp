// Mass flow of a gas through a restriction, ISO 6358: choked below the critical pressure ratio, elliptic
// above it, and linear for small differences, where the ellipse has an infinite slope.
#pragma once

#include <cmath>

#include <plant/choose.hpp>

namespace mckibben::plant {

/// A restriction with a sonic conductance.
template <class P>
struct RestrictionOf {
  P conductance_kg_per_s_Pa;  ///< C rho0
  P critical_ratio;           ///< b_c
  P linear_zone_Pa;

  /// Mass flow [kg/s] from `from_Pa` to `to_Pa`, both absolute; negative when it runs back. What differs from
  /// case to case is chosen before the law, which then runs once for all lanes.
  template <class S>
  S flow_kg_per_s(const S& from_Pa, const S& to_Pa) const {
    const auto back = from_Pa < to_Pa;
    const S high_Pa = select(back, to_Pa, from_Pa), low_Pa = select(back, from_Pa, to_Pa);
    const S drop = high_Pa - low_Pa;
    const auto small = drop < linear_zone_Pa;
    const S turbulent = turbulent_kg_per_s(high_Pa, select(small, S(high_Pa - linear_zone_Pa), low_Pa));
    const S flow = choose(
        small, [&] { return S(turbulent * (drop / linear_zone_Pa)); }, [&] { return turbulent; });
    return select(back, S(-flow), flow);
  }

 private:
  template <class S>
  S turbulent_kg_per_s(const S& high_Pa, const S& low_Pa) const {
    using std::sqrt;
    const S choked = conductance_kg_per_s_Pa * high_Pa;
    const S excess = (low_Pa / high_Pa - critical_ratio) / (1.0 - critical_ratio);
    return choose(
        excess <= 0.0, [&] { return S(choked); }, [&] { return S(choked * sqrt(1.0 - excess * excess)); });
  }
};
using Restriction = RestrictionOf<double>;

}  // namespace mckibben::plant
