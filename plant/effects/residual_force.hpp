// A force that no effect of the catalogue explains, as a sum of simple terms: what a diagnosis writes into a
// rig when it finds a law it has no name for (sparse regression:
// Brunton, Proctor, Kutz, PNAS 113 (2016) 3932-3937).
#pragma once

#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

/// What a term is proportional to. Speeds count in 0.1 m/s, pressures in bar, loads in 10 kg, the braid's
/// force F (T 2.8) in 100 N, so that every coefficient is a force. The sign of v is smoothed over 1 mm/s.
enum class Basis {
  constant,
  ratio,
  ratio_squared,
  pressure,
  pressure_ratio,
  force_ratio,
  force_ratio_squared,
  force_ratio_cubed,
  load,
  speed,
  speed_squared,
  direction,
  direction_ratio,
  direction_pressure,
  sine
};
constexpr auto names(Basis) {
  using enum Basis;
  return std::array{std::pair{constant, std::string_view{"1"}},
                    std::pair{ratio, std::string_view{"e"}},
                    std::pair{ratio_squared, std::string_view{"e^2"}},
                    std::pair{pressure, std::string_view{"P"}},
                    std::pair{pressure_ratio, std::string_view{"P e"}},
                    std::pair{force_ratio, std::string_view{"F e"}},
                    std::pair{force_ratio_squared, std::string_view{"F e^2"}},
                    std::pair{force_ratio_cubed, std::string_view{"F e^3"}},
                    std::pair{load, std::string_view{"m g"}},
                    std::pair{speed, std::string_view{"v"}},
                    std::pair{speed_squared, std::string_view{"v |v|"}},
                    std::pair{direction, std::string_view{"sgn v"}},
                    std::pair{direction_ratio, std::string_view{"e sgn v"}},
                    std::pair{direction_pressure, std::string_view{"P sgn v"}},
                    std::pair{sine, std::string_view{"sin(2 pi x / wavelength + phase)"}}};
}

template <class P>
struct ForceTermOf {
  Basis of = Basis::constant;
  P coefficient_N = 0.0;
  P wavelength_m = 0.01, phase_rad = 0.0;

  static void fields(auto& self, auto& visit) {
    visit.required("of", self.of, "v in 0.1 m/s, P in bar, F (of the braid) in 100 N, m g in 98.0665 N");
    visit.required("coefficient", self.coefficient_N, "N", -1e4, 1e4,
                   "force for one of it, positive upwards");
    visit("wavelength", self.wavelength_m, "m", 1e-4, 10.0, "of the sine");
    visit("phase", self.phase_rad, "rad", -7.0, 7.0, "of the sine");
  }

  template <class S>
  S pull_N(const Instant<S>& now) const {
    using std::abs;
    using std::sin;
    using std::tanh;
    const S& e = now.contraction_ratio;
    const S v = now.speed_m_per_s / 0.1;
    const S pressure_bar = now.muscle_pressure_Pa / 1e5;
    const auto direction = [&] { return S(tanh(now.speed_m_per_s / 1e-3)); };
    const auto force = [&] { return S(now.braid_force_N / 100.0); };
    S value = S(0.0);
    switch (of) {
      case Basis::constant:
        value = S(1.0);
        break;
      case Basis::ratio:
        value = e;
        break;
      case Basis::ratio_squared:
        value = e * e;
        break;
      case Basis::pressure:
        value = pressure_bar;
        break;
      case Basis::pressure_ratio:
        value = pressure_bar * e;
        break;
      case Basis::force_ratio:
        value = force() * e;
        break;
      case Basis::force_ratio_squared:
        value = force() * e * e;
        break;
      case Basis::force_ratio_cubed:
        value = force() * e * e * e;
        break;
      case Basis::load:
        value = S(now.weight_N / 98.0665);
        break;
      case Basis::speed:
        value = v;
        break;
      case Basis::speed_squared:
        value = v * abs(v);
        break;
      case Basis::direction:
        value = direction();
        break;
      case Basis::direction_ratio:
        value = direction() * e;
        break;
      case Basis::direction_pressure:
        value = direction() * pressure_bar;
        break;
      case Basis::sine:
        value = sin(S(2.0 * std::numbers::pi / wavelength_m * now.rise_m + phase_rad));
        break;
    }
    return coefficient_N * value;
  }
};
using ForceTerm = ForceTermOf<double>;

template <class P>
struct ResidualForceOf {
  static constexpr std::string_view name = "residual_law", law = "sum of coefficient x term",
                                    sentence = "a force outside the catalogue, as a diagnosis found it",
                                    source = "sparse regression on the disagreement with measured data";
  static constexpr std::array hooks{Hook::pull};
  static constexpr std::array<Variant, 0> variants{};

  std::vector<ForceTermOf<P>> terms{};

  static void fields(auto& self, auto& visit) {
    visit("terms", self.terms, "the terms of the sum; none: absent");
  }
  bool absent() const { return terms.empty(); }

  template <class S>
  S pull_N(const Instant<S>& now, const S&) const {
    S sum = S(0.0);
    for (const ForceTermOf<P>& term : terms) sum = sum + term.pull_N(now);
    return sum;
  }
};
using ResidualForce = ResidualForceOf<double>;

}  // namespace mckibben::plant
