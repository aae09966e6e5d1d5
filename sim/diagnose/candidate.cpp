// How a candidate is put into a rig and found there, and what of it a fit moves; see the header.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include <plant/names.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

void each_side(Rig& rig, const std::function<void(plant::Effects& effects)>& visit, Side side) {
  if (side != Side::two) visit(rig.effects);
  if (plant::Pair* pair = rig.pair(); pair != nullptr && side != Side::one) visit(pair->opposite.effects);
}

namespace {

/// Calls `tell` with the effect of this name in the rig, on each of these sides.
template <class Tell>
void with_effect(Rig& rig, std::string_view effect, Side side, const Tell& tell) {
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

bool carries(Rig rig, std::string_view effect, Side side) {
  bool present = false;
  with_effect(rig, effect, side, [&](const auto& mine) { present = present || !mine.absent(); });
  return present;
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
bool is_of_both(const Candidate& candidate, const Rig& rig) {
  return rig.pair() != nullptr && candidate.side == Side::both;
}

}  // namespace

void Candidate::put(Rig& rig, double size) const {
  Parameter{.path = amplitude, .both_sides = is_of_both(*this, rig)}.put(rig, size);
}
void Candidate::put(Rig& rig, double size, double with_shape) const {
  const bool both = is_of_both(*this, rig);
  for (const Further& one : further) Parameter{.path = one.path, .both_sides = both}.put(rig, one.value);
  if (!shape.empty()) Parameter{.path = shape, .both_sides = both}.put(rig, with_shape);
  put(rig, size);
}

namespace {

Rig with_law(Rig rig, const EffectName& whose, std::string_view variant) {
  with_effect(rig, whose.effect, whose.side, [&](auto& mine) {
    if constexpr (requires { mine.variant; }) {
      if (const auto law = plant::named<decltype(mine.variant)>(variant)) mine.variant = *law;
    }
  });
  return rig;
}

/// Whether an effect is there with a law: the one of this name, or one that adds to it.
template <class E>
bool has_law(const E& mine, std::string_view variant) {
  if constexpr (requires { mine.variant; }) {
    const std::string_view chosen = plant::name_of(mine.variant);
    return std::ranges::any_of(E::variants, [&](const plant::Variant& law) {
      return law.name == chosen && (law.name == variant || law.adds_to == variant);
    });
  }
  return true;
}

}  // namespace

Rig Candidate::chosen(Rig rig) const {
  return with_law(std::move(rig), who(), variant);
}

bool Candidate::carried(Rig rig) const {
  bool present = false;
  with_effect(rig, effect, side,
              [&](const auto& mine) { present = present || (!mine.absent() && has_law(mine, variant)); });
  return present;
}

bool Candidate::fits(const Rig& rig) const {
  if (adds_to.empty()) return !carries(rig, effect, side);
  Candidate base = *this;
  base.variant = adds_to;
  if (!base.carried(rig) || carried(rig)) return false;
  if (rig.pair() == nullptr) return true;  // of a pair: where that law stands, and nowhere else
  const auto on = [&](Side one) { return carries(rig, effect, one); };
  return side == Side::both ? on(Side::one) && on(Side::two) : !on(other(side));
}

Rig Candidate::removed(Rig rig) const {
  put(rig, absent);
  return adds_to.empty() ? rig : with_law(std::move(rig), who(), adds_to);
}

namespace {

/// A further parameter as a fit moves it: by its logarithm, if it is never negative.
Parameter moved(const Further& one, bool both_sides) {
  if (one.lowest > 0.0)
    return {.path = one.path,
            .origin = 1.0,
            .lowest = one.lowest,
            .highest = one.highest,
            .logarithmic = true,
            .both_sides = both_sides};
  const double reach = one.highest - one.lowest;
  return {.path = one.path,
          .origin = one.value,
          .scale = 0.25 * reach,
          .lowest = one.lowest,
          .highest = one.highest,
          .both_sides = both_sides};
}

}  // namespace

std::vector<Parameter> Candidate::parameters(const Rig& rig) const {
  Rig copy = rig;
  const bool both = is_of_both(*this, rig);
  const Found size = find(copy, amplitude);
  // Next to nothing is as good as nothing, and can be stiff: a supply line of no resistance, a lag of no
  // time.
  const double least = absent + thresholds.parameter.least_size * typical;
  std::vector<Parameter> list{{.path = amplitude,
                               .origin = absent,
                               .scale = std::abs(typical),
                               .lowest = either_sign || typical < 0.0 ? size.lowest : least,
                               .highest = either_sign || typical > 0.0 ? size.highest : least,
                               .both_sides = both}};
  if (!shape.empty()) {
    const Found form = find(copy, shape);
    list.push_back({.path = shape,
                    .origin = 1.0,
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

}  // namespace mckibben::diagnose
