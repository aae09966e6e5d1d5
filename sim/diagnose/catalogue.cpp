// From the plant's table of effects to candidates; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include <plant/geometry.hpp>
#include <sim/data/parts.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// A law of the user's own, as one of the catalogue. A second parameter that is always positive is its shape.
Candidate candidate_of(const plant::LawText& law) {
  const std::string prefix = "effects." + std::string(of_laws) + "." + law.name + ".";
  const plant::LawText::Parameter& size = law.parameters.front();
  Candidate c{.effect = law.name,
              .variant = "",
              .amplitude = prefix + size.name,
              .shape = "",
              .typical = size.typical,
              .either_sign = size.lowest < 0.0 && size.highest > 0.0,
              .shapes = {},
              .own = true};
  for (std::size_t i = 1; i < law.parameters.size(); ++i) {
    const plant::LawText::Parameter& p = law.parameters[i];
    std::vector<double> values{std::lerp(p.lowest, p.highest, 0.25), p.typical,
                               std::lerp(p.lowest, p.highest, 0.75)};
    if (p.lowest > 0.0) {  // over its whole range: a wavelength is found from close by only
      const int places = thresholds.parameter.law_places;
      values = {p.lowest, p.typical};
      for (int k = 1; k <= places; ++k)
        values.push_back(p.lowest * std::pow(p.highest / p.lowest, static_cast<double>(k) / places));
    }
    if (c.shape.empty() && p.lowest > 0.0) {
      c.shape = prefix + p.name;
      c.shapes = std::move(values);
    } else {
      c.further.push_back({prefix + p.name, p.typical, std::move(values), p.lowest, p.highest});
    }
  }
  return c;
}

/// Where effects act that data leave nothing to see of: upstream of what is given, and on what was not read.
/// Settled points have no speed, and no time that anybody measured.
struct Hidden {
  std::vector<plant::Hook> hooks{};
  bool motion = false;

  bool has(plant::Hook hook) const { return std::ranges::find(hooks, hook) != hooks.end(); }
};

Hidden hidden(const domain::Dataset& data) {
  using enum plant::Hook;
  std::vector<plant::Hook> list;
  const bool muscle = data.pressure_is_given();
  if (muscle || data.valve_pressure_is_given() || data.rig.valve.seals())
    list = {valve_error_shift, valve_opening, supply_drop, vent_factor, command_delay, reference};
  if (data.supply_is_given()) list.push_back(supply_drop);
  if (muscle) list.insert(list.end(), {outflow, gas_exponent, muscle_heating});
  if (data.judged() == domain::Judged::pressure)
    list.insert(list.end(), {wheel, reading_factor, reading_delay});
  return {list, data::are_settled_points(data)};
}

template <class E>
bool is_hidden(const Hidden& from) {
  if constexpr (requires { E::in_motion; })
    if (from.motion) return true;
  return std::ranges::all_of(E::hooks, [&](plant::Hook hook) { return from.has(hook); });
}

/// Whether data of which this is hidden show a user's law.
bool is_hidden(const plant::LawText& law, const Hidden& from) {
  return (law.adds == plant::LawTarget::outflow && from.has(plant::Hook::outflow)) ||
         (law.adds == plant::LawTarget::command && from.has(plant::Hook::reference));
}

}  // namespace

std::vector<std::string> effects_out_of_sight(const domain::Dataset& data) {
  const Hidden from = hidden(data);
  std::vector<std::string> names;
  const auto add = [&]<class E>(const E& effect) {
    if (is_hidden<E>(from) && !E::variants.empty()) names.emplace_back(effect.name);
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, plant::Effects::Table{});
  return names;
}

bool out_of_sight(const domain::Dataset& data, const Parameter& p) {
  const std::string_view path = of_muscle_1(p.path);
  const auto begins = [&](std::string_view part) { return path.starts_with(part); };
  // Where a run begins on its way, threads begin bent by a guess that bends with their stiffness: descents
  // with both free were seen to end far from where they should.
  if (path == "friction.bristle_stiffness" &&
      (data.rig.friction.memory != plant::FrictionMemory::lugre || data::are_settled_points(data) ||
       data.recorded.start == domain::Start::moving))
    return true;
  if (data.pressure_is_given())
    return begins("valve.") || begins("hose.") || begins("gas.") || path == "muscle.dead_volume";
  if (data.rig.valve.seals() && begins("hose.")) return true;
  if (data.rig.valve.seals() && path == "valve.fill_pressure")
    return std::ranges::all_of(data.runs,
                               [](const auto& run) { return run.measured && run.measured->filled_Pa; });
  if (data.supply_is_given() && path == "valve.supply_pressure") return true;
  return data.valve_pressure_is_given() && begins("valve.");
}

