// Laws that no catalogue has, in the place of a rig's own.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <plant/rig.hpp>

#include "own_law.hpp"

namespace mckibben::diagnose {

/// Stick and slip without a bristle, friction by the area of contact (T 1.1), a braid that pulls otherwise as
/// it shortens, a valve of second order.
enum class OtherLaw { none, stick_slip, area_friction, braid, valve };
constexpr auto names(OtherLaw) {
  using enum OtherLaw;
  return std::array{std::pair{none, std::string_view{""}},
                    std::pair{stick_slip, std::string_view{", stick and slip"}},
                    std::pair{area_friction, std::string_view{", friction by area"}},
                    std::pair{braid, std::string_view{", another braid"}},
                    std::pair{valve, std::string_view{", valve of second order"}}};
}

/// Puts a law of no catalogue in the place of the rig's own.
inline void put(OtherLaw law, plant::Rig& rig) {
  switch (law) {
    case OtherLaw::none:
      return;
    case OtherLaw::stick_slip:
      rig.friction.memory = plant::FrictionMemory::coulomb;
      return;
    case OtherLaw::area_friction:
      rig.friction.law = plant::FrictionLaw::area;
      rig.friction.adhesion_Pa = 1000.0;
      return;
    case OtherLaw::braid:  // 3 % at an eighth of its length, nothing at a quarter
      rig.effects.laws.list = {own_law(plant::LawTarget::force, "share * F_braid * 16 * e * (0.25 - e)",
                                       {{"share", law::ratio, 0.03}})};
      return;
    case OtherLaw::valve:
      rig.effects.laws.list = {own_law(plant::LawTarget::command, "p - command",
                                       {{"T", law::second, 0.02}, {"damping", law::ratio, 0.5}},
                                       {{"p", "q"}, {"q", "(command - p) / T^2 - 2 * damping * q / T"}})};
  }
}

}  // namespace mckibben::diagnose
