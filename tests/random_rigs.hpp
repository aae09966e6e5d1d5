// Rigs drawn at random, by walking their field lists: within a factor of the thesis's rig, or over everything
// that is documented; and currents to drive them. Shared by tests and benchmark.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <random>
#include <string_view>
#include <type_traits>
#include <vector>

#include <plant/geometry.hpp>

#include "switched_on.hpp"

namespace mckibben::plant {

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  double around(double value, double factor) { return log_between(value / factor, value * factor); }
  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }

 private:
  std::mt19937 random_;
};

/// Whether a struct and all those in it keep their own rules.
struct RulesKept {
  bool kept = true;
  template <class T>
  void check(const T& value) {
    const auto report = [&](std::string_view, std::string_view) { kept = false; };
    if constexpr (requires { value.rules(report); }) value.rules(report);
  }
  template <class T, class... Rest>
  void operator()(std::string_view, T& value, Rest&&...) {
    if constexpr (requires { T::fields(value, *this); }) T::fields(value, *this);
    if constexpr (std::is_same_v<std::remove_const_t<T>, Sensors>)
      for (const Sensor& sensor : value) check(sensor);
    check(value);
  }
  template <class T, class... Rest>
  void required(std::string_view key, T& value, Rest&&... rest) {
    (*this)(key, value, rest...);
  }
};
inline bool rules_kept(const Rig& rig) {
  RulesKept rules;
  Rig::parts(rig, rules);
  rules.check(rig);
  return rules.kept;
}

template <class T>
concept AnEffect = requires {
  T::variants;
};

/// Moves every quantity of a field list by up to `factor`, or over its whole range if `factor` is 0. One
/// effect in `one_in` is on: at its usual size times 1/2 to 2, or anywhere in its ranges.
struct Shuffle {
  Chance& chance;
  double factor = 0.0;
  int one_in = 4;
  bool ends_of_the_way = false;  ///< have been walked

  void operator()(std::string_view key, double& value, std::string_view, double lowest, double highest,
                  std::string_view) {
    if (key == "tick" || key == "settling_time") return;  // ours to choose: they cost time, not trouble
    if (key == "length_offset" || key == "reading_offset") return;  // of the bench, not of the rig
    if (key == "spring_preload") return;                           // beyond what the threads bear, most of it
    if (key == "end_length" || key == "exhaust_pressure") return;  // against the rules, most of it
    if (key == "lowest_command") return;
    ends_of_the_way = ends_of_the_way || key == "lowest_contraction";  // a joint has none
    if (ends_of_the_way &&
        (key.ends_with("_contraction") || key.ends_with("_angle") || key.starts_with("stop_")))
      return;
    if (factor > 0.0) {
      value = std::clamp(value * chance.around(1.0, factor), lowest, highest);
    } else if (lowest > 0.0 && highest > 50.0 * lowest) {
      value = chance.log_between(lowest, highest);
    } else if (lowest == 0.0) {  // anything from nothing to the most, most of it in the middle
      value = chance.pick(8) == 0 ? 0.0 : chance.log_between(1e-7 * highest, highest);
    } else {
      value = chance.between(lowest, highest);
    }
  }
  void operator()(std::string_view, std::optional<double>&, std::string_view, double, double,
                  std::string_view) {}
  template <std::integral T>
  void operator()(std::string_view, T& value, std::type_identity_t<T> lowest, std::type_identity_t<T> highest,
                  std::string_view) {
    if (factor == 0.0)
      value = static_cast<T>(
          chance.log_between(static_cast<double>(lowest), static_cast<double>(highest) + 0.99));
  }
  template <class T>
  void operator()(std::string_view, T& value, std::string_view) {
    if constexpr (std::is_same_v<T, bool>) {
      value = chance.pick(2) == 0;
    } else if constexpr (AnEffect<T>) {
      if (chance.pick(one_in) == 0) shuffle_effect(value);
    } else if constexpr (std::is_same_v<T, ValveKind>) {  // of a regulator more must be said
    } else if constexpr (std::is_same_v<T, Cord>) {       // draw_cord
    } else if constexpr (std::is_same_v<T,
                                        Sensors>) {  // an encoder, and a gauge or none; no law knows others
      Sensor::fields(value.position(), *this);
      const bool fitted = chance.pick(2) == 0;
      Sensor other = gauge();
      (*this)("resolution", other.resolution, "Pa", 0.0, 1e5, "");
      if (fitted) value.put(other);
    } else if constexpr (std::is_enum_v<T>) {
      const auto all = names(T{});
      value = all[static_cast<std::size_t>(chance.pick(static_cast<int>(all.size())))].first;
    } else if constexpr (requires { T::fields(value, *this); }) {
      T::fields(value, *this);
    }
  }

 private:
  template <class E>
  void shuffle_effect(E& effect) {
    if constexpr (E::variants.size() == 0) {
      switch_on(effect);
    } else {
      const Variant& variant =
          E::variants[static_cast<std::size_t>(chance.pick(static_cast<int>(E::variants.size())))];
      switch_on(effect, variant, chance.around(1.0, 2.0));
      if (factor == 0.0) E::fields(effect, *this);
      // What the variant does not use stays as drawn; its amplitude is never left absent by chance alone.
    }
  }
};

/// A rig within a factor 2 of the thesis's with every effect at about its usual size or absent; or one from
/// the whole of the documented ranges.
inline Rig shuffled_rig(Chance& chance, bool whole_range) {
  for (;;) {
    Rig rig;
    Shuffle shuffle{chance, whole_range ? 0.0 : 2.0};
    Rig::parts(rig, shuffle);
    rig.tick_s = whole_range ? chance.log_between(1e-3, 0.1) : chance.around(0.012, 2.0);
    if (rules_kept(rig)) return rig;
  }
}
struct LoadedRig {
  Rig rig;
  double load_kg;
};
/// Such a rig with a load that it can bear.
inline LoadedRig random_rig(Chance& chance, bool whole_range) {
  for (;;) {
    const Rig rig = shuffled_rig(chance, whole_range);
    const double load_kg = whole_range ? chance.log_between(0.01, 500.0) : chance.around(15.0, 2.0);
    const double hung_kg = load_kg + rig.joint.load_offset_kg;
    if (hung_kg > 0.0 && hung_kg <= Braid(rig.muscle).largest_load_kg()) return {rig, load_kg};
  }
}

/// One rig in three hangs its load on a cord that stretches, where its threads may: drawn last, so that all
/// else of a seed is as without.
inline void draw_cord(Chance& chance, Muscle& muscle, FrictionMemory threads) {
  if (threads == FrictionMemory::coulomb || chance.pick(3) > 0) return;
  muscle.cord = {.stiffness_N_per_m = chance.log_between(5e3, 1e6),
                 .damping_N_s_per_m = chance.log_between(10.0, 1e3),
                 .end_mass_kg = chance.log_between(0.01, 1.0)};
}

/// Jumps, ramps and rests in any order.
inline std::vector<double> random_current(Chance& chance, std::size_t ticks, double largest_mA = 20.0) {
  std::vector<double> current_mA;
  double now_mA = chance.between(0.0, largest_mA);
  while (current_mA.size() < ticks) {
    const double to_mA = chance.between(0.0, largest_mA);
    const int lasting = 1 + chance.pick(80);
    const bool jump = chance.pick(3) == 0;
    for (int i = 1; i <= lasting && current_mA.size() < ticks; ++i)
      current_mA.push_back(jump ? to_mA : now_mA + (to_mA - now_mA) * i / lasting);
    now_mA = to_mA;
  }
  return current_mA;
}

}  // namespace mckibben::plant
