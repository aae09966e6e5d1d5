// See the header.
#include <algorithm>
#include <array>
#include <cmath>

#include <sim/diagnose/competition.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

bool has_law(const Model& model) {
  return std::ranges::any_of(model.free, [](const Parameter& p) {
    return p.path.starts_with("effects.") && p.path.find(plant::ResidualForce::name) != std::string::npos;
  });
}

Explanation::Kind kind_of(const Model& model) {
  if (has_law(model)) return Explanation::Kind::law;
  if (!model.effects.empty()) return Explanation::Kind::effects;
  if (std::ranges::any_of(model.free, [](const Parameter& p) { return p.widened > 1.0; }))
    return Explanation::Kind::further_numbers;
  const bool moved = std::ranges::any_of(
      model.free, [&](const Parameter& p) { return p.scaled(value_of(model.rig, p.path)) != 0.0; });
  return moved ? Explanation::Kind::numbers : Explanation::Kind::nothing;
}

}  // namespace

Competition::Entry Competition::entry(const Contender& contender) {
  const Model& model = contender.fitted.model;
  Entry entry{kind_of(model), {}, contender.fitted.residuals.squaredNorm(), 0.0, {}};
  for (const Candidate& effect : model.effects) entry.effects.push_back(title(effect));
  std::ranges::sort(entry.effects);
  for (const Parameter& p : model.free)
    if (p.has_prior) entry.strain += std::pow(p.scaled(value_of(model.rig, p.path)), 2);
  entry.contender.held_out = contender.held_out;
  return entry;
}

void Competition::enter(const Case& c, const Contender& contender) {
  const Model& model = contender.fitted.model;
  if (!contender.fitted.failure.empty() ||
      !std::ranges::all_of(model.effects, [&](const Candidate& one) { return has_size(model, one); }))
    return;
  Entry now = entry(contender);
  const auto same = std::ranges::find_if(
      entries_, [&](const Entry& e) { return e.kind == now.kind && e.effects == now.effects; });
  if (same == entries_.end())
    entries_.push_back(std::move(now));
  else if (now.misfit(c.inflation) < same->misfit(c.inflation))
    *same = std::move(now);
}

std::vector<Explanation> Competition::told(const Case& c, const Contender* chosen) const {
  if (entries_.empty()) return {};
  std::vector<Explanation> list;
  std::array<std::size_t, thresholds.competition.shown.size()> shown{};
  std::vector<const Entry*> sorted;
  for (const Entry& one : entries_) sorted.push_back(&one);
  std::ranges::stable_sort(sorted, {}, [&](const Entry* one) { return one->misfit(c.inflation); });
  const auto competitor = [&](const Entry& one) {
    Contender contender = one.contender;
    contender.fitted.cost = one.misfit(c.inflation);
    return contender;
  };
  const Entry winner = chosen ? entry(*chosen) : *sorted.front();
  const Contender measure = chosen ? *chosen : competitor(winner);
  for (const Entry* one : sorted) {
    const Contender rival = competitor(*one);
    const bool wins = one->kind == winner.kind && one->effects == winner.effects;
    const bool as_well = wins || as_good(c, measure, rival);
    const auto kind = static_cast<std::size_t>(one->kind);
    if (!as_well && shown.at(kind)++ >= thresholds.competition.shown.at(kind)) continue;
    list.push_back({one->kind, one->effects, rival.fitted.cost, one->strain,
                    c.experiment.rmse(one->contender.held_out, c.split.held_out), as_well, wins && chosen});
  }
  return list;
}

}  // namespace mckibben::diagnose
