// Effects that may be missing beside faults of recordings; see the header. All is linear: what is suspected
// must be fitted before anything of it is believed.
#include <algorithm>
#include <cmath>
#include <set>

#include <sim/diagnose/examination.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
void Examination::draw_effects() {
  std::vector<Experiment::Change> changes;
  for (const Candidate& c : effects_) {
    if (carries(at_.rig, c.effect)) continue;
    for (const double shape : c.shapes.empty() ? std::vector{0.0} : c.shapes) {
      changes.push_back({[&c, shape](Hanging& h) {
                           h.rig = c.chosen(h.rig);
                           if (!c.shape.empty()) *find(h.rig, c.shape).value = shape;
                           *find(h.rig, c.amplitude).value =
                               c.absent + thresholds.parameter.probe * c.typical;
                         },
                         thresholds.parameter.probe * c.typical, true});
      drawn_.push_back({&c, shape, Eigen::VectorXd::Zero(residuals_.size())});
    }
  }
  if (changes.empty()) return;
  const auto slopes = experiment_.slopes(at_.rig, changes, runs_);
  const auto parts = experiment_.parts(runs_);
  for (std::size_t c = 0; c < changes.size(); ++c)
    for (std::size_t i = 0; i < parts.size(); ++i)
      drawn_[c].column.segment(begin(i), rows(i)) =
          experiment_.floor().judged * weight_ *
          slopes.columns.col(static_cast<Eigen::Index>(c)).segment(parts[i].begin, parts[i].rows);
}

/// What one effect of the catalogue takes off the misfit at best; all of nothing if there is none.
double Examination::most_gained(const Regression& alone) const {
  if (drawn_.empty()) return -infinite;
  double most = 0.0;
  for (const Drawn& effect : drawn_) {
    const auto [drop, amplitude] = alone.gain(effect.column, 0);
    if (effect.possible(amplitude)) most = std::max(most, drop);
  }
  return most;
}

/// As many runs as may be at fault are left out, each time the one without which least is left. `fits`: those
/// without an effect, which are the same for all.
Examination::Suspected Examination::trimmed(const Drawn& effect, std::map<Kept, Regression>& fits) const {
  const auto left_of = [&](const Kept& kept) {
    auto fit = fits.find(kept);
    if (fit == fits.end()) fit = fits.emplace(kept, regression(kept)).first;
    const auto [drop, amplitude] = fit->second.gain(only(kept, effect.column), 0);
    return Suspected{&effect, kept, fit->second.cost() - (effect.possible(amplitude) ? drop : 0.0),
                     amplitude};
  };
  Suspected best = left_of(Kept(runs_.size(), true));
  for (std::size_t odd = 0; odd < runs_.size() / (thresholds.fault.sound_for_one + 1); ++odd) {
    Suspected least{.effect = &effect, .kept = {}, .cost = infinite, .amplitude = 0.0};
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!best.kept[i]) continue;
      Kept fewer = best.kept;
      fewer[i] = false;
      if (Suspected left = left_of(fewer); left.cost < least.cost) least = std::move(left);
    }
    best = std::move(least);
  }
  return best;
}

/// Each effect with all runs late by the same whole number of ticks.
std::vector<Examination::Suspected> Examination::beside_lateness(const Regression& alone) const {
  std::vector<Suspected> list;
  for (const int ticks : thresholds.fault.common_ticks) {
    const Eigen::VectorXd late = all_late(ticks);
    Regression all = alone;
    all.add(late);
    for (const Drawn& effect : drawn_) {
      Regression with = alone;
      with.add(effect.column);
      if (std::abs(with.gain(late, 0).amplitude - ticks) > thresholds.fault.whole_tick) continue;
      const auto [drop, amplitude] = all.gain(effect.column, 0);
      list.push_back({&effect, Kept(runs_.size(), true), all.cost() - drop, amplitude, ticks});
    }
  }
  return list;
}

/// Those that leave far less of a run than `at_best` any effect leaves; each effect in its best shape.
std::vector<Examination::Suspected> Examination::most_promising(std::vector<Suspected> list,
                                                                double at_best) const {
  const double limit = thresholds.fault.worth_suspecting * at_best / static_cast<double>(runs_.size());
  std::erase_if(list, [&](const Suspected& one) {
    return one.cost_of_a_run() > limit || !one.effect->possible(one.amplitude);
  });
  std::stable_sort(list.begin(), list.end(),
                   [](const Suspected& a, const Suspected& b) { return a.cost < b.cost; });
  std::set<const Candidate*> listed;
  std::erase_if(list, [&](const Suspected& one) { return !listed.insert(one.effect->candidate).second; });
  if (list.size() > thresholds.fault.most_suspected) list.resize(thresholds.fault.most_suspected);
  return list;
}

Suspicion Examination::told(const Suspected& one) const {
  const Candidate& c = *one.effect->candidate;
  Suspicion suspicion{
      .effect = {.candidate = c, .amplitude = c.absent + one.amplitude, .shape = one.effect->shape},
      .sound = {},
      .common = {}};
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (one.kept[i]) suspicion.sound.push_back(runs_[i]);
    if (one.late != 0)
      suspicion.common.push_back({runs_[i], FaultKind::late, static_cast<double>(one.late), 0, true});
  }
  return suspicion;
}

/// First what leaves least of a run.
std::vector<Suspicion> Examination::suspicions(const Regression& alone, double at_best) const {
  std::map<Kept, Regression> fits;
  std::vector<Suspected> without_a_few;
  for (const Drawn& effect : drawn_) without_a_few.push_back(trimmed(effect, fits));
  auto list = most_promising(std::move(without_a_few), at_best);
  for (auto& late : most_promising(beside_lateness(alone), at_best)) list.push_back(std::move(late));
  std::stable_sort(list.begin(), list.end(), [](const Suspected& a, const Suspected& b) {
    return a.cost_of_a_run() < b.cost_of_a_run();
  });
  std::vector<Suspicion> best;
  for (const Suspected& one : list) best.push_back(told(one));
  return best;
}

}  // namespace mckibben::diagnose
