// What is given up of the names that were taken.
#include <algorithm>

#include <gtest/gtest.h>

#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/revise.hpp>

#include "strained.hpp"

namespace mckibben::diagnose {
namespace {

/// One law of the tube more than `base` has, fitted in full.
Contender with_law(const Case& c, const Contender& base, std::string_view variant) {
  const Screening screening = screen_at(c, base);
  const auto score = std::ranges::find_if(screening.scores, [&](const Score& one) {
    return one.candidate.effect == "bladder_elasticity" && one.candidate.variant == variant;
  });
  if (score == screening.scores.end()) throw std::logic_error("no such law is offered");
  Trial trial = rough(c, base, *score, 0);
  polish(c, trial, [](const Doing&) {});
  return trial.contender;
}

// A linear tube, taken for one that saturates before it was seen that a linear term is missing.
TEST(Revise, LeavesTheTermThatMattersOfALawOfTwo) {
  plant::Rig truth;
  truth.effects.get<plant::BladderElasticity>().stiffness_N_per_m = 290.0;
  const Strained runs(truth);
  const Case& c = *runs.at;
  Naming result;
  result.best = with_law(c, with_law(c, runs.described, "saturating"), "saturating_linear");
  for (const Candidate& law : result.best.fitted.model.effects) {
    result.effects.push_back(named(law));
    result.ranking.push_back({.name = law.effect, .variant = law.variant});
  }
  drop_uncertain(c, result, [](const Doing&) {});
  const Model& model = result.best.fitted.model;
  ASSERT_EQ(model.effects.size(), 1u);
  EXPECT_EQ(model.effects.front().variant, "linear");
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects.front().variant, "linear");
  EXPECT_NEAR(model.rig.effects.get<plant::BladderElasticity>().stiffness_N_per_m, 290.0, 10.0);
  EXPECT_LT(excess(result.best.held_out), 0.2);
}

}  // namespace
}  // namespace mckibben::diagnose
