// Effects that a rig may be given: of the catalogue, or a law of the user's own. Of a pair, an effect may be
// of both sides alike, or of one.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/diagnose/parameter.hpp>

namespace mckibben::diagnose {

/// Calls `visit` with the effects of each side of the rig, or of one.
void each_side(Rig& rig, const std::function<void(plant::Effects& effects)>& visit, Side side = Side::both);

/// Whether this effect of the catalogue is in the rig, on one of these sides.
bool carries(Rig rig, std::string_view effect, Side side = Side::both);

/// A parameter of a law, besides its size, and the values to begin a fit from.
struct Further {
  std::string path;
  double value = 0.0;          ///< that the candidate has
  std::vector<double> values;  ///< all of them
  double lowest = 0.0, highest = 0.0;
};

/// One law variant of an effect of the catalogue; or a law of the user's own, whose size is its first
/// parameter and whose shape the second.
struct Candidate {
  std::string effect;            ///< its name
  std::string variant;           ///< of the law; empty if there is one only
  std::string amplitude, shape;  ///< paths; `shape` empty if there is none
  double absent = 0.0, typical = 0.0;
  bool either_sign = false;
  std::vector<double> shapes;      ///< to begin from
  std::string adds_to{};           ///< the law that this one is with a term more; empty if it stands alone
  std::vector<Further> further{};  ///< what a user's law has besides size and shape
  bool own = false;                ///< of the user's own: its ranges are the file's
  Side side = Side::both;          ///< of a pair: whose it is

  EffectName who() const { return {effect, side}; }
  /// The same law on one side of a pair alone.
  Candidate of(Side one) const;
  /// Gives it this size in a rig; and a shape, if it has one.
  void put(Rig& rig, double size) const;
  void put(Rig& rig, double size, double with_shape) const;
  /// The rig with this law chosen, still without size.
  Rig chosen(Rig rig) const;
  /// Whether the rig has this effect on one of its sides, with this law or one that adds to it.
  bool carried(Rig rig) const;
  /// Whether a rig may get it: one without this effect, or with the law that it adds to.
  bool fits(const Rig& rig) const;
  /// The rig without it; with what it adds to.
  Rig removed(Rig rig) const;
  /// What a fit moves: amplitude and, if any, shape and further parameters.
  std::vector<Parameter> parameters(const Rig& rig) const;
  /// Itself, and with each further parameter at each of its other values: what is scored.
  std::vector<Candidate> variations() const;
};

}  // namespace mckibben::diagnose
