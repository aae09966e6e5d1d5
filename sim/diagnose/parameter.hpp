// Parameters of a rig by name: those that a calibration may move, with what a data sheet says of them, and
// those that switch effects on. A name is the path of keys in a rig file, `muscle.rest_radius`.
//
// Of a pair, an effect may be of both sides alike, or of one. A part that is the same on both sides (muscle,
// friction, valve, hose) is one to a fit; of one that is not, each side's numbers are free by themselves,
// those of muscle 2 as `mechanics.opposite.muscle.rest_radius`.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/diagnose/side.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/domain/rig_file.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/domain/spread.hpp>

namespace mckibben::diagnose {

using domain::RigFile;
using Found = domain::RigNumber;

/// Under this key of a rig's effects stand the laws of a user's own.
inline constexpr std::string_view of_laws = "hypotheses";

/// Throws std::invalid_argument for a path that leads to no number.
Found find(RigFile& rig, std::string_view path);
double value_of(const RigFile& rig, std::string_view path);

/// What the paths of an effect's numbers begin with: `effects.muscle_leak.`.
std::string keys_of(const EffectName& who);

/// Calls `visit` with the effects of each side of the rig, or of one.
void each_side(RigFile& rig, const std::function<void(plant::Effects& effects)>& visit,
               Side side = Side::both);

/// Whether this effect of the catalogue is in the rig, on one of these sides.
bool carries(RigFile rig, std::string_view effect, Side side = Side::both);

/// A parameter that a fit may move.
struct Parameter {
  std::string path;
  double origin = 0.0;  ///< where the fit counts from: the nominal value, or that of an absent effect
  double scale = 1.0;   ///< what it counts in: a prior deviation, or a size that matters
  double step = 0.0;    ///< for differences
  double lowest = 0.0, highest = 0.0;
  bool has_prior = false;    ///< normal round `origin`, with `scale` as deviation
  bool logarithmic = false;  ///< counts in logarithms, from 1 in its unit
  double period = 0.0;       ///< values so far apart are the same, an angle; 0: none are
  double widened = 1.0;      ///< `scale` over the deviation that is stated, of a prior that was made wider
  bool both_sides = false;   ///< of a pair: the number of muscle 2's side is the same one

  bool of_effect() const { return path.find("effects.") != std::string::npos; }
  void put(RigFile& rig, double value) const;
  double unscaled(double number) const;
  double scaled(double value) const;
  /// From the origin, of the prior that is stated.
  double deviations(double value) const { return scaled(value) * widened; }
};

/// The nominal parameters, with priors as tight as a data sheet or a ruler; those that the rig's file says
/// how well it knows, with that (also of parameters that would not move else; one that is known exactly does
/// not). Those of effects that the rig has already count with them; their size is believed to a factor of a
/// few, or to what is typical, whichever is more.
std::vector<Parameter> nominal_parameters(const RigFile& nominal, const domain::Spreads& stated = {});

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
  double absent = 0.0, typical = 0.0, step = 0.0;
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
  void put(RigFile& rig, double size) const;
  void put(RigFile& rig, double size, double with_shape) const;
  /// The rig with this law chosen, still without size.
  RigFile chosen(RigFile rig) const;
  /// Whether the rig has this effect on one of its sides, with this law or one that adds to it.
  bool carried(RigFile rig) const;
  /// Whether a rig may get it: one without this effect, or with the law that it adds to.
  bool fits(const RigFile& rig) const;
  /// The rig without it; with what it adds to.
  RigFile removed(RigFile rig) const;
  /// What a fit moves: amplitude and, if any, shape and further parameters.
  std::vector<Parameter> parameters(const RigFile& rig) const;
  bool moves(std::string_view path) const;
  /// Itself, and with each further parameter at each of its other values: what is scored.
  std::vector<Candidate> variations() const;
};

/// The whole catalogue, in the order of its table.
std::vector<Candidate> catalogue();
/// The same, and the rig's laws of the user's own.
std::vector<Candidate> catalogue(const RigFile& rig);
/// What these data can show of both: where the muscle's pressure is given, without what acts on valve,
/// supply, hose and gas alone, of a pair without the guide of a load, without a gauge no errors of one. Of a
/// pair, what may be of one muscle alone stands there for both, for muscle 1 and for muscle 2.
std::vector<Candidate> catalogue(const domain::Dataset& data);

/// Effects of the catalogue, and parameters, that a given pressure leaves nothing to see of.
std::vector<std::string> effects_out_of_sight();
bool out_of_sight(const Parameter& parameter);

}  // namespace mckibben::diagnose
