// Parameters by path; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include <sim/diagnose/parameter.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// Calls `tell` with the effect of this name in the rig.
template <class Tell>
void with_effect(plant::Rig& rig, std::string_view effect, const Tell& tell) {
  const auto look = [&]<class E>(E& mine) {
    if (effect == E::name) tell(mine);
  };
  std::apply([&](const auto&... e) { (look(rig.effects.get<std::remove_cvref_t<decltype(e)>>()), ...); },
             plant::Effects::Table{});
}

}  // namespace

bool carries(plant::Rig rig, std::string_view effect) {
  bool present = false;
  with_effect(rig, effect, [&](const auto& mine) { present = !mine.absent(); });
  return present;
}

Found find(plant::Rig& rig, std::string_view path) {
  Found found = domain::find_number(rig, path);
  if (found.value == nullptr) throw std::invalid_argument("no parameter " + std::string(path));
  return found;
}

double Parameter::unscaled(double number) const {
  return logarithmic ? std::exp(number) : origin + number * scale;
}
double Parameter::scaled(double value) const {
  return logarithmic ? std::log(value) : (value - origin) / scale;
}

double value_of(const plant::Rig& rig, std::string_view path) {
  plant::Rig copy = rig;
  return *find(copy, path).value;
}

namespace {

using Stated = domain::Spreads;

/// The deviation that a rig's file states, of a value; none if it says nothing.
std::optional<double> deviation_of(const Stated& stated, std::string_view path, double value, double usual) {
  const auto said = stated.find(std::string(path));
  if (said == stated.end()) return std::nullopt;
  if (std::isfinite(said->second)) return said->second;
  return std::max(thresholds.parameter.unknown * std::abs(value), thresholds.parameter.unknown_usual * usual);
}

/// A number of the rig, normal round its value.
Parameter normal(const std::string& path, const Found& found, double deviation) {
  const double most = thresholds.parameter.most_deviations * deviation;
  return {.path = path,
          .origin = *found.value,
          .scale = deviation,
          .step = thresholds.parameter.step * deviation,
          .lowest = std::max(found.lowest, *found.value - most),
          .highest = std::min(found.highest, *found.value + most),
          .has_prior = true};
}

/// What somebody has put there: its size is a guess, good within a factor of a few, if nothing is stated.
Parameter size_of(const Candidate& candidate, Parameter p, const plant::Rig& nominal, const Stated& stated) {
  p.origin = value_of(nominal, p.path);
  const double size = p.origin - (p.path == candidate.amplitude ? candidate.absent : 0.0);
  p.scale = std::abs(size);
  if (p.logarithmic)
    p.step *= p.scale;
  else
    p.scale = std::max(p.scale, std::abs(candidate.typical));
  p.scale = deviation_of(stated, p.path, p.origin, p.scale).value_or(p.scale);
  p.logarithmic = false;
  p.has_prior = true;
  const double most = thresholds.parameter.most_deviations * p.scale;
  p.lowest = std::max(std::min(p.lowest, p.origin), p.origin - most);
  p.highest = std::min(std::max(p.highest, p.origin), p.origin + most);
  return p;
}

/// Numbers of the rig's parts that a file may say how well it knows. What is not in a part is not of the
/// plant: the tick, the settling time.
bool of_a_part(const plant::Rig& nominal, std::string_view path) {
  constexpr std::array<std::string_view, 6> parts{"muscle.", "friction.", "valve.",
                                                  "hose.",   "gas.",      "joint."};
  plant::Rig rig = nominal;
  return domain::find_number(rig, path).value != nullptr &&
         std::any_of(parts.begin(), parts.end(), [&](auto part) { return path.starts_with(part); });
}

}  // namespace

std::vector<Parameter> nominal_parameters(const plant::Rig& nominal, const domain::Spreads& stated) {
  std::vector<Parameter> list;
  plant::Rig rig = nominal;
  const auto add = [&](const std::string& path, double usual) {
    const Found found = find(rig, path);
    const double deviation = deviation_of(stated, path, *found.value, usual).value_or(usual);
    if (deviation > 0.0) list.push_back(normal(path, found, deviation));
  };
  for (const Prior& prior : thresholds.parameter.priors) {
    const double* value = domain::find_number(rig, prior.path).value;
    if (value == nullptr) continue;  // of a regulator, which not every rig has
    add(std::string(prior.path), prior.relative * std::abs(*value) + prior.absolute);
  }
  for (const auto& [path, deviation] : stated) {
    const auto usual = [&path = path](const Prior& prior) { return prior.path == path; };
    const auto& priors = thresholds.parameter.priors;
    if (std::none_of(priors.begin(), priors.end(), usual) && of_a_part(nominal, path)) add(path, 0.0);
  }
  for (const Candidate& candidate : catalogue()) {
    if (!candidate.carried(nominal)) continue;
    for (Parameter& p : candidate.parameters(nominal)) {
      p = size_of(candidate, std::move(p), nominal, stated);
      if (p.scale > 0.0) list.push_back(std::move(p));
    }
  }
  return list;
}

