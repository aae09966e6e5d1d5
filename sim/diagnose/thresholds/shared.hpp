// Thresholds that all stages share: what is near the noise floor, how long residuals remember, how far a
// parameter may be from what is said of it.
#pragma once

#include <array>
#include <string_view>

namespace mckibben::diagnose {

struct NearThresholds {
  double floors = 4.0;         ///< rms: residuals within it are noise, slow disturbances included
  double nothing_left = 0.04;  ///< left: there is nothing to find. Twice as much on runs that were fitted
  double chance = 6.0;         ///< fall of the misfit, expected or come true, that is chance below
  double clear = 12.0;         ///< difference of misfits that scatter does not make

  constexpr double mean_square() const { return floors * floors; }
  /// `left`: mean square above the floor's, over it.
  constexpr bool is_much(double left) const { return left + 1.0 > mean_square(); }
};

/// Residuals are correlated: how long, and what is assumed until a model has been fitted.
struct ScatterThresholds {
  double segment_s = 1.5;  ///< longer than residuals remember: window, clusters, signs that are flipped
  double first_inflation = 20.0;  ///< variance of residuals over long times, over white noise's
};

/// What a simulation is asked for.
struct PredictThresholds {
  double tolerance = 3e-6;  ///< relative. Errors in e of 5e-6, measured: far below a count
  double tolerance_alone =
      1e-7;  ///< of rigs without common steps: differences must be theirs, not their steps'
};

/// How far a nominal parameter may be from what is said of it: relative to its value, or absolute.
struct Prior {
  std::string_view path;
  double relative, absolute;  ///< standard deviation; absolute in the parameter's unit

  bool of_hanging_load() const { return path.starts_with("joint."); }
};
struct ParameterThresholds {
  /// Machined lengths are known to a per cent, catalogue conductances and friction to ten, trimmed pressures
  /// [Pa] to a reading of the gauge, the load [kg] to a scale's. A regulator's lag, measured with another
  /// volume behind it, to a third.
  std::array<Prior, 14> priors{{{"muscle.rest_radius", 0.01, 0.0},
                                {"muscle.end_correction", 0.01, 0.0},
                                {"muscle.braid_angle", 0.01, 0.0},
                                {"muscle.dead_volume", 0.3, 0.0},
                                {"friction.scale", 0.1, 0.0},
                                {"valve.conductance", 0.1, 0.0},
                                {"valve.zero_pressure", 0.0, 1e3},
                                {"valve.span_pressure", 0.0, 2e3},
                                {"valve.time_constant", 0.3, 0.0},
                                {"valve.natural_frequency", 0.3, 0.0},
                                {"valve.damping", 0.3, 0.0},
                                {"hose.conductance", 0.1, 0.0},
                                {"joint.guide_damping", 0.2, 0.0},
                                {"joint.load_offset", 0.0, 0.05}}};
  /// Of a pair besides: how its muscles are mounted to a millimetre of 0.3 m, angles to a degree, a link's
  /// length and inertia to what a ruler and a drawing say.
  std::array<Prior, 6> pair_priors{{{"mechanics.contraction_1", 0.0, 0.003},
                                    {"mechanics.contraction_2", 0.0, 0.003},
                                    {"mechanics.link_length", 0.01, 0.0},
                                    {"mechanics.link_inertia", 0.05, 0.0},
                                    {"mechanics.link_hangs_at", 0.0, 0.0175},
                                    {"mechanics.joint_damping", 0.2, 0.0}}};
  double unknown = 0.5;          ///< of its value: the deviation of one that is stated to be unknown,
  double unknown_usual = 3.0;    ///< or so many of those above, if that is more
  double most_deviations = 3.0;  ///< of its prior: further it is not the rig that was described
  double at_the_edge = 0.999;    ///< of what it may be: a warning
  double notable = 1.0;          ///< deviations that are worth telling
  double step = 0.02;            ///< deviations, for a slope
  double least_size = 0.01;      ///< of an effect's typical size: as good as absent, and may be stiff
  double slight_size = 0.02;     ///< of it: where a fit begins for an effect that may be there in vain
  double probe = 0.5;            ///< of it: the larger of the two sizes of which slopes are taken
  double shape_step = 0.01;      ///< logarithm of a shape, for a slope
  int law_places = 12;           ///< over the range of a number of one's own law, from which fits begin
  double shape_range = 4.0;      ///< factor: so far outside those tried a shape may go
};

}  // namespace mckibben::diagnose
