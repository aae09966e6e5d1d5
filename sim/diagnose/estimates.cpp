// See the header.
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <plant/names.hpp>
#include <sim/diagnose/estimates.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr std::string_view law_terms = "effects.residual_law.terms.";

}  // namespace

std::string words(const plant::ForceTerm& term) {
  if (term.of == plant::Basis::sine) {
    const bool shifted = std::abs(term.phase_rad) >= thresholds.law.told_phase;
    return fmt::format(
        "sin(2 pi x / {:.3f} mm{})", 1e3 * term.wavelength_m,
        shifted ? fmt::format(" {} {:.2f} rad", term.phase_rad < 0.0 ? "-" : "+", std::abs(term.phase_rad))
                : "");
  }
  return std::string(plant::name_of(term.of));
}

void tell_parameters(Diagnosis& diagnosis, const Model& model, const std::vector<Bounds>& bounds,
                     const Rig& recalibrated) {
  const auto& terms = model.rig.effects.get<plant::ResidualForce>().terms;
  Rig rig = model.rig;
  for (std::size_t j = 0; j < model.free.size(); ++j) {
    const Parameter& p = model.free[j];
    const Bounds& at = bounds[j];
    FittedNumber number{p.path,  find(rig, p.path).unit, at.value,    at.low,
                        at.high, at.determined,          at.quadratic};
    if (p.has_prior) {
      const double moved = p.deviations(number.value);
      const double most = thresholds.parameter.at_the_edge * thresholds.parameter.most_deviations;
      diagnosis.recalibrated.push_back({number, p.origin, moved, std::abs(p.scaled(number.value)) > most});
      diagnosis.absorbed.push_back({p.path, p.deviations(value_of(recalibrated, p.path)), moved});
      continue;
    }
    for (auto* effects : {&diagnosis.effects, &diagnosis.stand_ins})
      for (auto& effect : *effects) {
        std::string prefix = keys_of(effect.who());
        if (!p.path.starts_with(prefix)) prefix = fmt::format("effects.{}.{}.", of_laws, effect.name);
        if (!p.path.starts_with(prefix)) continue;
        number.name = p.path.substr(prefix.size());
        effect.parameters.push_back(number);
      }
    if (!p.path.starts_with(law_terms)) continue;
    // terms.INDEX.KEY: the nominal rig may have had terms of its own.
    const std::size_t dot = p.path.find('.', law_terms.size());
    number.name = p.path.substr(dot + 1);
    if (number.name == "coefficient") {
      const auto index = std::stoul(p.path.substr(law_terms.size(), dot - law_terms.size()));
      number.name = words(terms[index]);
      diagnosis.residual_law.push_back({number.name, number});
    } else {
      diagnosis.residual_law.back().shape.push_back(number);  // a term's coefficient comes first
    }
  }
}

}  // namespace mckibben::diagnose
