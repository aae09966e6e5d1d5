// Numbers that say how a diagnosis is told: its unit, what it means, where it comes from. What decides is in
// sim/identify/decisive.hpp. No other file of this room has one.
//
// Where no origin is told, a number was chosen by hand. Mean squares of residuals are over the noise floor's.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace mckibben::diagnose {

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
  enum class Of { any, load, hanging_load } of = Of::any;  ///< joints that have it
  bool logarithmic = false;                                ///< `relative` is of its logarithm
};
struct ParameterThresholds {
  /// Machined lengths are known to a per cent, catalogue conductances, friction and springs to ten, trimmed
  /// pressures [Pa] to a reading of the gauge, the load [kg] to a scale's. A regulator's lag, measured with
  /// another volume behind it, to a third. No sheet tells how far threads give before they slide.
  std::array<Prior, 17> priors{{{"muscle.rest_radius", 0.01, 0.0},
                                {"muscle.end_correction", 0.01, 0.0},
                                {"muscle.braid_angle", 0.01, 0.0},
                                {"muscle.dead_volume", 0.3, 0.0},
                                {"friction.scale", 0.1, 0.0},
                                {"friction.bristle_stiffness", 1.0, 0.0, Prior::Of::any, true},
                                {"valve.conductance", 0.1, 0.0},
                                {"valve.zero_pressure", 0.0, 1e3},
                                {"valve.span_pressure", 0.0, 2e3},
                                {"valve.time_constant", 0.3, 0.0},
                                {"valve.natural_frequency", 0.3, 0.0},
                                {"valve.damping", 0.3, 0.0},
                                {"hose.conductance", 0.1, 0.0},
                                {"joint.guide_damping", 0.2, 0.0, Prior::Of::hanging_load},
                                {"joint.load_offset", 0.0, 0.05, Prior::Of::load},
                                {"joint.spring", 0.1, 0.0, Prior::Of::hanging_load},
                                {"joint.spring_preload", 0.1, 0.0, Prior::Of::hanging_load}}};
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
  double notable = 1.0;          ///< deviations that are worth telling
  double shown = 0.05;           ///< of an effect that is known: fewer are written as 0.0
  double least_size = 0.01;      ///< of an effect's typical size: as good as absent, and may be stiff
  double sealed_leak = 0.01;     ///< of a sealed muscle's gas: what a typical leak takes in a run
  int law_places = 12;           ///< over the range of a number of one's own law, from which fits begin
  double shape_range = 4.0;      ///< factor: so far outside those tried a shape may go
};

/// What nobody can see.
struct NoiseThresholds {
  double least_ratio = 5e-5;    ///< contraction ratio: no sensor of a lab does better, no simulation needs to
  double sheet_noise = 2.0;     ///< times its data sheet's: a sensor that scatters more is said to
  double least_force_N = 0.02;  ///< no load cell of a bench does better
  double least_pressure_Pa = 50.0;  ///< no gauge does better
  double first_decimal = 1e-3;      ///< the coarsest that readings are rounded to,
  double last_decimal = 1e-7;       ///< and the finest that is told from none
  double decimal_error = 1e-6;      ///< of a decimal: rounding of the arithmetic
  double whole_count = 0.01;        ///< counts: nearer is whole
  double telling_count = 0.2;       ///< counts: decimals so coarse make everything whole
  double counted_share = 0.99;      ///< of the readings must be whole
  double normal_median = 0.6745;    ///< median of the size of a normal variable, in deviations. Derived
  std::size_t steady_ticks = 6;     ///< each way, in which the load's speed is taken as steady
  double straight_counts = 2.0;     ///< what the load may bend by in these
  double fastest = 1.0;             ///< counts a tick: faster, the speed matters more than the jitter
  double largest = 6.0;             ///< counts of a difference: more is a jump
  std::size_t speed_bins = 25;      ///< up to the fastest
  int waves = 40;                   ///< of the series for what counts do: beyond it nothing is left
  double most_jitter = 2.0;         ///< counts
  double jitter_error = 1e-4;       ///< counts: exact enough
};

/// What the data leave open. Information is in units of a prior's: of 1 they say as much as was known.
struct LeftOpenThresholds {
  double says_nothing = 0.25;  ///< less: what was known is narrowed by a tenth at most
  std::size_t few = 3;         ///< numbers that are looked at together before all are
  double takes_part = 0.1;     ///< of the largest part: a number of less has none in a direction
  double equal = 0.1;          ///< relative: weights are the same
};

