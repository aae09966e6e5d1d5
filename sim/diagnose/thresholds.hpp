// Every number that the diagnosis decides by: its unit, what it means, where it comes from. No other file of
// this room has such a number.
#pragma once

#include <cstddef>

namespace mckibben::diagnose {

/// Chosen, unless another origin is told.
struct NearThresholds {
  double floors = 4.0;         ///< rms: residuals within it are noise, slow disturbances included
  double nothing_left = 0.04;  ///< mean square above the floor's: nothing is left to find

  constexpr double mean_square() const { return floors * floors; }
};

/// Whether one model is better than another on runs held out. Set on seeds that the benchmark does not score.
struct ImprovementThresholds {
  double share = 0.10;        ///< of the gap, at least
  double gained = 0.03;       ///< mean square, over the floor's, at least
  double significance = 2.0;  ///< standard errors, at least
  double clear_share = 0.5;   ///< of the gap, that is certain whatever its standard error
  double better = 0.5;        ///< share of runs that must gain, more than
};

/// The verdict. Mean squares are above the floor's and over it. Chosen.
struct DecideThresholds {
  double worth_a_law = 0.15;        ///< mean square that is worth a search for a law, and each further term
  double worth_a_law_share = 0.05;  ///< of the described rig's mean square, that is worth it too
  double law_share = 0.3;           ///< of the gap, that a law must close, more than
  double law_beyond_names = 0.4;    ///< of what the names leave, that a law may leave, less than
  double named_share = 0.4;         ///< of a gap worth a law, that effects must close to be named
  double nearly_all = 0.9;          ///< of the gap: they are named whatever is left
  double hopeless = 600.0;          ///< mean square that no fit of the right effect leaves that stopped early
  double beyond_disturbance = 60.0;  ///< mean square that no slow disturbance leaves
  double invisible = 0.5;            ///< of the catalogue: if more of it would not show, nothing can be told
  double contradicted = 1.0;         ///< mean square of the motion that makes the gauge a suspect
  double without_gauge = 0.25;       ///< of that, that may be left where the gauge is ignored
};

struct Thresholds {
  NearThresholds near{};
  ImprovementThresholds improvement{};
  DecideThresholds decide{};
};

inline constexpr Thresholds thresholds{};

}  // namespace mckibben::diagnose
