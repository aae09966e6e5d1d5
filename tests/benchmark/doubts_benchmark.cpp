// See the header.
#include "doubts_benchmark.hpp"

#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <random>
#include <string>

#include <fmt/format.h>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/plan.hpp>
#include <sim/run/batch.hpp>

#include "diagnose/planted.hpp"
#include "hidden_effects.hpp"
#include "tally.hpp"

namespace mckibben::diagnose {
namespace {

Runs all_runs(const domain::Dataset& data) {
  Runs runs(data.runs.size());
  std::iota(runs.begin(), runs.end(), std::size_t{0});
  return runs;
}

/// A data set, and the rig's numbers fitted to it.
class Measured {
 public:
  Measured(domain::Dataset data, unsigned threads)
      : data_(std::move(data)),
        experiment_(data_, nothing_masked(data_), threads, all_runs(data_)),
        at{experiment_, data_.rig, split(data_, all_runs(data_)), thresholds.scatter.first_inflation,
           [](const auto&) {}},
        described(replay(at)),
        numbers(recalibrate(at, described).contender) {}
  Measured(const Measured&) = delete;
  Measured& operator=(const Measured&) = delete;

 private:
  domain::Dataset data_;
  Experiment experiment_;

 public:
  Case at;
  Contender described, numbers;
};

/// The best fit of one of the effects that are wanted; those that promise most are tried, `most` at each rig.
template <class Wanted>
std::optional<Contender> best_effect(const Measured& measured, std::size_t most, const Wanted& wanted) {
  std::optional<Trial> best;
  for (const Contender* base : {&measured.described, &measured.numbers}) {
    std::size_t tried = 0;
    for (const Score& score : screen_at(measured.at, *base).scores) {
      if (!wanted(score.candidate.effect) || !(score.drop > 0.0)) continue;
      if (tried++ == most) break;
      Trial trial = rough(measured.at, *base, score, 0);
      if (!trial.contender.fitted.failure.empty()) continue;
      polish(measured.at, trial, [](const Doing&) {});
      if (!best || trial.contender.fitted.cost < best->contender.fitted.cost) best = std::move(trial);
    }
  }
  if (!best || !has_size(best->contender.fitted.model, best->score.candidate)) return std::nullopt;
  return std::move(best->contender);
}

bool in_doubt(const Case& c, const Contender& one, const Contender& other) {
  return as_good(c, one, other) && as_good(c, other, one);
}

struct Tallies {
  Tally planned, resolved, misled;
  double promised = 0.0;
  void print(const char* rivals) const {
    planned.print(fmt::format("an effect or {}: a measurement is planned", rivals));
    misled.print("with it the wrong one is better");
    resolved.print("doubt resolved");
    if (resolved.of > 0) fmt::print("{:<48} {:6.1f}\n", "doubts resolved, as promised", promised);
  }
};

/// Between the hidden effect and a rival; `again` fits that to the data with one run more.
template <class Again>
void follow(const Hidden& hidden, const Measured& before, const Contender& effect, const Contender& rival,
            const std::string& name, unsigned threads, Tallies& tallies, const Again& again) {
  const Case& c = before.at;
  if (!in_doubt(c, effect, rival)) return;
  const auto next =
      plan(c.experiment, effect.fitted, rival.fitted, {hidden.effects.front(), name}, c.inflation,
           variance_inflation(c.experiment, effect.fitted.residuals, c.split.training));
  tallies.planned.count(next.has_value());
  fmt::print("{:<28} {:>4} or {:<26}", hidden.title, hidden.seed, name);
  if (!next) {
    fmt::print(" nothing of the menu would tell\n");
    return;
  }
  domain::Dataset more = hidden.data;
  more.runs.push_back(measured_as(*next, hidden));
  const Measured after(std::move(more), threads);
  const Contender right = contend(after.at, effect.fitted.model), wrong = again(after);
  const bool holds = as_good(after.at, wrong, right), rival_holds = as_good(after.at, right, wrong);
  tallies.resolved.count(holds && !rival_holds);
  tallies.misled.count(!holds);
  tallies.promised += next->expected_power;
  fmt::print(" {:>14}, {:6.3f} kg, {:3.0f} %: {:8.1f} against {:8.1f}{}\n", next->waveform, next->load_kg,
             100.0 * next->expected_power, right.fitted.cost, wrong.fitted.cost,
             holds && !rival_holds ? "" : "  OPEN");
  std::fflush(stdout);
}

Hidden hidden_one(std::uint64_t seed, std::size_t i) {
  std::mt19937_64 random(1000 * seed + i);
  return hide(kind_titled(fmt::format("{} small", relatives.at(i % relatives.size()))),
              seed + i / relatives.size(),
              {.share = std::pow(10.0, std::uniform_real_distribution<double>(-0.7, 0.3)(random)),
               .runs = 3 + i % 2,
               .lasting = 0.4,
               .poor = true});
}

}  // namespace

void score_doubts(std::uint64_t seed, std::size_t sets, unsigned threads) {
  Tallies of_numbers, of_effects;
  run::catch_interrupts();
  try {
    for (std::size_t i = 0; i < sets; ++i) {
      const Hidden hidden = hidden_one(seed, i);
      const Measured before(hidden.data, threads);
      const std::string& truth = hidden.effects.front();
      const auto effect = best_effect(before, 2, [&](const std::string& name) { return name == truth; });
      if (!effect) continue;
      follow(hidden, before, *effect, before.numbers, "numbers", threads, of_numbers,
             [](const Measured& after) { return after.numbers; });
      const auto rival = best_effect(before, 2, [&](const std::string& name) { return name != truth; });
      if (!rival) continue;
      follow(hidden, before, *effect, *rival, rival->fitted.model.effects.front().effect, threads, of_effects,
             [&](const Measured& after) { return contend(after.at, rival->fitted.model); });
    }
  } catch (const run::Interrupted&) {
    fmt::print("interrupted\n");
  }
  of_numbers.print("numbers");
  of_effects.print("another effect");
}

}  // namespace mckibben::diagnose
