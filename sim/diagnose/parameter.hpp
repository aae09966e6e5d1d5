// Parameters of a rig by name: the path of keys in a rig file, `muscle.rest_radius`.
//
// Of a pair, a part that is the same on both sides (muscle, friction, valve, hose) is one to a fit; of one
// that is not, each side's numbers are free by themselves, those of muscle 2 as
// `mechanics.opposite.muscle.rest_radius`.
#pragma once

#include <string>
#include <string_view>

#include <plant/rig.hpp>
#include <sim/diagnose/side.hpp>
#include <sim/domain/rig_number.hpp>

namespace mckibben::diagnose {

using plant::Rig;
using Found = domain::RigNumber;

/// Under this key of a rig's effects stand the laws of a user's own.
inline constexpr std::string_view of_laws = "hypotheses";

/// What the path of a number of muscle 2's side begins with, of a pair.
inline constexpr std::string_view of_muscle_2 = "mechanics.opposite.";
/// The path of a number on the side of muscle 1 that stands for the same.
std::string_view of_muscle_1(std::string_view path);

/// Throws std::invalid_argument for a path that leads to no number.
Found find(Rig& rig, std::string_view path);
double value_of(const Rig& rig, std::string_view path);

/// What the paths of an effect's numbers begin with: `effects.muscle_leak.`.
std::string keys_of(const EffectName& who);

/// A parameter that a fit may move.
struct Parameter {
  std::string path;
  double origin = 0.0;  ///< where the fit counts from: the nominal value, or that of an absent effect
  double scale = 1.0;   ///< what it counts in: a prior deviation, or a size that matters
  double lowest = 0.0, highest = 0.0;
  bool has_prior = false;    ///< normal round `origin`, with `scale` as deviation
  bool logarithmic = false;  ///< counts in logarithms, from that of `origin`
  bool both_sides = false;   ///< of a pair: the number of muscle 2's side is the same one

  bool of_effect() const { return path.find("effects.") != std::string::npos; }
  void put(Rig& rig, double value) const;
  double unscaled(double number) const;
  double scaled(double value) const;
  /// Of its value, where it is this: per unit that a fit counts in.
  double unit(double value) const { return logarithmic ? scale * value : scale; }
};

}  // namespace mckibben::diagnose
