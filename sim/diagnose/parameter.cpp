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

constexpr std::string_view of_muscle_2 = "mechanics.opposite.";

/// Calls `tell` with the effect of this name in the rig, on each of these sides.
template <class Tell>
void with_effect(RigFile& rig, std::string_view effect, Side side, const Tell& tell) {
  const auto visit = [&](plant::Effects& effects) {
    const auto look = [&]<class E>(E& mine) {
      if (effect == E::name) tell(mine);
    };
    std::apply([&](const auto&... e) { (look(effects.get<std::remove_cvref_t<decltype(e)>>()), ...); },
               plant::Effects::Table{});
    for (auto& law : effects.laws.list)
      if (effect == law.text->name) tell(law);
  };
  each_side(rig, visit, side);
}

}  // namespace

std::string keys_of(const EffectName& who) {
  return std::string(who.side == Side::two ? of_muscle_2 : "")
      .append("effects.")
      .append(who.effect)
      .append(".");
}

void each_side(RigFile& rig, const std::function<void(plant::Effects& effects)>& visit, Side side) {
  if (side != Side::two) visit(rig.effects);
  auto* pair = std::get_if<plant::Pair>(&rig.mechanics);
  if (pair != nullptr && side != Side::one) visit(pair->opposite.effects);
}

bool carries(RigFile rig, std::string_view effect, Side side) {
  bool present = false;
  with_effect(rig, effect, side, [&](const auto& mine) { present = present || !mine.absent(); });
  return present;
}

Found find(RigFile& rig, std::string_view path) {
  Found found = domain::find_number(rig, path);
  if (found.value == nullptr) throw std::invalid_argument("no parameter " + std::string(path));
  return found;
}

void Parameter::put(RigFile& rig, double value) const {
  *find(rig, path).value = value;
  if (both_sides) *find(rig, std::string(of_muscle_2) + path).value = value;
}
double Parameter::unscaled(double number) const {
  return logarithmic ? std::exp(number) : origin + number * scale;
}
double Parameter::scaled(double value) const {
  return logarithmic ? std::log(value) : (value - origin) / scale;
}

double value_of(const RigFile& rig, std::string_view path) {
  RigFile copy = rig;
  return *find(copy, path).value;
}

namespace {

using Stated = domain::Spreads;

/// The path of a number on the side of muscle 1 that stands for the same.
std::string_view of_muscle_1(std::string_view path) {
  return path.starts_with(of_muscle_2) ? path.substr(of_muscle_2.size()) : path;
}

/// The deviation that a rig's file states, of a value; none if it says nothing. What it says of the side of
/// muscle 1 holds for muscle 2 as well, until it says otherwise.
std::optional<double> deviation_of(const Stated& stated, std::string_view path, double value, double usual) {
  auto said = stated.find(std::string(path));
  if (said == stated.end()) said = stated.find(std::string(of_muscle_1(path)));
  if (said == stated.end()) return std::nullopt;
  if (std::isfinite(said->second)) return said->second;
  return std::max(thresholds.parameter.unknown * std::abs(value), thresholds.parameter.unknown_usual * usual);
}

/// Where a number stands; of a pair, whether it is that of both sides.
struct Standing {
  std::string path;
  bool both_sides = false;
};

/// The part of a side that a path leads into: `muscle.`, `effects.muscle_leak.`; empty if it is none.
std::string_view part_of_side(std::string_view path) {
  constexpr std::string_view of_effects = "effects.";
  constexpr std::array<std::string_view, 5> parts{"muscle.", "friction.", "valve.", "hose.", of_effects};
  if (std::none_of(parts.begin(), parts.end(), [&](auto part) { return path.starts_with(part); })) return {};
  const std::size_t from = path.starts_with(of_effects) ? of_effects.size() : 0;
  return path.substr(0, path.find('.', from) + 1);
}

/// Whether both sides of a pair have the same part, and are known alike.
bool is_one_part(const RigFile& rig, std::string_view part, const Stated& stated) {
  const std::string other(of_muscle_2);
  const auto numbers = domain::paths_of_numbers(rig);
  RigFile copy = rig;
  const auto same = [&](const std::string& path) {
    const double *one = domain::find_number(copy, path).value,
                 *two = domain::find_number(copy, other + path).value;
    return one != nullptr && two != nullptr && *one == *two;
  };
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](const std::string& path) { return !path.starts_with(part) || same(path); }) &&
         std::none_of(stated.begin(), stated.end(),
                      [&](const auto& one) { return one.first.starts_with(other + std::string(part)); });
}

