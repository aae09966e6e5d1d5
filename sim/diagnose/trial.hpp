// One try of an effect: a candidate added to a model, fitted, and judged on runs held out.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/screen.hpp>
#include <sim/diagnose/telling.hpp>

namespace mckibben::diagnose {

struct Contender;

/// What stays the same throughout a diagnosis.
struct Case {
  const Experiment& experiment;
  const Rig& nominal;
  Split split;
  double inflation;
  std::function<void(const std::string&)> learned;  ///< hears what is known so far
  std::function<void(const Contender&)> fitted{};   ///< hears of every fit to its training runs
};

/// A fitted model and what it makes of the runs held out.
struct Contender {
  Fitted fitted{};
  Eigen::VectorXd held_out{};
};

struct Trial {
  Score score{};
  std::size_t place = 0;  ///< among the scores
  Contender contender{};
  Improvement gain{};
};

/// What a screening was made at, and what it found.
struct Screening {
  const Contender* base;
  std::vector<Score> scores;
  double finer = 1.0;  ///< by how much sums of squares count more once something fits
};

/// Fits a model to the training runs, whose inflation is the case's.
Contender contend(const Case& c, Model model, FitSettings settings = {});

/// The model with one candidate more, at the size that serves best along the direction of its score.
Model with(const Case& c, const Model& model, const Score& score);

/// Whether a law of a model goes where `gone` does: itself, and what adds to it.
bool goes_with(const EffectName& who, std::string_view variant, const Candidate& gone);

/// The model without one of its effects.
Model without(const Model& model, std::size_t effect);

/// The whole catalogue's scores next to a model.
Screening screen_at(const Case& c, const Contender& base);

/// One candidate more than `base`, fitted with the slopes that `base` has. Look at the fit's failure.
Trial rough(const Case& c, const Contender& base, const Score& score, std::size_t place);

/// Fits a model from here too, and keeps the end that is deeper.
void begin_too(const Case& c, Contender& end, Model start, FitSettings settings = {});

/// Fits a trial with all slopes anew.
void polish(const Case& c, Trial& trial, const Step& step);

/// A size that a fit has not driven against a bound, nor to nothing.
bool has_size(const Model& model, const Candidate& candidate);

/// Whether a nominal number stands at the edge of what is allowed of it, as far off as is believed, and
/// beyond it the misfit would clearly fall. (At nought, where nature ends it sooner, it may well be: damping
/// that is not there. Along a valley of numbers that make up for each other a fit may end there by chance.)
bool bent(const Fitted& fitted, double inflation);

/// Whether a fit may have ended beside the deepest valley: much is left with it, or a number is bent.
bool is_doubtful(const Case& c, const Contender& end);

/// A shape, if it has one, that a fit has not driven against a bound.
bool has_shape(const Model& model, const Candidate& candidate);

/// Nothing left to find, in the runs held out and in those fitted.
bool meets(const Contender& contender);

/// Whether `rival` explains these data as well as `chosen`: its misfit is near, and the runs held out make no
/// clear difference.
bool as_good(const Case& c, const Contender& chosen, const Contender& rival);

std::string title(const Candidate& candidate);

}  // namespace mckibben::diagnose