plant::Rig Candidate::chosen(plant::Rig rig) const {
  with_effect(rig, effect, [&](auto& mine) {
    if constexpr (requires { mine.variant; }) {
      for (const auto& [law, name] : names(mine.variant))
        if (name == variant) mine.variant = law;
    }
  });
  return rig;
}

bool Candidate::carried(plant::Rig rig) const {
  bool present = false, same_law = true;
  with_effect(rig, effect, [&](const auto& mine) {
    present = !mine.absent();
    if constexpr (requires { mine.variant; }) {
      for (const auto& [law, name] : names(mine.variant))
        if (law == mine.variant) same_law = name == variant;
    }
  });
  return present && same_law;
}

std::vector<Parameter> Candidate::parameters(const plant::Rig& rig) const {
  plant::Rig copy = rig;
  const Found size = find(copy, amplitude);
  // Next to nothing is as good as nothing, and can be stiff: a supply line of no resistance, a lag of no
  // time.
  const double least = absent + thresholds.parameter.least_size * typical;
  std::vector<Parameter> list{{.path = amplitude,
                               .origin = absent,
                               .scale = std::abs(typical),
                               .step = step,
                               .lowest = either_sign || typical < 0.0 ? size.lowest : least,
                               .highest = either_sign || typical > 0.0 ? size.highest : least}};
  if (!shape.empty()) {
    const Found form = find(copy, shape);
    list.push_back({.path = shape,
                    .scale = 1.0,
                    .step = thresholds.parameter.shape_step,
                    .lowest = std::max(form.lowest, shapes.front() / thresholds.parameter.shape_range),
                    .highest = std::min(form.highest, shapes.back() * thresholds.parameter.shape_range),
                    .logarithmic = true});
  }
  return list;
}

namespace {

/// Whether an effect acts on what makes the muscle's pressure, and on nothing else.
template <class E>
constexpr bool makes_pressure() {
  using enum plant::Hook;
  constexpr std::array of_pressure{outflow,           gas_exponent,  muscle_heating,
                                   valve_error_shift, valve_opening, supply_drop,
                                   vent_factor,       command_delay, reference};
  return std::ranges::all_of(
      E::hooks, [&](plant::Hook hook) { return std::ranges::find(of_pressure, hook) != of_pressure.end(); });
}

}  // namespace

std::vector<std::string> effects_out_of_sight() {
  std::vector<std::string> names;
  const auto add = [&]<class E>(const E& effect) {
    if (makes_pressure<E>() && !E::variants.empty()) names.emplace_back(effect.name);
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, plant::Effects::Table{});
  return names;
}

bool out_of_sight(const Parameter& p) {
  const auto begins = [&](std::string_view part) { return p.path.starts_with(part); };
  return begins("valve.") || begins("hose.") || begins("gas.") || p.path == "muscle.dead_volume";
}

std::vector<Candidate> catalogue(bool pressure_is_given) {
  std::vector<Candidate> list;
  const auto add = [&]<class E>(const E& effect) {
    if (pressure_is_given && makes_pressure<E>()) return;
    for (const plant::Variant& law : E::variants) {
      const std::string prefix = "effects." + std::string(effect.name) + ".";
      Candidate c{.effect = std::string(effect.name),
                  .variant = std::string(law.name),
                  .amplitude = prefix + std::string(law.amplitude),
                  .shape = law.shape.empty() ? "" : prefix + std::string(law.shape),
                  .absent = law.absent,
                  .typical = law.typical,
                  .step = law.step,
                  .either_sign = law.sign == plant::Sign::either,
                  .shapes = {}};
      if (!law.shape.empty()) c.shapes = {law.low, law.middle, law.high};
      list.push_back(std::move(c));
    }
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, plant::Effects::Table{});
  return list;
}

}  // namespace mckibben::diagnose
