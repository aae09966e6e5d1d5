// What the thesis's calibration gives a controller: the friction coefficient against contraction and current
// speed (T 4.6), and the pressure against contraction, current speed and load (T 4.7 to 4.28), each for
// contraction and for relaxation. One file holds it (schema mckibben-calibration/1); `calibrate` writes it,
// `open_loop` reads it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mckibben::controllers {

/// f = f0 + f1 nu^2 + f2 e + f3 ln e (T 4.6): a plain coefficient, not per cent; nu in mA/s.
struct FrictionModel {
  double f0 = 0.0, f1_s2_per_mA2 = 0.0, f2 = 0.0, f3 = 0.0;

  double coefficient(double contraction_ratio, double current_speed_mA_per_s) const;

  static void fields(auto& self, auto& visit) {
    visit.required("f0", self.f0, "1", -1e6, 1e6, "constant term");
    visit.required("f1", self.f1_s2_per_mA2, "s2/mA2", -1e6, 1e6, "factor of the squared command speed");
    visit.required("f2", self.f2, "1", -1e6, 1e6, "factor of the contraction ratio");
    visit.required("f3", self.f3, "1", -1e6, 1e6, "factor of its logarithm");
  }
};

/// Polynomial in the load [kg], highest power first, as the thesis prints them. Value in Pa, or Pa and s/mA.
using InLoad = std::vector<double>;
double at_load(const InLoad& polynomial, double load_kg);

/// Contraction: P = a0 + a1 e + a2 exp(a3 e) + a4 ln e, a1 = a1_0 nu + a1_1,
/// a2 = a2_0 nu + a2_1 (T 4.8 to 4.20).
struct ContractionModel {
  InLoad a0, a1_0, a1_1, a2_0, a2_1, a3, a4;

  static void fields(auto& self, auto& visit) {
    constexpr double any = 1e30;
    visit.required("a0", self.a0, "1", -any, any, "T 4.14, in Pa");
    visit.required("a1_0", self.a1_0, "1", -any, any, "T 4.15, in Pa.s/mA");
    visit.required("a1_1", self.a1_1, "1", -any, any, "T 4.16, in Pa");
    visit.required("a2_0", self.a2_0, "1", -any, any, "T 4.17, in Pa.s/mA");
    visit.required("a2_1", self.a2_1, "1", -any, any, "T 4.18, in Pa");
    visit.required("a3", self.a3, "1", -any, any, "T 4.19");
    visit.required("a4", self.a4, "1", -any, any, "T 4.20, in Pa");
  }
};

/// Relaxation: P = b0 + b1 e + b2 exp(b3 e) + b4 ln e, b0 = b0_0 nu + b0_1, b4 = b4_0 nu^2 + b4_1 nu + b4_2
/// (T 4.11 to 4.13, 4.21 to 4.28). nu is the magnitude of the current's speed.
struct RelaxationModel {
  InLoad b0_0, b0_1, b1, b2, b3, b4_0, b4_1, b4_2;

  static void fields(auto& self, auto& visit) {
    constexpr double any = 1e30;
    visit.required("b0_0", self.b0_0, "1", -any, any, "T 4.21, in Pa.s/mA");
    visit.required("b0_1", self.b0_1, "1", -any, any, "T 4.22, in Pa");
    visit.required("b1", self.b1, "1", -any, any, "T 4.23, in Pa");
    visit.required("b2", self.b2, "1", -any, any, "T 4.24, in Pa");
    visit.required("b3", self.b3, "1", -any, any, "T 4.25");
    visit.required("b4_0", self.b4_0, "1", -any, any, "T 4.26, in Pa.s2/mA2");
    visit.required("b4_1", self.b4_1, "1", -any, any, "T 4.27, in Pa.s/mA");
    visit.required("b4_2", self.b4_2, "1", -any, any, "T 4.28, in Pa");
  }
};

/// Where the data were: outside it a model is a guess.
struct CalibratedRange {
  double lowest_ratio = 0.0, highest_ratio = 0.0;
  double lowest_load_kg = 0.0, highest_load_kg = 0.0;
  double lowest_speed_mA_per_s = 0.0, highest_speed_mA_per_s = 0.0;

  static void fields(auto& self, auto& visit) {
    visit.required("lowest_ratio", self.lowest_ratio, "1", 0.0, 1.0, "smallest contraction ratio used");
    visit.required("highest_ratio", self.highest_ratio, "1", 0.0, 1.0, "largest contraction ratio used");
    visit.required("lowest_load", self.lowest_load_kg, "kg", 0.0, 500.0, "lightest load");
    visit.required("highest_load", self.highest_load_kg, "kg", 0.0, 500.0, "heaviest load");
    visit.required("lowest_speed", self.lowest_speed_mA_per_s, "mA/s", 0.0, 1e5, "slowest command");
    visit.required("highest_speed", self.highest_speed_mA_per_s, "mA/s", 0.0, 1e5, "fastest command");
  }
};

/// One fitted number, how sure it is, and how well posed the fit was that gave it.
struct FittedCoefficient {
  std::string name;  ///< for example "a1_0[2]", the third coefficient of that polynomial
  double value = 0.0;
  double standard_error = 0.0;
  double condition = 0.0;  ///< condition number of the scaled least-squares problem
  bool determined = true;  ///< false: the data cannot tell it from zero or from its neighbours

  static void fields(auto& self, auto& visit) {
    constexpr double any = 1e300;
    visit.required("name", self.name, "which coefficient");
    visit.required("value", self.value, "1", -any, any, "its value");
    visit.required("standard_error", self.standard_error, "1", 0.0, any, "its standard error");
    visit.required("condition", self.condition, "1", 0.0, any, "condition number of its fit");
    visit.required("determined", self.determined, "whether the data determine it");
  }
};

/// What the rubber tube pulls back with, k_b l0 e + F_b (1 - exp(-e / e_b)): of muscles whose braid force
/// alone (T 2.8) is not their pull.
struct TubePull {
  double stiffness_N_per_m = 0.0, force_N = 0.0, ratio = 0.05;

  double pull_N(double contraction_ratio, double rest_length_m) const;

  static void fields(auto& self, auto& visit) {
    visit("stiffness", self.stiffness_N_per_m, "N/m", 0.0, 1e4, "k_b");
    visit("force", self.force_N, "N", 0.0, 1e3, "F_b");
    visit("ratio", self.ratio, "1", 1e-3, 1.0, "e_b");
  }
};

struct Calibration {
  std::optional<std::string> command_unit{};  ///< absent: mA
  std::optional<TubePull> tube_pull{};
  FrictionModel contraction_friction, relaxation_friction;
  ContractionModel contraction;
  RelaxationModel relaxation;
  CalibratedRange range;
  std::vector<FittedCoefficient> details;

  static void fields(auto& self, auto& visit) {
    visit("command_unit", self.command_unit,
          "what the rig's valve is commanded in, and what this has in place of mA: V or bar; mA if absent");
    visit("tube_pull", self.tube_pull,
          "the rig's bladder_elasticity, which was taken from the braid force; none if absent");
    visit.required("contraction_friction", self.contraction_friction,
                   "friction coefficient while contracting");
    visit.required("relaxation_friction", self.relaxation_friction, "friction coefficient while relaxing");
    visit.required("contraction", self.contraction, "pressure against contraction while contracting");
    visit.required("relaxation", self.relaxation, "pressure against contraction while relaxing");
    visit.required("range", self.range, "where the data were");
    visit("details", self.details, "every coefficient with its standard error");
  }
};

}  // namespace mckibben::controllers
