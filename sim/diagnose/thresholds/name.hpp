// Thresholds of stage 4, name: which effects are tried, which are taken, and when other numbers come first.
#pragma once

#include <array>
#include <cstddef>

namespace mckibben::diagnose {

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
  std::size_t most_refits = 7;     ///< in a round, unless all are tried
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
  double worth_a_pair = 4.0;         ///< left, that is much: every effect is tried, then two at once
  std::size_t most_firsts = 3;       ///< as the first of a pair
  std::size_t most_substitutes = 3;  ///< as the second, or instead of one that was named
  double pair_share = 0.6;           ///< of the gap, that they must close,
  double rough_pair_share = 0.3;     ///< and in a rough fit
  double least_of_all = 0.01;        ///< of the whole gap: an effect that closes less mends another's law
  double closes_rest = 0.9;          ///< of what is left: then it mends nothing,
  double worth_closing = 1.0;        ///< if so much is left
  double least_whole_gap = 1.0;  ///< left: shares of the whole gap are of no less, where one is tried without
  std::size_t few_runs = 6;      ///< that speak for a name: they are told one by one
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

}  // namespace mckibben::diagnose