/// What a number of the side of muscle 1, or of what both share, stands for.
std::vector<Standing> standings(const RigFile& rig, const std::string& path, const Stated& stated) {
  constexpr std::string_view one_for_both = "valve.supply_pressure";
  const std::string_view part = part_of_side(path);
  if (rig.pair() == nullptr || part.empty()) return {{path}};
  if (path == one_for_both || is_one_part(rig, part, stated)) return {{path, true}};
  return {{path}, {std::string(of_muscle_2) + path}};
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
Parameter size_of(const Candidate& candidate, bool is_size, Parameter p, const RigFile& nominal,
                  const Stated& stated) {
  p.origin = value_of(nominal, p.path);
  const double size = p.origin - (is_size ? candidate.absent : 0.0);
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
bool of_a_part(const RigFile& nominal, std::string_view path) {
  constexpr std::array<std::string_view, 7> parts{"muscle.", "friction.", "valve.",    "hose.",
                                                  "gas.",    "joint.",    "mechanics."};
  RigFile rig = nominal;
  return path.find("effects.") == std::string_view::npos && domain::find_number(rig, path).value != nullptr &&
         std::any_of(parts.begin(), parts.end(), [&](auto part) { return path.starts_with(part); });
}

/// A link's moment of inertia is at least that of its mass where its centre is (parallel axes): each of the
/// three numbers may take a third of what is to spare.
void keep_link_possible(const plant::Link& link, Parameter& p) {
  const double least = link.mass_kg * link.length_m * link.length_m;
  if (!(least > 0.0)) return;
  const double share = std::cbrt(link.inertia_kg_m2 / least);
  if (p.path == "mechanics.link_inertia") p.lowest = std::max(p.lowest, link.inertia_kg_m2 / share);
  if (p.path == "mechanics.link_mass") p.highest = std::min(p.highest, link.mass_kg * share);
  if (p.path == "mechanics.link_length") p.highest = std::min(p.highest, link.length_m * std::sqrt(share));
}

/// Gathers what a fit may move.
class Gathering {
 public:
  Gathering(const RigFile& nominal, const Stated& stated) : rig_(nominal), stated_(stated) {}

  std::vector<Parameter> operator()() {
    usual(thresholds.parameter.priors);
    if (rig_.pair() != nullptr) usual(thresholds.parameter.pair_priors);
    stated();
    of_effects();
    return std::move(list_);
  }

 private:
  template <class Priors>
  void usual(const Priors& priors) {
    for (const Prior& prior : priors) {
      if (rig_.pair() != nullptr && prior.of_hanging_load()) continue;
      for (const Standing& one : standings(rig_, std::string(prior.path), stated_))
        if (const double* value = domain::find_number(rig_, one.path).value)  // not every rig has a regulator
          add(one, prior.relative * std::abs(*value) + prior.absolute);
    }
  }
  void stated() {
    for (const auto& [path, deviation] : stated_) {
      if (!of_a_part(rig_, path)) continue;
      for (const Standing& one : standings(rig_, path, stated_)) add(one, 0.0);
    }
  }
  void of_effects() {
    for (const Candidate& candidate : catalogue(rig_)) {
      if (!candidate.carried(rig_)) continue;
      for (const Parameter& p : candidate.parameters(rig_))
        for (const Standing& one : standings(rig_, p.path, stated_)) add_size(candidate, p, one);
    }
  }
  void add_size(const Candidate& candidate, Parameter p, const Standing& at) {
    p.both_sides = at.both_sides;
    const std::string side = at.path.substr(0, at.path.size() - p.path.size());
    if (value_of(rig_, side + candidate.amplitude) == candidate.absent) return;  // this side has none
    const bool is_size = p.path == candidate.amplitude;
    p.path = at.path;
    p = size_of(candidate, is_size, std::move(p), rig_, stated_);
    if (p.scale > 0.0) list_.push_back(std::move(p));
  }
  void add(const Standing& at, double usual_deviation) {
    const bool known = std::any_of(list_.begin(), list_.end(), [&](const Parameter& p) {
      return p.path == at.path || (p.both_sides && p.path == of_muscle_1(at.path));
    });
    if (known) return;
    const Found found = find(rig_, at.path);
    const double deviation =
        deviation_of(stated_, at.path, *found.value, usual_deviation).value_or(usual_deviation);
    if (!(deviation > 0.0)) return;  // known exactly
    list_.push_back(normal(at.path, found, deviation));
    list_.back().both_sides = at.both_sides;
    if (rig_.pair() != nullptr) keep_link_possible(*rig_.pair(), list_.back());
  }

  RigFile rig_;
  const Stated& stated_;
  std::vector<Parameter> list_;
};

}  // namespace

std::vector<Parameter> nominal_parameters(const RigFile& nominal, const domain::Spreads& stated) {
  return Gathering(nominal, stated)();
}

Candidate Candidate::of(Side one) const {
  Candidate c = *this;
  c.side = one;
  if (one != Side::two) return c;
  c.amplitude.insert(0, of_muscle_2);
  if (!c.shape.empty()) c.shape.insert(0, of_muscle_2);
  for (Further& more : c.further) more.path.insert(0, of_muscle_2);
  return c;
}

namespace {

/// Whether a number of a candidate is one for both sides.
bool is_of_both(const Candidate& candidate, const RigFile& rig) {
  return rig.pair() != nullptr && candidate.side == Side::both;
}

}  // namespace

void Candidate::put(RigFile& rig, double size) const {
  Parameter{.path = amplitude, .both_sides = is_of_both(*this, rig)}.put(rig, size);
}
void Candidate::put(RigFile& rig, double size, double with_shape) const {
  const bool both = is_of_both(*this, rig);
  for (const Further& one : further) Parameter{.path = one.path, .both_sides = both}.put(rig, one.value);
  if (!shape.empty()) Parameter{.path = shape, .both_sides = both}.put(rig, with_shape);
  put(rig, size);
}

namespace {

RigFile with_law(RigFile rig, const EffectName& whose, std::string_view variant) {
  with_effect(rig, whose.effect, whose.side, [&](auto& mine) {
    if constexpr (requires { mine.variant; }) {
      for (const auto& [law, name] : names(mine.variant))
        if (name == variant) mine.variant = law;
    }
  });
  return rig;
}

/// Whether an effect is there with a law: the one of this name, or one that adds to it.
template <class E>
bool has_law(const E& mine, std::string_view variant) {
  if constexpr (requires { mine.variant; }) {
    std::string_view chosen;
    for (const auto& [law, name] : names(mine.variant))
      if (law == mine.variant) chosen = name;
    return std::ranges::any_of(E::variants, [&](const plant::Variant& law) {
      return law.name == chosen && (law.name == variant || law.adds_to == variant);
    });
  }
  return true;
}

}  // namespace

RigFile Candidate::chosen(RigFile rig) const {
  return with_law(std::move(rig), who(), variant);
}

bool Candidate::carried(RigFile rig) const {
  bool present = false;
  with_effect(rig, effect, side,
              [&](const auto& mine) { present = present || (!mine.absent() && has_law(mine, variant)); });
  return present;
}

bool Candidate::fits(const RigFile& rig) const {
  if (adds_to.empty()) return !carries(rig, effect, side);
  Candidate base = *this;
  base.variant = adds_to;
  if (!base.carried(rig) || carried(rig)) return false;
  if (rig.pair() == nullptr) return true;  // of a pair: where that law stands, and nowhere else
  const auto on = [&](Side one) { return carries(rig, effect, one); };
  return side == Side::both ? on(Side::one) && on(Side::two) : !on(other(side));
}

RigFile Candidate::removed(RigFile rig) const {
  put(rig, absent);
  return adds_to.empty() ? rig : with_law(std::move(rig), who(), adds_to);
}

namespace {

/// A further parameter as a fit moves it: by its logarithm, if it is never negative.
Parameter moved(const Further& one, bool both_sides) {
  if (one.lowest > 0.0)
    return {.path = one.path,
            .scale = 1.0,
            .step = thresholds.parameter.shape_step,
            .lowest = one.lowest,
            .highest = one.highest,
            .logarithmic = true,
            .both_sides = both_sides};
  const double reach = one.highest - one.lowest;
  return {.path = one.path,
          .origin = one.value,
          .scale = 0.25 * reach,
          .step = thresholds.parameter.shape_step * reach,
          .lowest = one.lowest,
          .highest = one.highest,
          .both_sides = both_sides};
}

/// A law of the user's own, as one of the catalogue. A second parameter that is always positive is its shape.
Candidate candidate_of(const plant::LawText& law) {
  const std::string prefix = "effects." + std::string(of_laws) + "." + law.name + ".";
  const plant::LawText::Parameter& size = law.parameters.front();
  Candidate c{.effect = law.name,
              .variant = "",
              .amplitude = prefix + size.name,
              .shape = "",
              .typical = size.typical,
              .step = 1e-3 * std::abs(size.typical),
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

/// What a user's law acts on: whether data of a given pressure show it.
bool makes_pressure(const plant::LawText& law) {
  return law.adds == plant::LawTarget::outflow || law.adds == plant::LawTarget::command;
}

}  // namespace

std::vector<Parameter> Candidate::parameters(const RigFile& rig) const {
  RigFile copy = rig;
  const bool both = is_of_both(*this, rig);
  const Found size = find(copy, amplitude);
  // Next to nothing is as good as nothing, and can be stiff: a supply line of no resistance, a lag of no
  // time.
  const double least = absent + thresholds.parameter.least_size * typical;
  std::vector<Parameter> list{{.path = amplitude,
                               .origin = absent,
                               .scale = std::abs(typical),
                               .step = step,
                               .lowest = either_sign || typical < 0.0 ? size.lowest : least,
                               .highest = either_sign || typical > 0.0 ? size.highest : least,
                               .both_sides = both}};
  if (!shape.empty()) {
    const Found form = find(copy, shape);
    list.push_back({.path = shape,
                    .scale = 1.0,
                    .step = thresholds.parameter.shape_step,
                    .lowest = own ? form.lowest
                                  : std::max(form.lowest, shapes.front() / thresholds.parameter.shape_range),
                    .highest = own ? form.highest
                                   : std::min(form.highest, shapes.back() * thresholds.parameter.shape_range),
                    .logarithmic = true,
                    .both_sides = both});
  }
  for (const Further& one : further) list.push_back(moved(one, both));
  return list;
}

bool Candidate::moves(std::string_view path) const {
  return path == amplitude || path == shape ||
         std::ranges::any_of(further, [&](const Further& one) { return one.path == path; });
}

std::vector<Candidate> Candidate::variations() const {
  std::vector<Candidate> list{*this};
  for (std::size_t i = 0; i < further.size(); ++i)
    for (const double value : further[i].values) {
      if (value == further[i].value) continue;
      list.push_back(*this);
      list.back().further[i].value = value;
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
  const std::string_view path = of_muscle_1(p.path);
  const auto begins = [&](std::string_view part) { return path.starts_with(part); };
  return begins("valve.") || begins("hose.") || begins("gas.") || path == "muscle.dead_volume";
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
  bool makes_pressure = true, load_guide = true, gauge = true, opposite_gauge = false, pair = false;
};

std::vector<Candidate> in_sight(const Sight& sight) {
  std::vector<Candidate> list;
  const auto add = [&]<class E>(const E& effect) {
    if (!sight.makes_pressure && makes_pressure<E>()) return;
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
                  .step = law.step,
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

}  // namespace

std::vector<Candidate> catalogue() {
  return in_sight({});
}
std::vector<Candidate> catalogue(const RigFile& rig) {
  std::vector<Candidate> list = catalogue();
  for (const auto& law : rig.effects.laws.list) list.push_back(candidate_of(*law.text));
  return list;
}
std::vector<Candidate> catalogue(const domain::Dataset& data) {
  const bool given = data.pressure_is_given();
  const auto read = [&](const auto& gauge) {
    return std::ranges::any_of(data.runs, [&](const domain::Run& run) { return (run.*gauge).has_value(); });
  };
  const bool pair = data.rig.pair() != nullptr;
  std::vector<Candidate> list = in_sight({.makes_pressure = !given,
                                          .load_guide = !pair,
                                          .gauge = given || read(&domain::Run::muscle_pressure_Pa),
                                          .opposite_gauge = given || read(&domain::Run::opposite_pressure_Pa),
                                          .pair = pair});
  for (const auto& law : data.rig.effects.laws.list)
    if (!given || !makes_pressure(*law.text)) list.push_back(candidate_of(*law.text));
  return list;
}

}  // namespace mckibben::diagnose
