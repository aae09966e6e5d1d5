// See the header.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/identify/decisive.hpp>
#include <sim/identify/held_out.hpp>
#include <sim/identify/rivals.hpp>

namespace mckibben::identify {

using diagnose::NamedEffect, diagnose::EffectName;
using Names = std::vector<std::string>;

namespace {

bool has(const Names& names, const std::string& name) {
  return std::ranges::binary_search(names, name);
}

/// How a run came to where it is first seen on its way is a guess, which favours one as much in every run:
/// strong evidence of each start is none.
bool rivals_chosen(const Identified& found, std::size_t i) {
  const Rows& rows = found.study->rows;
  const double guesses =
      rows.data().recorded.start == domain::Start::moving ? static_cast<double>(rows.runs.size()) : 1.0;
  return does_as_well(found.table, found.decision, i, guesses);
}

/// The parameter that is furthest off and by how much; empty where none is free.
std::string furthest_off(const Model& model) {
  if (model.point.z.size() == 0) return {};
  Eigen::Index at = 0;
  const double deviations = model.point.z.cwiseAbs().maxCoeff(&at);
  return fmt::format("{} by {:.1f} times its ±",
                     model.problem->dictionary.parameters[static_cast<std::size_t>(at)].path, deviations);
}

EffectName who(const Dictionary& dictionary, const std::string& name) {
  for (const Entry& entry : dictionary.entries)
    if (entry.name == name && entry.effect) return entry.effect->who();
  return {name};
}

std::string name_of(const NamedEffect& effect) {
  return diagnose::full_name(effect.name, "", effect.side);
}

/// The most probable model without this name: of the others of the chosen one, or without any; else the rig
/// as described.
const Scored* without(const Identified& found, const std::string& name) {
  Names rest = found.table[found.decision.chosen].names;
  std::erase(rest, name);
  const Scored* best = nullptr;
  for (const Scored& one : found.table) {
    if (one.general) continue;
    if (one.names == rest && !one.described) return &one;
    if (one.names.empty() && (best == nullptr || best->described)) best = &one;
  }
  return best;
}

}  // namespace

void support(const Identified& found, std::vector<NamedEffect>& effects) {
  const Study& study = *found.study;
  const Scored& chosen = found.table[found.decision.chosen];
  const auto groups = groups_of(study.rows);
  std::set<std::string> names;
  for (NamedEffect& effect : effects) {
    const std::string name = name_of(effect);
    names.insert(name);
    if (const Scored* rest = without(found, name)) {
      effect.support.fall = 2.0 * (chosen.score - rest->score);
      for (std::size_t group = 0; group < groups.size(); ++group) {
        const auto at = static_cast<Eigen::Index>(group);
        const double gain = chosen.held_out[at] - rest->held_out[at];
        if (std::abs(gain) < decisive.strong) continue;
        for (const std::size_t run : groups[group])
          (gain > 0.0 ? effect.support.by : effect.support.against)
              .push_back(study.data.runs[study.rows.runs[run]].id);
      }
      effect.support.runs = study.rows.runs.size();
      std::ranges::sort(effect.support.by);
      std::ranges::sort(effect.support.against);
    }
    for (std::size_t i = 0; i < found.table.size(); ++i) {
      const Scored& other = found.table[i];
      if (i == found.decision.chosen || other.general || other.described || has(other.names, name)) continue;
      const bool in_its_place =
          std::ranges::any_of(other.names, [&](const std::string& one) { return !has(chosen.names, one); });
      if (!in_its_place) continue;
      if (!rivals_chosen(found, i)) {
        effect.support.before_rivals =
            std::min(effect.support.before_rivals, 2.0 * (chosen.score - other.score));
        continue;
      }
      for (const std::string& one : other.names) {
        const EffectName rival = who(study.dictionary, one);
        if (!has(chosen.names, one) &&
            std::ranges::find(effect.confusable_with, rival) == effect.confusable_with.end())
          effect.confusable_with.push_back(rival);
      }
    }
  }
  std::ranges::stable_sort(effects, std::greater{}, [](const NamedEffect& one) { return one.support.fall; });
}

const Model* doubt(const Identified& found) {
  const Names& names = found.table[found.decision.chosen].names;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < found.table.size(); ++i) {
    const Scored& other = found.table[i];
    const bool another =
        std::ranges::any_of(other.names, [&](const std::string& one) { return !has(names, one); });
    if (i == found.decision.chosen || other.general || !another || !rivals_chosen(found, i)) continue;
    if (!best || other.score > found.table[*best].score) best = i;
  }
  return best ? &found.models[*best] : nullptr;
}

