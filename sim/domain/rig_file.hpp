// What a rig file says: a rig, and how its equations are solved.
#pragma once

#include <plant/rig.hpp>
#include <sim/solver/settings.hpp>

namespace mckibben::domain {

/// A rig and how its equations are solved: a stiff rig may ask for the method that suits it.
struct RigFile : plant::Rig {
  static constexpr bool by_name = true;  ///< other files may name it, or its path
  solver::Settings integrator;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    plant::Rig::fields(self, visit);
    visit("integrator", self.integrator, "how the equations are solved");
  }
};

}  // namespace mckibben::domain
