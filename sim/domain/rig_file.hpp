// What a rig file says: a rig, what its muscles pull on, and how its equations are solved.
#pragma once

#include <variant>

#include <plant/mechanics.hpp>
#include <plant/solver.hpp>
#include <sim/domain/spread.hpp>

namespace mckibben::domain {

/// A rig and how its equations are solved: a stiff rig may ask for the method that suits it.
struct RigFile : plant::Rig {
  static constexpr bool by_name = true;  ///< other files may name it, or its path
  plant::Mechanics mechanics;
  solver::Settings integrator;
  Spreads spreads;  ///< `6 mm ± 0.1 mm`

  RigFile() = default;
  RigFile(const plant::Rig& rig) : plant::Rig(rig) {}  ///< with a load that hangs

  /// The second muscle and the link, or null.
  const plant::Pair* pair() const { return std::get_if<plant::Pair>(&mechanics); }
  bool lifts_a_load() const { return std::holds_alternative<plant::HangingLoad>(mechanics); }
  bool holds_a_length() const { return std::holds_alternative<plant::HeldLength>(mechanics); }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    plant::Rig::fields(self, visit);
    visit("mechanics", self.mechanics,
          "what the muscle pulls on: hanging_load (if left out), held_length or pair (docs/two_muscles.md)");
    visit("integrator", self.integrator, "how the equations are solved");
  }
  template <class Report>
  void rules(Report& report) const {
    plant::Rig::rules(report);
    if (pair() != nullptr) plant::pair_rules(*this, *pair(), report);
    if (pair() != nullptr && sensors.of(plant::Sensed::force) != nullptr)
      report("sensors", "a load cell is of rigs with one muscle: of two, angle and pressures are read");
  }
};

/// A rig as its owner believes it to be (plant::nominal), on both sides of a pair.
inline RigFile nominal(const RigFile& rig) {
  RigFile known = plant::nominal(rig);
  if (auto* pair = std::get_if<plant::Pair>(&known.mechanics)) pair->opposite.effects = {};
  return known;
}

/// The shipped rig of that name: two of the thesis's muscles on one wheel.
inline RigFile thesis_pair() {
  RigFile rig;
  rig.mechanics = plant::Pair{};
  return rig;
}

}  // namespace mckibben::domain
