// Effects by the keys of their field lists, and rigs with one or all of them switched on; shared by the tests
// of several rooms.
#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <plant/rig.hpp>

namespace mckibben::plant {

/// A quantity of an effect's field list.
struct Parameter {
  std::string_view key;
  double* value;
  double lowest, highest;
};

/// The visitor that finds them, and chooses the law variant of that name on the way.
struct ParameterFinder {
  std::string_view variant{};
  std::vector<Parameter> found{};

  void operator()(std::string_view key, double& value, std::string_view, double lowest, double highest,
                  std::string_view) {
    found.push_back({key, &value, lowest, highest});
  }
  void operator()(std::string_view, int&, int, int, std::string_view) {}  // a choice
  template <class T>
  void operator()(std::string_view key, T& value, std::string_view) {
    if constexpr (std::is_enum_v<T>)
      for (const auto& [known, name] : names(T{}))
        if (key == "variant" && name == variant) value = known;
  }
};

template <class E>
std::vector<Parameter> parameters_of(E& effect, std::string_view variant = {}) {
  ParameterFinder finder{variant};
  E::fields(effect, finder);
  return finder.found;
}

/// The value under a key; null if there is none.
inline Parameter* find(std::vector<Parameter>& parameters, std::string_view key) {
  for (auto& parameter : parameters)
    if (parameter.key == key) return &parameter;
  return nullptr;
}

/// The law of this effect that a key is the amplitude of: the variant's own, or that it adds to; null if it
/// is of neither.
template <class E>
const Variant* sized_by(const Variant& variant, std::string_view key) {
  for (const Variant& law : E::variants)
    if ((law.name == variant.name || law.name == variant.adds_to) && law.amplitude == key) return &law;
  return nullptr;
}

/// Makes an effect as large as `share` of its variant's typical size.
template <class E>
void switch_on(E& effect, const Variant& variant, double share = 1.0) {
  auto parameters = parameters_of(effect, variant.name);
  *find(parameters, variant.amplitude)->value = variant.absent + share * variant.typical;
  if (auto* shape = find(parameters, variant.shape)) *shape->value = variant.middle;
}
inline void switch_on(ResidualForce& effect) {
  effect.terms = {{Basis::pressure_ratio, -2.0}, {Basis::sine, 1.0, 0.02}, {Basis::speed_squared, -1.0}};
}

struct NamedRig {
  std::string name;
  Rig rig;
};

/// The nominal rig with each law variant of each effect, one at a time.
inline std::vector<NamedRig> rigs_with_one_effect() {
  std::vector<NamedRig> rigs;
  const auto add = [&]<class E>(const E&) {
    for (const Variant& variant : E::variants) {
      rigs.push_back(
          {std::string(E::name) + (variant.name.empty() ? "" : "_") + std::string(variant.name), {}});
      switch_on(rigs.back().rig.effects.get<E>(), variant);
    }
    if constexpr (E::variants.size() == 0) {
      rigs.push_back({std::string(E::name), {}});
      switch_on(rigs.back().rig.effects.get<E>());
    }
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, Effects::Table{});
  return rigs;
}

/// The nominal rig with all of them at once, each in its first law variant.
inline Rig rig_with_all_effects() {
  Rig rig;
  const auto add = [&]<class E>(E& effect) {
    if constexpr (E::variants.size() == 0)
      switch_on(effect);
    else
      switch_on(effect, E::variants.front());
  };
  std::apply([&](auto&... effect) { (add(effect), ...); }, rig.effects.all);
  return rig;
}

}  // namespace mckibben::plant
