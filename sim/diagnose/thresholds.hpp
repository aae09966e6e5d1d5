// Every number that a diagnosis goes by, in running order: its unit, what it means, where it comes from. No
// other file of this room has one.
//
// Where no origin is told, a number was chosen by hand; docs/testing.md has the seeds of the benchmark on
// which the workflow as a whole was looked at, and those by which it is judged. Mean squares of residuals are
// over the noise floor's; "left" is what they are above it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace mckibben::diagnose {

// ---- What all stages share

struct NearThresholds {
  double floors = 4.0;         ///< rms: residuals within it are noise, slow disturbances included
  double nothing_left = 0.04;  ///< left: there is nothing to find. Twice as much on runs that were fitted
  double chance = 6.0;         ///< fall of the misfit, expected or come true, that is chance below
  double clear = 12.0;         ///< difference of misfits that scatter does not make

  constexpr double mean_square() const { return floors * floors; }
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

// ---- 1. Check

/// Single readings, and runs by themselves. Counts are the encoder's.
struct CheckThresholds {
  std::size_t least_runs = 3;        ///< to choose on some and judge on others
  double gauge_step_Pa = 2e3;        ///< what gauges cannot resolve: for them a count
  double sharp_reach_s = 0.3;        ///< a hidden effect moves the model's sharpest bend by no more
  std::size_t spike_ticks = 5;       ///< an outlier's width at most
  double spike_counts = 5.0;         ///< it jumps by more than this beside what the model's bends explain
  double spike_balance = 0.5;        ///< of the smaller jump: what the way back may differ by
  double end_counts = 2.0;           ///< a tick: at the ends of a run a faster load is no proof
  double beside_counts = 3.0;        ///< what an outlier's neighbours may be off its line by,
  double beside_bends = 2.0;         ///< and so many of the model's bends
  double lost_counts = 20.0;         ///< a jump that stays: more than this,
  double lost_steps = 8.0;           ///< and so many median steps,
  double lost_bends = 4.0;           ///< and so many of the model's bends
  double lost_change = 0.25;         ///< of the jump: what the speed may change by at most
  double still_s = 0.5;              ///< a reading stands still from here on
  double at_zero_counts = 3.0;       ///< below it the load rests on the braid's stop
  double off_zero_counts = 60.0;     ///< in a tick: no load leaves the stop so quickly
  std::size_t cut_off_ticks = 5;     ///< before and after readings that are cut off
  double cut_off_speed = 1.0;        ///< counts a tick, in these: the load is on its way
  double stops_dead_counts = 10.0;   ///< in a tick: no friction stops it so
  double catches_up_counts = 6.0;    ///< in a tick, after standing still
  double saturated_counts = 80.0;    ///< the model's way meanwhile, if cut off,
  double frozen_counts = 100.0;      ///< if it stopped dead or caught up,
  double stuck_counts = 200.0;       ///< if neither
  double dead_current = 1e-3;        ///< of the valve's range above its zero: nothing moves
  double moving_counts = 1.5;        ///< of a run that moves at all
  double should_move_counts = 20.0;  ///< of the model: the load should have moved
  double gauge_bar = 0.3;            ///< the model's pressure moves so far: a gauge must follow
  double gauge_slope = 0.1;          ///< of the gauge over the model, at least
  double like_kilo = 1.0;            ///< logarithm, round a thousandth of the model's forces: they are in kN
  double like_turn = 0.5;            ///< correlation of a joint's angle with the model's: it turns alike,
  double turns_at_all = 0.2;         ///< and so far, over the model's
  double like_degrees = 0.7;         ///< logarithm, round 180/pi: degrees for radians, or the other way
  double opposite_force = 0.5;       ///< of the model's mean force, below 0: a force of the other sign
  double like_kilogram = 0.2;        ///< logarithm, round 1/g of the model's forces: they are in kg
  double most_masked = 0.3;          ///< of a run: more, and too little of it is left
  double most_contradicted =
      1.0 / 3.0;            ///< of the runs, whose labels contradict the others: more cannot tell
  double same_load = 0.01;  ///< relative: one load
};

/// Labels of loads. Set on 64 data sets: each effect of the catalogue at twice its typical size, each
/// parameter at three prior deviations, nine runs, five loads; no label was doubted wrongly, of 2304
/// exchanged ones 6 missed.
struct LabelThresholds {
  std::size_t least_runs = 4;  ///< whose labels can contradict each other
  std::size_t least_left = 3;  ///< that must be left to judge a further one
  double spreads = 4.0;        ///< median absolute deviations of the other runs' offsets
  double sure_kg = 0.3;        ///< an offset that a parameter in error makes: this,
  double sure_share = 0.04;    ///< and of the load
  double trend = 0.1;  ///< of a load's distance to the others: parameters in error scatter offsets as much
  double still_there = 0.5;    ///< of the sum of squares, that may be left with the load that fits
  double others_suffer = 1.4;  ///< growth of theirs with the same offset, at least
  double exact_kg = 0.03;      ///< smaller steps do not matter
  double step_kg = 0.01;       ///< for a slope
  double least_kg = 0.1;       ///< of a load that is tried
  double least_step = -0.5;    ///< of the load, down,
  double most_step = 1.0;      ///< and up, in one step
  int steps = 6;               ///< of the descent, at most
  double pounds = 0.06;        ///< relative, round a pound: all loads are written in pounds
};

/// Runs at fault.
struct FaultThresholds {
  double unquestioned = 4.0;     ///< mean square of a run that raises no question
  double strictly_better = 0.3;  ///< of the misfit that the rig, or an effect, leaves: what faults may leave
  double explained = 0.03;       ///< of a run's misfit: a shape explains it if no more is left
  double another_rig =
      64.0;  ///< mean square of a run that no shape explains; less a law leaves that is not right
  double for_choice = 0.9;        ///< of its gain counts where a shape chooses the row where it begins
  std::size_t least_sound = 3;    ///< runs that must be sound,
  std::size_t sound_for_one = 2;  ///< and so many for each that is not
  std::size_t most_tried = 6;     ///< the worst runs that are tried as the odd one
  double least_ticks = 0.6;       ///< sizes below are nothing to talk of: late, rows lost
  double least_scale = 0.004;     ///< of a current or of readings
  double least_mA = 0.03;         ///< of a current's offset
  double least_bar = 0.01;        ///< of a given pressure's
  double least_drift = 5e-4;      ///< contraction ratio
  double least_counts = 0.6;      ///< of a zero, of slipped counts
  double whole_tick = 0.5;        ///< ticks: a line drawn at a lateness holds so near to it, if all are late
  double drawn_ticks = 0.25;      ///< the same of one run: this,
  double drawn_share = 0.3;       ///< and of the size that it was drawn at
  std::array<int, 6> common_ticks{-1, -2, -3,
                                  -4, -5, -6};  ///< that all runs may be late by: early. Late is an effect
  int most_ticks = 12;                          ///< that one run may be late by, or early
  std::array<int, 6> lost_ticks{2, 5, 10, -2, -5, -10};  ///< rows that may be lost, or double
  long beginnings = 60;            ///< rows at which something may have begun, evenly spread
  double current_share = 0.02;     ///< of the current, for a slope
  double current_mA = 0.1;         ///< for a slope
  double pressure_bar = 0.03;      ///< for a slope
  double worth_suspecting = 0.75;  ///< of what any effect leaves of a run: one beside a fault must leave less
  std::size_t most_suspected = 3;  ///< effects beside faults of a few runs, and beside one of all
  int most_repairs = 2;            ///< how often data are mended and looked at again
  double rounding = 1e-10;         ///< of a column's square: others imitate it but for rounding
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

// ---- 2. Baseline

struct HeldOutThresholds {
  std::size_t least_loads = 3;  ///< to hold one out from inside their range
  double enough = 1.0 / 3.0;    ///< of the runs are held out,
  double most = 0.4;            ///< no more than these by a further load,
  double most_of_all = 0.5;     ///< and no more than these at all
  double last = 1.0 / 3.0;      ///< of the runs, where loads do not do
};

/// Which of many runs a search asks: what it chooses is fitted to all.
struct AskedThresholds {
  std::size_t least_runs = 9;
  double enough_s = 288.0;  ///< as many runs as make up this. As in 24 of 12 s
  double confirmed = 1.5;   ///< of what is left of runs that were asked [mean square]: the others, at most
};

/// Least squares.
struct FitThresholds {
  int rounds = 5, thorough_rounds = 20;  ///< of descents, each along slopes of its own
  int iterations = 8;                    ///< in a round
  double least_descent = 0.01;  ///< of the cost, where 1 is a parameter moved by its deviation: else the last
  double coarseness = 0.01;     ///< of the cost: that is enough too, what is missing moves parameters further
  double hopeless =
      0.85;  ///< of what is missing to an aim: fits whose straight lines miss more are not begun
  double least_influence = 1e-12;  ///< sum of squares of a slope [floors per scale], that is rounding below
  double cost_tolerance = 1e-4, thorough_cost_tolerance = 1e-7;            ///< relative: a round has arrived
  double parameter_tolerance = 1e-5, thorough_parameter_tolerance = 1e-7;  ///< relative
};

/// Where a fit begins, besides the rig as described.
struct StartsThresholds {
  double wide = 0.4;        ///< relative deviation of a number from which its range is looked over
  double reach = 2.0;       ///< deviations, each way
  std::size_t places = 14;  ///< that are looked at: two flocks beside the rig itself,
  std::size_t runs = 3;     ///< in so many runs,
  std::size_t begun = 2;    ///< and so many begun from
  double far = 4.0;         ///< deviations, of one number that may be far off
  double same_cost = 0.1;   ///< of the cost: ends that differ by no more agree
};

/// Intervals.
struct IntervalThresholds {
  double normal = 1.96;  ///< deviations of a normal variable: 95 %. Convention
  int draws = 100;       ///< of what counting does
  double still = 1e-12;  ///< counts^2: what is moved less is at rest
  /// Of the rise of the cost up to quadratic ends: where it differs by more, in the mean of both or in half
  /// their difference, the profile is looked along,
  double trusted = 0.3;
  double tolerance = 0.1;  ///< until it has risen as much but for this: the end is right to 5 %,
  int rounds = 10;         ///< or so often, each
  double stride = 2.0;     ///< times as far at most
};

/// What the data leave open. Information is in units of a prior's: of 1 they say as much as was known.
struct LeftOpenThresholds {
  double says_nothing = 0.25;  ///< less: what was known is narrowed by a tenth at most
  std::size_t few = 3;         ///< numbers that are looked at together before all are
  double takes_part = 0.1;     ///< of the largest part: a number of less has none in a direction
  double equal = 0.1;          ///< relative: weights are the same
};

// ---- 3. Where

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

// ---- 4. Name

/// Score tests.
struct ScreenThresholds {
  double at_bound = 1e-6;  ///< of a parameter's range: it stands at its bound and is not free
  double ridge = 1e-9;     ///< of a prior: keeps what is singular solvable
  double visible =
      10.5;  ///< expected fall that a test at 5 % finds with a power of 90 %: noncentral chi-square. Derived
  double least_norm = 1e-300;  ///< no division by nothing
};

/// Whether one model is better than another on runs held out. Set on seeds that the benchmark does not score.
struct ImprovementThresholds {
  double share = 0.10;        ///< of the gap, at least
  double gained = 0.03;       ///< mean square, at least
  double significance = 2.0;  ///< standard errors, at least
  double clear_share = 0.5;   ///< of the gap, that is certain whatever its standard error
  double better = 0.5;        ///< share of runs that must gain, more than
  double least_gap = 0.05;    ///< left: shares are of no less
};

/// Which effects are tried, and taken.
struct NameThresholds {
  std::size_t most_effects = 3;    ///< rounds
  std::size_t most_refits = 7;     ///< in a round
  std::size_t most_polished = 3;   ///< of these, fitted with all slopes anew
  double likeness_refitted = 0.7;  ///< cosine: so alike is refitted whatever its score
  double likeness_solved = 0.35;   ///< the same, to one that meets the data: only those are
  double least_score = 0.05;       ///< of the best score: less is not worth a refit
  double close_factor = 3.0;       ///< of the best cost: a rough fit further behind is not polished,
  double close_cost = 50.0;        ///< but for this
  double helps = 0.02;             ///< of the gap: a rough fit that closes less is not polished
  double strained = 15.0;     ///< expected fall of the misfit where the data are met: priors are strained
  double relief_loss = 0.01;  ///< mean square on runs held out, that relief may cost
  std::array<double, 5> first_sizes{0.1, 0.3, 0.6, 1.0,
                                    1.6};  ///< of the size that the score expects: tried first
  double at_bound = 1e-3;            ///< of a size's range, or a shape's: a fit has driven it to its bound
  double to_nothing = 1.1;           ///< of the size that is as good as absent: it has driven it to nothing
  double as_good_gained = 0.05;      ///< mean square that a twin may be worse by on runs held out,
  double as_good_cost = 0.1;         ///< and of the cost
  double worth_a_pair = 4.0;         ///< left: two effects at once are looked for
  std::size_t most_firsts = 3;       ///< as the first of a pair
  std::size_t most_substitutes = 3;  ///< as the second, or instead of one that was named
  double pair_share = 0.6;           ///< of the gap, that they must close,
  double rough_pair_share = 0.3;     ///< and in a rough fit
  double least_of_all = 0.01;        ///< of the whole gap: an effect that closes less mends another's law
  double least_whole_gap = 1.0;  ///< left: shares of the whole gap are of no less, where one is tried without
  std::size_t shown_alike = 8;   ///< candidates of which the likeness is told
};

/// Numbers that depart further than they are stated to, before a name is given.
struct FurtherThresholds {
  double wider = 5.0 / 3.0;  ///< priors and bounds: five deviations in place of three
  double same_bound = 1e-6;  ///< of the most: a bound stands where the deviation puts it
};

/// Several effects at once.
struct SubsetThresholds {
  std::size_t most_effects = 4;  ///< in a set
  std::size_t kept = 3;          ///< sets that are fitted, of each screening
  double apart = 1e-3;           ///< of a member's square: what the others do not imitate of it
  double needed = 0.02;          ///< of what a set explains: a member that adds less is not needed
  double worth_it = 0.3;         ///< left with names: sets are tried
  double share = 0.6;            ///< of what was left, that a set must close
};

/// Of explanations that do less well than the one chosen, so many of each kind are told: nothing, numbers,
/// further numbers, effects, a law.
struct CompetitionThresholds {
  std::array<std::size_t, 5> shown{1, 1, 1, 4, 1};
};

/// Whether an effect has one size everywhere. Set on seed 21 of the benchmark: right names differ by 0.02 of
/// their size, those that stand in for an effect taken out of the catalogue by 0.1 to 0.9.
struct ConstancyThresholds {
  double same_motion = 1.25;  ///< ratio of the rates of pressure: currents of one kind
  double known = 0.25;        ///< of the size: a part of the data with a smaller error knows it
  double deviations = 4.0;    ///< two sizes so far apart differ for certain,
  double share = 0.3;         ///< and if by so much of the size, the effect is not constant
};

// ---- 5. Law

struct LawThresholds {
  std::size_t most_terms = 3;
  std::size_t most_fits = 4;  ///< proposals that are fitted, of each base
  double same_wave = 0.15;    ///< logarithm: waves of lengths so near are one proposal
  double no_slope = 1e-12;    ///< sum of squares that is rounding below
  /// Forces for slopes: next to nothing, and of a size that matters, because a muscle that swings answers a
  /// small change in another way than a large one.
  std::array<double, 5> probes_N{0.01, 5.0, -5.0, 40.0, -40.0};
  std::array<double, 2> wave_probes_N{0.01, 3.0};
  double first_periods = 1.0, last_periods = 20.0, step_periods = 0.5;  ///< of a wave over the largest rise
  double most_N = 1e3;                                                  ///< of a coefficient
  double step_N = 0.01;                                                 ///< for a slope
  double shorter = 0.7, longer = 1.4;  ///< than proposed, that a wave may become
  double wave_step = 1e-3;             ///< logarithm of its length, and its phase [rad], for a slope
  double most_phase = 7.0;             ///< rad: more than a turn, so that no bound is in the way
  double told_phase = 0.005;           ///< rad: less is not told
};

// ---- 6. Decide

/// The verdict. What is left is on the runs held out.
struct DecideThresholds {
  double worth_a_law = 0.15;         ///< left, that is worth a search for a law, and for each further term
  double worth_a_law_share = 0.05;   ///< of what the described rig leaves, that is worth it too
  double law_share = 0.3;            ///< of the gap, that a law must close, more than
  double law_beyond_names = 0.4;     ///< of what the names leave, that a law may leave, less than
  double named_share = 0.4;          ///< of a gap worth a law, that effects must close to be named
  double nearly_all = 0.9;           ///< of the gap: they are named whatever is left
  double hopeless = 600.0;           ///< left, as no fit of the right effect leaves that stopped early
  double beyond_disturbance = 60.0;  ///< left, as no slow disturbance leaves
  double invisible = 0.5;            ///< of the catalogue: if more of it would not show, nothing can be told
  double contradicted = 1.0;         ///< of the motion left, that makes the gauge a suspect
  double without_gauge = 0.25;       ///< of that, that may be left where the gauge is ignored
  double false_alarm_rate = 0.03;    ///< aimed at; docs/diagnosis.md has what was measured
};

// ---- 7. Plan

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
  double least_rise = 0.05;  ///< contraction ratio at the highest pressure: a heavier load is not proposed
};

struct Thresholds {
  NearThresholds near{};
  ScatterThresholds scatter{};
  PredictThresholds predict{};
  ParameterThresholds parameter{};
  CheckThresholds check{};
  LabelThresholds label{};
  FaultThresholds fault{};
  NoiseThresholds noise{};
  HeldOutThresholds held_out{};
  AskedThresholds asked{};
  FitThresholds fit{};
  StartsThresholds starts{};
  IntervalThresholds interval{};
  LeftOpenThresholds left_open{};
  WhereThresholds where{};
  ScreenThresholds screen{};
  ImprovementThresholds improvement{};
  NameThresholds name{};
  FurtherThresholds further{};
  SubsetThresholds subset{};
  CompetitionThresholds competition{};
  ConstancyThresholds constancy{};
  LawThresholds law{};
  DecideThresholds decide{};
  StartThresholds start{};
  PlanThresholds plan{};
};

inline constexpr Thresholds thresholds{};

}  // namespace mckibben::diagnose
