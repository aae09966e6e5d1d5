// The field's terms; see the header.
#include <cctype>

#include <sim/input/synonyms.hpp>

namespace mckibben::input {
namespace {

constexpr Synonym terms_of_the_field[] = {
    {"leak", "muscle_leak"},
    {"leakage", "muscle_leak"},
    {"hysteresis", "bladder_hysteresis"},
    {"hysteresis", "valve_hysteresis"},
    {"preisach", "bladder_hysteresis"},
    {"prandtl_ishlinskii", "bladder_hysteresis"},
    {"maxwell_slip", "bladder_hysteresis"},
    {"bouc_wen", "bladder_hysteresis"},
    {"dahl", "bladder_hysteresis"},
    {"creep", "bladder_creep"},
    {"viscoelasticity", "bladder_creep"},
    {"relaxation", "bladder_creep"},
    {"coulomb", "guide_friction"},
    {"dry_friction", "guide_friction"},
    {"stribeck", "speed_dependent_friction"},
    {"viscous", "viscous_damping"},
    {"viscous_friction", "viscous_damping"},
    {"damping", "viscous_damping"},
    {"spring", "bladder_elasticity"},
    {"stiffness", "bladder_elasticity"},
    {"rubber", "bladder_elasticity"},
    {"deadband", "valve_dead_band"},
    {"dead_band", "valve_dead_band"},
    {"dead_zone", "valve_dead_band"},
    {"backlash", "encoder_backlash"},
    {"dead_time", "command_delay"},
    {"dead_time", "reading_delay"},
    {"delay", "command_delay"},
    {"delay", "reading_delay"},
    {"latency", "command_delay"},
    {"latency", "reading_delay"},
    {"lag", "valve_lag"},
    {"bandwidth", "valve_lag"},
    {"adiabatic", "polytropic_gas"},
    {"isothermal", "gas_temperature"},
    {"drift", "friction_warm_up"},
    {"scale_error", "encoder_scale"},
    {"threshold_pressure", "pressure_threshold"},
    {"end_effect", "end_cap_correction"},
    {"feedforward", "feedforward_pid"},
    {"mpc", "model_inverse_feedback"},
    {"imc", "model_inverse_feedback"},
    {"smith_predictor", "model_inverse_feedback"},
    {"lqr", "external"},
    {"lqr", "plugin"},
};

}  // namespace

std::span<const Synonym> synonyms() {
  return terms_of_the_field;
}

std::string spelled_alike(std::string_view word) {
  std::string text(word);
  for (char& c : text)
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string_view> names_here(std::string_view term) {
  const std::string wanted = spelled_alike(term);
  std::vector<std::string_view> names;
  for (const Synonym& one : terms_of_the_field)
    if (one.term == wanted) names.push_back(one.here);
  return names;
}

}  // namespace mckibben::input
