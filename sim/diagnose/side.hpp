// Which muscle of a pair has an effect, as it is named and told. Of one muscle there is no other, and what
// both muscles have alike, or share, is of both.
#pragma once

#include <string>
#include <utility>

namespace mckibben::diagnose {

enum class Side { both, one, two };

/// " of muscle 2"; empty for both.
inline std::string of_muscle(Side side) {
  if (side == Side::both) return {};
  return side == Side::one ? " of muscle 1" : " of muscle 2";
}

inline Side other(Side side) {
  if (side == Side::both) return side;
  return side == Side::one ? Side::two : Side::one;
}

/// What an effect is known by.
struct EffectName {
  std::string effect;  ///< in the catalogue
  Side side = Side::both;

  EffectName() = default;
  EffectName(std::string of_catalogue, Side of = Side::both) : effect(std::move(of_catalogue)), side(of) {}
  EffectName(const char* of_catalogue) : effect(of_catalogue) {}

  bool operator==(const EffectName&) const = default;
  std::string words() const { return effect + of_muscle(side); }
};

}  // namespace mckibben::diagnose
