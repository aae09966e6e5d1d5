// What a diagnosis finds out: where model and data disagree, what is missing, the rig with it, and how far
// the gap has shrunk on runs that the fit has not seen.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/diagnose/search.hpp>
#include <sim/diagnose/side.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// `nothing_missing`: the gap is within noise. `recalibrate`: nominal parameters explain it.
/// `missing_effect`: effects of the catalogue do. `unknown_effect`: something real outside the catalogue.
/// `cannot_tell`: the data do not decide.
enum class Verdict { nothing_missing, recalibrate, missing_effect, unknown_effect, cannot_tell };
constexpr auto names(Verdict) {
  using enum Verdict;
  return std::array{std::pair{nothing_missing, std::string_view{"nothing_missing"}},
                    std::pair{recalibrate, std::string_view{"recalibrate"}},
                    std::pair{missing_effect, std::string_view{"missing_effect"}},
                    std::pair{unknown_effect, std::string_view{"unknown_effect"}},
                    std::pair{cannot_tell, std::string_view{"cannot_tell"}}};
}

using domain::Judged;

/// A fitted number with its 95 % interval.
struct FittedNumber {
  std::string name;  ///< key in the effect's part of a rig file, or path in the rig
  std::string unit;
  double value = 0.0, low = 0.0, high = 0.0;
  bool determined = true;  ///< false: the interval is all that is allowed, or a whole turn of an angle

  bool holds(double other) const { return low <= other && other <= high; }
};

/// As it is told: "valve_dead_band", "bladder_elasticity (linear)", "muscle_leak of muscle 2".
inline std::string full_name(const std::string& name, const std::string& variant, Side side) {
  return (variant.empty() ? name : name + " (" + variant + ")") + of_muscle(side);
}

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

inline std::vector<std::string> words_of(const std::vector<EffectName>& effects) {
  std::vector<std::string> list;
  list.reserve(effects.size());
  for (const EffectName& effect : effects) list.push_back(effect.words());
  return list;
}

/// What speaks for a name and what against it. Misfits are sums of squares over their long-term variance.
struct Support {
  double fall = 0.0;  ///< of the misfit of the fitted runs, by this effect
  /// So much more would the best of the others leave that were tried in its place and do not do as well;
  /// infinite if none was.
  double before_rivals = std::numeric_limits<double>::infinity();
  std::size_t runs = 0;                      ///< that were looked at
  std::vector<std::string> by{}, against{};  ///< those whose misfit falls, or rises, by more than chance
};

struct NamedEffect {
  std::string name, variant;
  Side side = Side::both;                     ///< of a pair: whose it is
  std::vector<EffectName> confusable_with{};  ///< effects that explain these data as well
  std::vector<FittedNumber> parameters{};
  Support support{};
  bool stands_in = false;  ///< beside general terms: no finding

  EffectName who() const { return {name, side}; }
};
inline std::string full_name(const NamedEffect& effect) {
  return full_name(effect.name, effect.variant, effect.side);
}

/// A nominal parameter after calibration.
struct Moved {
  FittedNumber fitted;
  double nominal = 0.0;
  double deviations = 0.0;   ///< as they are stated
  bool at_the_edge = false;  ///< of what it may be
  bool by_factors = false;   ///< deviations are of its logarithm, which no file states

  /// Further off than it is stated to be.
  bool exceeds() const {
    return std::abs(deviations) > thresholds.parameter.most_deviations && !of_effect() && !by_factors;
  }
  /// Worth telling: further than a data sheet promises, or the size of an effect that is another one.
  bool notable() const {
    return std::abs(deviations) > (of_effect() && !fitted.holds(nominal) ? thresholds.parameter.shown
                                                                         : thresholds.parameter.notable);
  }
  bool of_effect() const { return fitted.name.find("effects.") != std::string::npos; }
};

/// Numbers that the data do not tell, or only together.
struct LeftOpen {
  std::vector<std::string> parameters{};  ///< by path
  std::string known{};                    ///< of them: nothing, product, ratio, sum, difference, combination
  std::string words{};                    ///< "only the product of A and B is known"
};

struct LawTerm {
  std::string term;
  FittedNumber coefficient;
  std::vector<FittedNumber> shape{};  ///< wavelength and phase of a wave
};

/// One cell of the map of disagreement.
struct Cell {
  std::string factor, cell;
  std::size_t rows = 0;       ///< of all runs; 0: never visited
  double mean = 0.0;          ///< measured minus recalibrated model, of the judged reading
  double rms = 0.0;           ///< of the same
  double share_of_gap = 0.0;  ///< of the sum of squares above the floor, within its factor
  double p_value = 1.0;       ///< of the mean, by sign flips of segments
  bool significant = false;   ///< under the false-discovery rate
};

