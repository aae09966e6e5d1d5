// Six planted runs of a rig that is not as it is written, fitted within three deviations.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/trial.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {

struct Strained {
  domain::Dataset data;
  std::vector<std::vector<bool>> masked;
  std::optional<Experiment> experiment;
  std::optional<Case> at;
  Contender described, recalibrated;

  explicit Strained(const plant::Rig& truth) : data(small(truth, 2.4)) {
    masked = nothing_masked(data);
    experiment.emplace(data, masked, 2);
    at.emplace(Case{*experiment, data.rig, split(data, {0, 1, 2, 3, 4, 5}),
                    thresholds.scatter.first_inflation, [](const auto&) {}});
    described = replay(*at);
    recalibrated = diagnose::recalibrate(*at, described).contender;
  }
  std::vector<const Fitted*> bases() const { return {&recalibrated.fitted, &described.fitted}; }
  /// With what is said to be missing.
  Contender named(const std::string& effect) const {
    Contender best;
    const Screening screening = screen_at(*at, recalibrated);
    for (std::size_t place = 0; place < screening.scores.size(); ++place) {
      const Score& score = screening.scores[place];
      if (score.candidate.effect != effect || score.drop < thresholds.near.chance) continue;
      Trial trial = rough(*at, recalibrated, score, place);
      if (trial.contender.fitted.failure.empty()) best = std::move(trial.contender);
    }
    return best;
  }
};

}  // namespace mckibben::diagnose
