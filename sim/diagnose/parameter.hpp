// Parameters of a rig by name: those that a calibration may move, with what a data sheet says of them, and
// those that switch effects on. A name is the path of keys in a rig file, `muscle.rest_radius`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <plant/rig.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/domain/spread.hpp>

namespace mckibben::diagnose {

using Found = domain::RigNumber;

/// Throws std::invalid_argument for a path that leads to no number.
Found find(plant::Rig& rig, std::string_view path);
double value_of(const plant::Rig& rig, std::string_view path);

/// Whether this effect of the catalogue is in the rig.
bool carries(plant::Rig rig, std::string_view effect);

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

  bool of_effect() const { return path.starts_with("effects."); }
  double unscaled(double number) const;
  double scaled(double value) const;
};

/// The nominal parameters, with priors as tight as a data sheet or a ruler; those that the rig's file says
/// how well it knows, with that (also of parameters that would not move else; one that is known exactly does
/// not). Those of effects that the rig has already count with them; their size is believed to a factor of a
/// few, or to what is typical, whichever is more.
std::vector<Parameter> nominal_parameters(const plant::Rig& nominal, const domain::Spreads& stated = {});

/// One law variant of an effect of the catalogue.
struct Candidate {
  std::string effect;            ///< its name
  std::string variant;           ///< of the law; empty if there is one only
  std::string amplitude, shape;  ///< paths; `shape` empty if there is none
  double absent = 0.0, typical = 0.0, step = 0.0;
  bool either_sign = false;
  std::vector<double> shapes;  ///< to begin from

  /// The rig with this law chosen, still without size.
  plant::Rig chosen(plant::Rig rig) const;
  /// Whether the rig has this effect, with this law.
  bool carried(plant::Rig rig) const;
  /// What a fit moves: amplitude and, if any, shape.
  std::vector<Parameter> parameters(const plant::Rig& rig) const;
};

/// The whole catalogue, in the order of its table; where the muscle's pressure is given, without what acts on
/// valve, supply, hose and gas alone: out of sight.
std::vector<Candidate> catalogue(bool pressure_is_given = false);

/// Effects of the catalogue, and parameters, that a given pressure leaves nothing to see of.
std::vector<std::string> effects_out_of_sight();
bool out_of_sight(const Parameter& parameter);

}  // namespace mckibben::diagnose