/// A cell that holds more of the gap than of the data.
struct Dense {
  Cell cell;
  double share_of_time = 0.0;  ///< of the rows of its factor

  double density() const { return cell.share_of_gap / share_of_time; }
};

/// What is left with the corrected rig.
struct Remaining {
  double floors = 0.0;           ///< rms on the runs held out, over the noise floor
  double share = 0.0;            ///< of the mean square above the floor
  std::vector<Dense> pattern{};  ///< where, densest first; empty where no more is left than noise

  bool is_more_than_noise() const { return floors > thresholds.start.explained_floors; }
};

/// One candidate as it was judged in a round. The misfit is the sum of squares over their long-term variance,
/// and the squares of the nominal parameters' deviations.
struct Ranked {
  std::string name{}, variant{};
  int round = 1;
  double score = 0.0;     ///< expected fall of the misfit (projected score test)
  double likeness = 0.0;  ///< to the round's best: cosine of what they change
  bool refitted = false;
  double training_rmse = 0.0, held_out_rmse = 0.0;  ///< after the refit
  std::string outcome{};                            ///< why it was taken or not
  double fall = 0.0;                                ///< of the misfit, by the refit
  Side side = Side::both;
  bool untried = false;  ///< though it promised something
};
inline std::string full_name(const Ranked& one) {
  return full_name(one.name, one.variant, one.side);
}

/// A nominal parameter that imitates the effect found: moved by so many prior deviations without it, by so
/// many with it.
struct Absorbed {
  std::string path;
  double without = 0.0, with = 0.0;
};

/// A way to explain the data that was fitted: the rig as described, other values of its parameters, effects,
/// a law.
struct Explanation {
  enum class Kind { nothing, numbers, effects, law };
  Kind kind = Kind::nothing;
  std::vector<std::string> effects{};  ///< with their variants
  double misfit = 0.0;                 ///< of the fitted runs, the strain of the priors in it
  double strain = 0.0;                 ///< squares of the numbers' deviations
  std::string furthest_off{};          ///< of these: "friction.scale by 2.1 times its ±"
  double held_out_rmse = 0.0;
  bool as_good = false;  ///< as the one that is chosen, or better; if none is, as the best
  bool chosen = false;
  double nats = 0.0;  ///< behind the most probable one
  double held_out_nats = 0.0,
         held_out_error = 0.0;  ///< predicts unseen runs worse by, with its standard error
  double mass = 0.0;            ///< of the posterior
};
constexpr auto names(Explanation::Kind) {
  using enum Explanation::Kind;
  return std::array{std::pair{nothing, std::string_view{"nothing"}},
                    std::pair{numbers, std::string_view{"numbers"}},
                    std::pair{effects, std::string_view{"effects"}}, std::pair{law, std::string_view{"law"}}};
}

struct RunGap {
  std::string id;
  double load_kg = 0.0;
  std::optional<double> estimated_load_kg{};  ///< where its label is a fault of the bench
  bool held_out = false, left_out = false;    ///< left out: its data or label are in doubt
  double nominal_rmse = 0.0, recalibrated_rmse = 0.0, corrected_rmse = 0.0;
  std::vector<double> measured{}, nominal{}, recalibrated{}, corrected{};  ///< judged reading, each row
};

/// What is wrong with the recording of a run.
struct FaultyRun {
  std::string run;   ///< its id
  std::string kind;  ///< late, drift, another_rig and so on
  double size = 0.0;
  std::string unit{};
  std::string action;  ///< corrected, left out
  std::string words;   ///< after the run's name: "is 3 ticks late and was shifted"
};

/// A mistake of the bench or of the recorder: no effect of the rig.
struct BenchFault {
  std::string name;  ///< load_label, loads_differ, zeros_differ, gains_differ, reading_zero, ...
  std::vector<std::string> runs{};  ///< that have it
  FittedNumber size{};             ///< a load: what to add to it, or its factor less 1; a reading: what it is
                                   ///< too high by, or its factor less 1; a clock: what it is slow by, of 1
  std::string write{};             ///< what mends it in the data set
  std::string words{};             ///< a clause: "the load of run r05 is 2.1 kg less than written"
  std::vector<double> loads_kg{};  ///< of a fault of loads: those of `runs`, as estimated

