// Pairs with an effect in one muscle, in both or in none, made with the other method, on rigs a third of a
// deviation off their data sheet; see the header.
#include "pairs_benchmark.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/priors.hpp>

#include "diagnose/joint.hpp"
#include "tally.hpp"
#include "whole.hpp"

namespace mckibben::diagnose {
namespace {

struct Kind {
  EffectName hidden;  ///< empty: nothing
  std::string key{};
  double size = 0.0;
};
const std::array kinds{Kind{""},
                       Kind{{"muscle_leak", Side::one}, "conductance", 3e-10},
                       Kind{{"muscle_leak", Side::two}, "conductance", 3e-10},
                       Kind{{"muscle_leak", Side::both}, "conductance", 3e-10},
                       Kind{{"valve_lag", Side::two}, "time", 0.03},
                       Kind{{"valve_dead_band", Side::one}, "half_width", 8e3},
                       Kind{{"exhaust_restriction", Side::two}, "share", 0.4},
                       Kind{{"bladder_elasticity", Side::one}, "stiffness", 400.0}};

/// The kind's data; `size`: of what is hidden.
domain::Dataset hide(const Kind& kind, std::uint64_t seed, double& size) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Rig rig = plant::thesis_pair();
  for (const Parameter& p : nominal_parameters(rig))
    p.put(rig, std::clamp(p.unscaled(normal(random) / 3.0), p.lowest, p.highest));
  size = kind.size * std::uniform_real_distribution(0.7, 1.3)(random);
  if (!kind.key.empty())
    Parameter{.path = keys_of(kind.hidden) + kind.key, .both_sides = kind.hidden.side == Side::both}.put(
        rig, size);
  return of_a_joint(rig, true, {.seed = seed, .method = solver::Method::cvode});
}

}  // namespace

void score_pairs(std::uint64_t first, std::uint64_t seeds, unsigned threads) {
  Tally named, whose, sized, alarms, wrong;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed)
    for (const Kind& kind : kinds) {
      double size = 0.0;
      const Diagnosis found = whole_diagnosis(hide(kind, seed, size), {.threads = threads, .seed = seed});
      std::vector<std::string> said;
      bool right = false, right_muscle = false, other = false;
      for (const NamedEffect& effect : found.effects) {
        said.push_back(effect.who().words());
        if (!effect.confusable_with.empty())
          said.back() += fmt::format(" (or {})", fmt::join(words_of(effect.confusable_with), ", "));
        (effect.name == kind.hidden.effect ? right : other) = true;
        if (effect.who() != kind.hidden || effect.parameters.empty()) continue;
        right_muscle = true;
        sized.count(effect.parameters[0].low <= size && size <= effect.parameters[0].high);
      }
      if (kind.key.empty()) {
        alarms.count(found.verdict == Verdict::missing_effect || found.verdict == Verdict::unknown_effect);
      } else {
        named.count(right && !other);
        whose.count(right_muscle && !other);
      }
      wrong.count(other);
      const std::string title = kind.key.empty() ? "nothing" : kind.hidden.words();
      const bool good = kind.key.empty() ? found.effects.empty() : right_muscle && !other;
      fmt::print("{:<34} {:>4} {:<60}{}\n", title, seed,
                 said.empty() ? "-" : fmt::format("{}", fmt::join(said, " + ")), good ? "" : "  MISSED");
      std::fflush(stdout);
    }
  named.print("effects: right name alone");
  whose.print("effects: right name and muscle alone");
  sized.print("of these: true size in its interval");
  alarms.print("nothing hidden: false alarms");
  wrong.print("wrong names (all data sets)");
}

}  // namespace mckibben::diagnose
