// Every number by which measured data are looked at: its unit, what it means, where it comes from.
//
// Chosen by hand so that no effect of the catalogue and no muscle a third stronger or weaker is taken for a
// wrong unit or label; tests/run/sanity_test.cpp tries them.
#pragma once

#include <cstddef>

namespace mckibben::data {

/// How much is simulated for a look.
struct LookThresholds {
  std::size_t most_rows = 200'000;  ///< a few seconds' work: the thesis's campaign
  std::size_t most_rows_of_a_run = 20'000;
  double most_s = 600.0;  ///< of a run: slow records last for hours
};

/// Columns. Slopes are of what was measured over what the rig would do.
struct ColumnThresholds {
  double same = 1.25;           ///< factors as near as that are one
  double near_one = 2.0;        ///< factors that effects reach: no unit is told by less,
  double far = 5.0;             ///< and one by less only if
  double scaled_share = 0.04;   ///< of the sum of squares is left with the scale taken out
  double alike = 0.8;           ///< correlation with the model, if only the unit is wrong
  double moving_counts = 20.0;  ///< that a column must move to be judged
  double beyond_rig = 1.2;      ///< times what a muscle can do, or a supply has: the unit is too small
  double rounding_mA = 1e-6;    ///< above the DAC's range
  double within_supply =
      1.05;  ///< times the supply [bar], as a number: what is called current may be a pressure
  double amperes = 1.0 / 400.0;  ///< of the valve's span: currents so small are amperes
  double hardly_alike = 0.5;     ///< the same of angles, forces and pressures
  double exchanged_share =
      0.25;               ///< of the sum of squares is left where readings of two muscles change places
  double opposite = 0.2;  ///< the sign is the other one if the slope is below minus this,
  double opposite_contraction = 0.3, opposite_mean = 0.5;  ///< of a cord's mean force: a zero set under load
  double opposite_alike = 0.5;                             ///< and the correlation below minus this
  double same_turn = 2.0;                                  ///< as `same`: degrees and radians are far apart,
  double same_kilo = 2.7;                                  ///< and so are N and kN
  double gauge_bar = 0.3;                  ///< that the model's pressure must move to judge a gauge's unit
  double flow_s = 0.1, flow_share = 0.01;  ///< of a run's range: a reading moves by more in that time
  double opposite_flow = 0.5;              ///< of all motion, at least, goes the other way than valves' flow
  double least_gauge_slope = 0.5, most_gauge_slope = 2.0;  ///< of a gauge in the right unit
  double halved = 1.12, halved_share = 0.005;  ///< of a factor 2; left of the sum of squares with it
  double fitting_unit = 0.3;  ///< of a reading's range: what is left, its root, in the unit that is meant
  double beside_stated_unit = 0.1;  ///< the same, where the heading says the unit that is read
  double one_gauge = 1.1;           ///< factors as near as that are one of the gauge: a leak's differ by run
  double other_span = 1.15, one_span = 1.05;  ///< no valve's own span is off by that factor; of all runs
  double other_zero = 0.3;    ///< of the model's range: an offset of a contraction, if little else is left
  double off_at_rest = 0.04;  ///< contraction ratio: no bladder or thread gives so much without pressure
  double hardly_pulls = 0.5;  ///< of the load: a muscle twice as strong would not lift it
  double beyond_reach = 1.1;  ///< times what braid and model reach at most; ± of a sheet is less
  double atmosphere = 0.2;    ///< relative: an offset so near to it is it
  double zero_Pa = 0.2e5, zero_accuracies = 5.0;  ///< no gauge's own zero is off by more, nor by so many rms
  double same_zero = 0.25;                        ///< of that offset: all runs agree on it
  double zero_of_load_cell = 0.02;  ///< of the largest load: no load cell's own zero is off by more,
  double gain_of_load_cell = 0.05;  ///< nor by so much of each: a guide's friction is a few hundredths
  double held_steepness = 1.5;      ///< of a braid as described: units of pressure are further apart
  std::size_t least_labels = 3;     ///< one of them contradicts the others
  double speaks_for = 0.5;  ///< of what the motion is off by with one of label and cell, with the other
  double other_load = 1.5;  ///< times the lightest: a load that tells a zero from a factor
};

/// Columns that are tried in each other's place.
struct ExchangedThresholds {
  std::size_t most_runs = 4, most_stamps = 20'000, most_rows = 2'000;  ///< simulated for each pair
  double least_left = 0.02;  ///< of the squares of every reading: with less left they are as they are said
  double none_left = 1.0;    ///< with more left nothing of a run alone is as it is said,
  std::size_t most_single = 20;            ///< and so many are tried
  double most_left = 0.25, nearer = 0.25;  ///< exchanged, less is left, and such a share of that at most
};

/// Loads, weighed by the muscle.
struct LoadThresholds {
  double lifted = 0.01;         ///< contraction ratio of a load that hangs and does not rest
  std::size_t least_rows = 40;  ///< of those
  std::size_t still_rows = 20;  ///< each way: a reading at the end of its range, or frozen,
  double moving = 0.01;         ///< if the simulated load moves so far meanwhile, contraction ratio
  double compared_share =
      0.5;  ///< of the rows in which the simulated load hangs as well: then it is compared
  double least_difference = 0.08;    ///< of the heavier of two loads that are compared
  double reversed = 0.5;             ///< of that difference: so far the other way round
  double agrees = 0.35;              ///< the same with the labels exchanged
  double others_agree = 1.2;         ///< factor between the other runs, where one label alone is wrong;
  double alone = 1.35, apart = 4.0;  ///< what it is off by, if in order: a factor, and so many of theirs
  std::size_t least_others = 3;      ///< runs: a line through them shows what one label more contradicts,
  double contradicts = 1.12, contradicts_kg = 0.15;  ///< by a factor, by a share of the middle load,
  double apart_of_line = 3.0;                        ///< and by so many of what is left of the line
  double visible = 0.2;        ///< of a usual load: effects without a load look like less
  double near_grams = 2.0;     ///< factors, round kg written in g, N and pounds; a muscle of half or twice
  double near_newtons = 1.25;  ///< the force comes near to pounds, none to the others
  double near_pounds = 1.2, sure_pounds = 1.08, near_kg_as_pounds = 1.2;
  double agree_on_pounds = 1.3;  ///< where half of what hung is simulated, friction weighs unevenly
  double sure_tenth = 1.4;       ///< a tenth is surely one within this factor
};

/// Single readings, and runs by themselves. Counts are the encoder's.
struct ReadingThresholds {
  std::size_t least_runs = 3;        ///< to choose on some and judge on others
  double gauge_step_Pa = 2e3;        ///< what gauges cannot resolve: for them a count
  double sharp_reach_s = 0.3;        ///< a hidden effect moves the model's sharpest bend by no more
  std::size_t spike_ticks = 5;       ///< an outlier's width at most
  double not_read_share = 0.02;      ///< of a run, and so narrow: what cannot be was not read
  double spike_counts = 5.0;         ///< it jumps by more than this beside what the model's bends explain
  double spike_balance = 0.5;        ///< of the smaller jump: what the way back may differ by
  double end_counts = 2.0;           ///< a tick: at the ends of a run a faster load is no proof
  double beside_counts = 3.0;        ///< what an outlier's neighbours may be off its line by,
  double beside_bends = 2.0;         ///< and so many of the model's bends
  double lost_counts = 20.0;         ///< a jump that stays: more than this,
  double lost_steps = 8.0;           ///< and so many median steps,
  double lost_bends = 4.0;           ///< and so many of the model's bends
  double gap_rows = 2.5;             ///< between two stamps: rows were not read,
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
  double stuck_counts = 200.0;       ///< if neither,
  double stuck_share = 0.9;          ///< or such a part of the model's range: a small muscle has few counts
  double dead_current = 1e-3;        ///< of the valve's range above its zero: nothing moves
  double moving_counts = 1.5;        ///< of a run that moves at all
  double should_move_counts = 20.0;  ///< of the model: the load should have moved
  double gauge_bar = 0.3;            ///< the model's pressure moves so far: a gauge must follow
  double gauge_slope = 0.1;          ///< of the gauge over the model, at least
  double most_masked = 0.3;          ///< of a run: more, and too little of it is left
  double same_load = 0.01;           ///< relative: one load
};

/// Clocks of recorders.
struct ClockThresholds {
  double shortest_run_s = 0.02, shortest_step_s = 1e-3;  ///< no muscle does anything in so short a time
  double longest_run_s = 600.0, longest_step_s = 0.5;    ///< slower records are of leaks, not of motion
  double gap_steps = 10.0, gap_s = 0.1;                  ///< a gap is longer than so many steps, and so long
  double most_gaps = 0.02;                               ///< of all rows: more are how it was recorded
  double short_run_s = 0.2, short_step_s = 1e-4;         ///< hardly anybody records so little so quickly
  double near_unit = 4.0;  ///< of 1e3 or 1e6: rows of two runs are apart by a unit
};

/// Rows that are missing though the stamps go on.
struct LostRowThresholds {
  double slowest_row_s = 0.025;  ///< in slower rows a quick valve gets anywhere, and a small muscle with it
  double gap_rows = 2.5;         ///< the stamps tell it themselves
  std::size_t beside = 4;        ///< rows before and after,
  double stands_out = 3.0;       ///< times what they range over: a jump
  double grains = 3.0, noises = 6.0;  ///< steps that it is rounded to; of its scatter
  std::size_t most = 3;               ///< in a run: more are how it was recorded
};

/// What is asked about before anything is simulated.
struct PlausibleThresholds {
  std::size_t least_rows = 10;
  double beyond_supply = 1.5, high_Pa = 1e6;  ///< that a given pressure reaches at most
  double beyond_span = 0.01;                  ///< of a valve's range of commands: an offset of the DAC
  double an_end = 0.02;                       ///< of that range: a command so near to an end is there,
  std::size_t most_states = 8;  ///< of valves that are open or shut: commands of more values elsewhere,
  double between_share = 0.2;   ///< in such a share of the rows, are duties
  double lifts_nothing_Pa = 0.15e5, moves_far = 0.02;
  double least_atmosphere_Pa = 0.95e5, most_atmosphere_Pa = 1.06e5;
  double taut_share = 0.02;   ///< of a held muscle's largest force: what its taut threads pull beside it
  double nearer = 1.0 / 3.0;  ///< of the error is left if a given pressure is taken as absolute
  double rests = 3e-3, resting_share = 0.05;    ///< relative; of the rows
  double lowest_share = 0.01;                   ///< of the rows: a run's lowest pressure but for noise
  double stays = 0.2;                           ///< of the readings that are on a grid
  double coarser = 2.0, coarsest = 0.05;        ///< steps of a reading: times the sensor's; contraction ratio
  double coarser_command = 1.5;                 ///< steps of a command: times the DAC's,
  std::size_t least_levels = 20;                ///< of which it has so many values,
  double least_stays = 0.1, most_stays = 0.98;  ///< of its rows repeat the one before,
  double single_steps = 0.5;                    ///< and at least such a share of its changes is of one
};

/// Of runs that are to begin at rest.
struct StartThresholds {
  double look_s = 0.1;         ///< at the beginning,
  std::size_t least_rows = 6;  ///< or so many rows
  double moving_counts = 5.0;  ///< that it moves there, at least,
  double at_once = 0.5;        ///< of the speed in the first half already: what begins at rest comes later
  double rig_moves = 0.5;      ///< of the speed, at most, has the rig as described, which begins at rest
};

struct Thresholds {
  ClockThresholds clock{};
  PlausibleThresholds plausible{};
  LostRowThresholds lost_rows{};
  StartThresholds start{};
  LookThresholds look{};
  ColumnThresholds column{};
  ExchangedThresholds exchanged{};
  LoadThresholds load{};
  ReadingThresholds reading{};
};

inline constexpr Thresholds thresholds{};

}  // namespace mckibben::data