  bool of_loads() const { return name == "load_label" || name == "loads_differ"; }
  /// No key of a data set takes a drift out.
  bool can_be_written() const { return !write.empty() && name != "drifts_differ"; }
};

/// The error of a reading beside the one that is judged, on the runs held out; in its SI unit.
struct BesideGap {
  std::string reading;  ///< muscle_pressure, of a pair muscle_pressure_1 and _2; force
  std::string unit;
  double noise_floor = 0.0, nominal_rmse = 0.0, recalibrated_rmse = 0.0, corrected_rmse = 0.0;
};

struct Gap {
  double noise_floor = 0.0, nominal_rmse = 0.0, recalibrated_rmse = 0.0, corrected_rmse = 0.0;  ///< held out
  double closed = 0.0;  ///< share of the mean square above the floor that is gone
  double jitter = 0.0;  ///< of the instrument, as the readings show it; counts in the floor
  Judged judged = Judged::contraction;
  std::vector<BesideGap> beside{};

  /// Of runs with faults of their own, which no other run foretells: with these taken out, not held out.
  std::optional<double> mended_rmse{};

  /// Before anything is added: other values of parameters may predict unseen runs worse.
  bool nominal_is_nearer() const { return nominal_rmse < recalibrated_rmse; }

  /// How many noise floors the corrected rig leaves; 0 if nothing was compared.
  double floors_left() const {
    return noise_floor > 0.0 ? mended_rmse.value_or(corrected_rmse) / noise_floor : 0.0;
  }
};

/// Where runs begin, as a suspect: a rig that had not settled moves for reasons that no model of it knows.
struct Start {
  double share_of_gap = 0.0,
         share_of_time = 0.0;  ///< of what the corrected rig leaves, in the first `lasting_s`
  double lasting_s = 0.0;
  double floors_left = 0.0;  ///< root mean square of all that it leaves, in noise floors
  std::vector<std::string>
      unsettled{};  ///< runs that move from the first reading on, as no settled load does

  /// What is left sits there, or runs are seen to move.
  bool suspect() const {
    const StartThresholds& t = thresholds.start;
    return !unsettled.empty() ||
           (share_of_gap > t.share_of_gap && share_of_gap > t.over_time * share_of_time);
  }
};

struct NextExperiment {
  std::vector<std::string> separates;
  std::string current;                    ///< in words
  std::string waveform{};                 ///< kind in a scenario file; of muscle 1
  double load_kg = 0.0;                   ///< 0 where none hangs
  double expected_power = 0.0;            ///< probability to tell them apart
  domain::CampaignCurrent measurement{};  ///< the same current as a campaign or a scenario plays it
};

/// Where no current tells two explanations apart: how far a gauge on the muscle would, in a run of the data.
struct NextSensor {
  std::vector<std::string> separates;
  std::string run;
  double expected_power = 0.0;
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving a rig does not throw
struct Diagnosis {
  Verdict verdict = Verdict::cannot_tell;
  std::string because;  ///< the verdict in a sentence
  std::vector<BenchFault> bench{};
  std::vector<NamedEffect> effects{};
  std::vector<NamedEffect> stand_ins{};  ///< in the corrected rig, but no names
  std::vector<Moved> recalibrated{};     ///< as in the corrected rig
  std::vector<LeftOpen> left_open{};
  std::vector<Absorbed> absorbed{};
  std::vector<LawTerm> residual_law{};
  std::string law_valid_for{};
  std::vector<Cell> where{};
  Start start{};
  Remaining remaining{};
  std::vector<Explanation> explanations{};  ///< that competed; least misfit first
  std::vector<Ranked> ranking{};
  Gap gap{};
  std::vector<RunGap> runs{};
  std::optional<NextExperiment> next_experiment{};
  std::optional<NextSensor> next_sensor{};
  std::vector<std::string> warnings{};
  std::vector<FaultyRun> faults{};  ///< of the recording; the verdict is on what is left
  Ended ended = Ended::no;          ///< the search, before it was through
  double time_limit_s = 0.0;
  std::vector<std::string> not_done{};  ///< of it
  std::string cannot_tell{};            ///< why data cannot decide, where that is known
  std::string to_measure{};             ///< what would decide then: "at least four runs would help, ..."
  bool contradicts_sheet = false;       ///< the answer needs parameters that the sheet all but rules out
  plant::Rig described{};               ///< as the data set has it; contraction ratios go by its rest length
  plant::Rig corrected{};
  double false_alarm_rate = 0.0;  ///< that the thresholds were set for
  std::uint64_t seed = 1;
};

}  // namespace mckibben::diagnose