struct WhereThresholds {
  int flips = 999;                  ///< of signs, for a p-value. Convention: a p-value of 1/1000 can be seen
  double same_sum = 1e-12;          ///< relative: as large
  double false_discoveries = 0.05;  ///< share of those called significant. Convention
  double rest_mm_per_s = 0.5;       ///< slower is standing
  std::array<double, 3> speeds_mm_per_s{5.0, 25.0, 100.0};    ///< between cells
  double rest_deg_per_s = 1.0;                                ///< slower a joint stands
  std::array<double, 3> speeds_deg_per_s{10.0, 50.0, 200.0};  ///< of a joint, between cells
  int pressures = 5, contractions = 6, times = 4;             ///< cells of equal width
  std::array<double, 2> start_s{1.0, 4.0};                    ///< between cells
  std::array<double, 3> since_reversal_s{0.1, 0.5, 2.0};      ///< between cells
  double dense_share = 0.25;  ///< of the gap, that a cell must hold where a gap is said to lie,
  double density = 1.5;       ///< and so many times its share of the time
};

/// What is told of the start of runs, and of the end of the search.
struct StartThresholds {
  /// Memories of effects in runs that began on their way, in their working sizes, from where they would rest.
  double memory = 0.5;            ///< so far off they may be
  double memory_step = 0.01;      ///< for a slope
  double memory_near = 0.01;      ///< a straight line from so near is good enough,
  int flights = 3;                ///< or after so many
  double explained_floors = 2.0;  ///< rms: more is something to explain
  double longest_s = 4.0;         ///< of a start,
  double share_of_run = 0.25;     ///< and of the longest run
  std::size_t first_rows = 6;     ///< too few for a current that changes after the first to have moved much
  double counts = 4.0;            ///< moved in these rows beyond the model: the run had not settled,
  double jitters = 6.0;           ///< and so many of the encoder's,
  double beyond_model = 3.0;      ///< and so many times what the model moves
  double share_of_gap = 0.5;      ///< of what is left lies in the start: suspect,
  double over_time = 2.0;         ///< if that is so many times its share of the time
};

/// The next measurement. Its menu of currents is in plan.cpp.
struct PlanThresholds {
  double lasting_s = 10.0;   ///< of a current
  double least_power = 0.1;  ///< probability to tell, that is worth proposing
  std::size_t refitted = 8;  ///< items that promise most, for which the other explanation is fitted again
  std::array<double, 3> loads{1.0, 0.5, 1.3};  ///< of the data set's
  double same_load = 0.08;                     ///< relative: one load
  double same_current = 0.05;                  ///< rms, of the span: a run that has it is of this current,
  double begins_s = 2.0;                       ///< from so late in the run at most
  double gauge_Pa = 1e3;                       ///< noise of a gauge that may be added,
  double gauge_zero_Pa = 2e3;                  ///< and the deviations of its zero
  double gauge_gain = 0.02;                    ///< and gain
  std::array<double, 2> of_a_pair{0.2, 0.8};   ///< of a valve's range: neither muscle of a pair hangs through
  double least_rise = 0.05;  ///< contraction ratio at the highest pressure: a heavier load is not proposed
};

/// What is told, and in which words.
struct TellThresholds {
  double normal = 1.96;    ///< deviations of a normal variable: 95 %. Convention
  double segment_s = 1.5;  ///< longer than residuals remember: signs that are flipped
  double chance = 6.0;     ///< fall of the misfit that is chance below: log 20 nats (Kass & Raftery 1995)
  double invisible = 0.5;  ///< of the catalogue: if more of it would not show, nothing can be told
  double closed = 0.9;     ///< of the gap, by what leaves more than noise: enough for an answer. Convention
  double at_floor = 1.1;   ///< noise floors: no more than noise
  double not_credible = 10.0;      ///< deviations: no sheet is so wrong
  double false_alarm_rate = 0.03;  ///< aimed at; docs/diagnosis.md has what was measured
  double told_phase = 0.005;       ///< rad: less is not told
  std::size_t few_runs = 6;        ///< are told by name
  std::size_t most_terms = 4;      ///< of a law, in a sentence: the largest
  std::size_t short_line = 60;     ///< letters
};

struct Thresholds {
  PredictThresholds predict{};
  ParameterThresholds parameter{};
  NoiseThresholds noise{};
  LeftOpenThresholds left_open{};
  WhereThresholds where{};
  StartThresholds start{};
  PlanThresholds plan{};
  TellThresholds tell{};
};

inline constexpr Thresholds thresholds{};

}  // namespace mckibben::diagnose
