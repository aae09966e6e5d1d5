// What a rig's muscle pulls on: a hanging load, a lever (lever.hpp), a test bench that gives it its length,
// or a link that it turns against a second muscle (T 2.7). Values of the pair: the shipped rig `thesis_pair`.
//
// Everything else of a Rig (rig.hpp) is one side and the wheel's joint; of a pair, the second side departs
// from it.
#pragma once

#include <string_view>
#include <variant>

#include <plant/constants.hpp>
#include <plant/effects.hpp>
#include <plant/lever.hpp>
#include <plant/muscle.hpp>
#include <plant/valve.hpp>

namespace mckibben::plant {

/// A load on a cord over the wheel; its mass is said with each run.
struct HangingLoad {
  static constexpr std::string_view kind = "hanging_load";

  bool absent() const { return true; }  ///< every rig has this unless it says otherwise
  static void fields(auto&, auto&) {}
};

/// A bench that holds or drives the muscle's end, and measures the cord's force.
struct HeldLength {
  static constexpr std::string_view kind = "held_length";

  bool absent() const { return false; }
  static void fields(auto&, auto&) {}
};

/// What two muscles turn (T 2.7): a link on the wheel's axis. Both cords run on the same wheel.
template <class P>
struct LinkOf {
  P contraction_ratio = 0.10, opposite_contraction_ratio = 0.10;  ///< e10, e20: mounted so, at theta = 0
  P mass_kg = 2.0;
  P length_m = 0.25;               ///< from the axis to the centre of mass
  P inertia_kg_m2 = 0.14;          ///< about the axis
  P hangs_at_rad = 0.0;            ///< theta at which it hangs straight down
  P damping_N_m_s_per_rad = 0.05;  ///< of the bearings

  static void fields(auto& self, auto& visit) {
    visit("contraction_1", self.contraction_ratio, "1", 0.0, 0.5,
          "contraction ratio of muscle 1 as it is mounted, at joint angle 0, e10");
    visit("contraction_2", self.opposite_contraction_ratio, "1", 0.0, 0.5, "the same of muscle 2, e20");
    visit("link_mass", self.mass_kg, "kg", 0.0, 500.0, "mass of the link that the wheel turns");
    visit("link_length", self.length_m, "m", 0.0, 5.0, "from the axis to the link's centre of mass, L");
    visit("link_inertia", self.inertia_kg_m2, "kg.m2", 1e-5, 1e3,
          "the link's moment of inertia about the axis; the wheel's is added");
    visit("link_hangs_at", self.hangs_at_rad, "rad", -180.0 * degree_rad, 180.0 * degree_rad,
          "joint angle at which the link hangs straight down");
    visit("joint_damping", self.damping_N_m_s_per_rad, "N.m.s/rad", 0.0, 1e3,
          "viscous friction of the joint, c_j");
  }
  void rules(auto& report) const {
    if (inertia_kg_m2 < mass_kg * length_m * length_m)
      report("link_inertia", "about the axis it is at least link_mass link_length^2 (parallel axes)");
  }
};
using Link = LinkOf<double>;

/// What the second muscle's side of a pair has of its own.
struct OppositeSide {
  Muscle muscle;
  Friction friction;
  Valve valve;
  Hose hose;
  Effects effects;

  static void fields(auto& self, auto& visit) {
    visit("muscle", self.muscle, "braid and tube");
    visit("friction", self.friction, "thread friction");
    visit("valve", self.valve, "servo valve or regulator; both hang on one supply");
    visit("hose", self.hose, "hose from valve to muscle");
    visit("effects", self.effects, "what the nominal rig leaves out; of the encoder, the first side's count");
  }
};

/// A second muscle against the first.
struct Pair : Link {
  static constexpr std::string_view kind = "pair";
  OppositeSide opposite;

  bool absent() const { return false; }
  static void fields(auto& self, auto& visit) {
    Link::fields(self, visit);
    visit("opposite", self.opposite, "where the side of muscle 2 differs from that of muscle 1");
  }
};

/// With a load [kg] in a hand on the link, so far from the axis [m]: a point, in line with the link's own
/// mass.
inline Pair with_load_in_hand(Pair pair, double load_kg, double hand_m) {
  const double moment_kg_m = pair.mass_kg * pair.length_m + load_kg * hand_m;
  pair.mass_kg += load_kg;
  if (pair.mass_kg > 0.0) pair.length_m = moment_kg_m / pair.mass_kg;
  pair.inertia_kg_m2 += load_kg * hand_m * hand_m;
  return pair;
}

using Mechanics = std::variant<HangingLoad, HeldLength, Pair, Lever>;

}  // namespace mckibben::plant