namespace {

/// Whether an effect is of a muscle and what drives it, so that one of a pair may have it alone; others are
/// of what both share, the encoder, the supply and the gas.
template <class E>
constexpr bool is_of_a_muscle() {
  using enum plant::Hook;
  constexpr std::array shared{gas_exponent, supply_drop, reading_delay, wheel, reading_factor};
  return std::ranges::none_of(
      E::hooks, [&](plant::Hook hook) { return std::ranges::find(shared, hook) != shared.end(); });
}

/// What data can show of the catalogue. Of a pair, `gauge` is that of muscle 1.
struct Sight {
  Hidden hidden{};
  bool load_guide = true, gauge = true, opposite_gauge = false, pair = false;
};

std::vector<Candidate> in_sight(const Sight& sight) {
  std::vector<Candidate> list;
  const auto add = [&]<class E>(const E& effect) {
    if (is_hidden<E>(sight.hidden)) return;
    if (!sight.load_guide && std::is_same_v<E, plant::GuideFriction>) return;
    const bool of_gauge = plant::declares<E>(plant::Hook::gauge);
    for (const plant::Variant& law : E::variants) {
      const std::string prefix = "effects." + std::string(effect.name) + ".";
      Candidate c{.effect = std::string(effect.name),
                  .variant = std::string(law.name),
                  .amplitude = prefix + std::string(law.amplitude),
                  .shape = law.shape.empty() ? "" : prefix + std::string(law.shape),
                  .absent = law.absent,
                  .typical = law.typical,
                  .either_sign = law.sign == plant::Sign::either,
                  .shapes = {},
                  .adds_to = std::string(law.adds_to)};
      if (!law.shape.empty()) c.shapes = {law.low, law.middle, law.high};
      const bool each = sight.pair && is_of_a_muscle<E>();
      if (sight.gauge || !of_gauge) list.push_back(c);
      if (each && (sight.gauge || !of_gauge)) list.push_back(c.of(Side::one));
      if (each && (sight.opposite_gauge || !of_gauge)) list.push_back(c.of(Side::two));
    }
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, plant::Effects::Table{});
  return list;
}

/// A leak that matters where nothing fills the muscle again [m3/(s.Pa)]: it takes a share of the gas in a
/// run.
double leak_of_a_sealed_muscle(const domain::Dataset& data) {
  double longest_s = data.row_s();
  for (const domain::Run& run : data.runs)
    if (run.measured && !run.measured->time_s.empty())
      longest_s = std::max(longest_s, run.measured->time_s.back() - run.measured->time_s.front());
  const plant::Gas& gas = data.rig.gas;
  return thresholds.parameter.sealed_leak * plant::Braid(data.rig.muscle).volume_m3(0.0) /
         (gas.gas_constant_J_per_kg_K * gas.temperature_K * gas.reference_density_kg_per_m3 * longest_s);
}

}  // namespace

std::vector<Candidate> catalogue() {
  return in_sight({});
}
std::vector<Candidate> catalogue(const Rig& rig) {
  std::vector<Candidate> list = catalogue();
  for (const auto& law : rig.effects.laws.list) list.push_back(candidate_of(*law.text));
  return list;
}
std::vector<Candidate> catalogue(const domain::Dataset& data) {
  const bool given = data.pressure_is_given();
  const Hidden from = hidden(data);
  const auto gauged = [&](std::size_t muscle) {
    return given || std::ranges::any_of(data.runs, [&](const domain::Run& run) {
             return run.find("muscle_pressure", muscle) != nullptr;
           });
  };
  const bool pair = data.rig.pair() != nullptr;
  std::vector<Candidate> list = in_sight({.hidden = from,
                                          .load_guide = !data.rig.has_angle(),
                                          .gauge = gauged(1),
                                          .opposite_gauge = gauged(2),
                                          .pair = pair});
  if (data.rig.valve.seals())
    for (Candidate& one : list)
      if (one.effect == plant::MuscleLeak::name) one.typical = leak_of_a_sealed_muscle(data);
  for (const auto& law : data.rig.effects.laws.list)
    if (!is_hidden(*law.text, from)) list.push_back(candidate_of(*law.text));
  return list;
}

}  // namespace mckibben::diagnose