std::vector<diagnose::Explanation> explanations(const Identified& found, const std::vector<double>& left) {
  using Means = diagnose::Explanation::Kind;
  std::vector<diagnose::Explanation> list;
  const Scored& best = found.table[found.decision.best];
  for (std::size_t i = 0; i < found.table.size(); ++i) {
    const Scored& one = found.table[i];
    const auto [nats, error] = loss(best.held_out, one.held_out);
    const Eigen::VectorXd& z = found.models[i].point.z;
    list.push_back({.kind = one.described       ? Means::nothing
                            : one.general       ? Means::law
                            : one.names.empty() ? Means::numbers
                                                : Means::effects,
                    .effects = one.names,
                    .misfit = 2.0 * (best.score - one.score),
                    .strain = z.squaredNorm(),
                    .furthest_off = furthest_off(found.models[i]),
                    .held_out_rmse = left[i],
                    .as_good = i == found.decision.chosen || rivals_chosen(found, i),
                    .chosen = i == found.decision.chosen,
                    .nats = best.score - one.score,
                    .held_out_nats = nats,
                    .held_out_error = error,
                    .mass = found.decision.mass[i]});
  }
  std::ranges::stable_sort(list, {}, &diagnose::Explanation::nats);
  return list;
}

namespace {

std::string outcome_of(const Identified& found, std::size_t i) {
  const Scored &chosen = found.table[found.decision.chosen], &one = found.table[i];
  if (i == found.decision.chosen) return "chosen";
  const auto [nats, error] = loss(chosen.held_out, one.held_out);
  if (!(nats <= decisive.errors * error))
    return fmt::format("predicts unseen runs worse, by {:.0f} ± {:.0f} nats", nats, error);
  if (rivals_chosen(found, i)) return "predicts unseen runs as well";
  if (one.score < chosen.score) return fmt::format("less probable, by {:.0f} nats", chosen.score - one.score);
  return "predicts unseen runs no better than what is simpler";
}

}  // namespace

std::vector<diagnose::Ranked> ranking(const Identified& found, const std::vector<double>& left) {
  const Study& study = *found.study;
  std::set<std::string> names;
  for (const Entry& entry : study.dictionary.entries) names.insert(entry.name);
  for (const Differing& one : differing) names.insert(std::string(one.name));
  double reference = -std::numeric_limits<double>::infinity();
  for (const Scored& one : found.table)
    if (one.names.empty()) reference = std::max(reference, one.score);
  std::vector<diagnose::Ranked> list;
  for (const std::string& name : names) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < found.table.size(); ++i) {
      if (!has(found.table[i].names, name) || found.table[i].general) continue;
      const bool is_chosen = i == found.decision.chosen;
      if (!best || is_chosen ||
          (*best != found.decision.chosen && found.table[i].score > found.table[*best].score))
        best = i;
    }
    const auto promised = found.promised.find(name);
    const EffectName of = who(study.dictionary, name);
    diagnose::Ranked one{
        .name = of.effect,
        .score = promised == found.promised.end() ? 0.0 : std::max(0.0, 2.0 * promised->second),
        .side = of.side,
        .untried = promised != found.promised.end() && promised->second > decisive.strong};
    one.outcome = one.untried ? "not tried: others promised more" : "promises too little";
    if (best) {
      one.untried = false;
      one.refitted = true;
      one.training_rmse = found.models[*best].left() * study.rows.unit;
      one.held_out_rmse = left[*best];
      one.outcome = outcome_of(found, *best);
      Names beside = found.table[*best].names;
      std::erase(beside, name);
      if (*best != found.decision.chosen && !beside.empty())
        one.outcome = fmt::format("with {}: {}", fmt::join(beside, ", "), one.outcome);
      one.fall = std::max(0.0, 2.0 * (found.table[*best].score - reference));
      for (const Added& added : found.models[*best].point.effects)
        if (const Entry& entry = study.dictionary.entries[added.entry]; entry.name == name && entry.effect)
          one.variant = entry.effect->variant;
    }
    list.push_back(std::move(one));
  }
  std::ranges::stable_sort(list, [](const diagnose::Ranked& a, const diagnose::Ranked& b) {
    return std::pair(a.refitted ? a.fall : -1.0, a.score) > std::pair(b.refitted ? b.fall : -1.0, b.score);
  });
  return list;
}

}  // namespace mckibben::identify
