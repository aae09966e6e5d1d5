// See the header.
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <plant/names.hpp>
#include <sim/diagnose/force_term.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

std::string words(const plant::ForceTerm& term) {
  if (term.of == plant::Basis::sine) {
    const bool shifted = std::abs(term.phase_rad) >= thresholds.tell.told_phase;
    return fmt::format(
        "sin(2 pi x / {:.3f} mm{})", 1e3 * term.wavelength_m,
        shifted ? fmt::format(" {} {:.2f} rad", term.phase_rad < 0.0 ? "-" : "+", std::abs(term.phase_rad))
                : "");
  }
  return std::string(plant::name_of(term.of));
}

}  // namespace mckibben::diagnose
