// From the verdict to the diagnosis: the numbers of all runs, the gap, the next measurement, the words.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <sim/data/amount.hpp>
#include <sim/diagnose/estimates.hpp>
#include <sim/diagnose/interval.hpp>
#include <sim/diagnose/left_open.hpp>
#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/profile.hpp>
#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/remaining.hpp>
#include <sim/diagnose/remarks.hpp>
#include <sim/diagnose/run_gaps.hpp>
#include <sim/diagnose/start.hpp>
#include <sim/diagnose/starts.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/workflow.hpp>

namespace mckibben::diagnose {

void Workflow::hand_over(const Decision& decision) {
  result_.verdict = decision.verdict;
  if (decision.chosen == Chosen::named)
    for (const NamedEffect& effect : naming_.effects)
      (effect.stands_in ? result_.stand_ins : result_.effects).push_back(effect);
  for (const Remark remark : decision.remarks)
    warn(remark_in_words(remark, naming_, evidence_.left(), besides_in_words(data_)));
  result_.unexplained = far_runs_in_words(decision.unexplained);
  for (const NamedEffect& effect : result_.stand_ins) disown(naming_.ranking, effect);
  if (result_.effects.empty()) disown(naming_.ranking);
  result_.ranking = naming_.ranking;
  result_.confusion_names = naming_.confusion_names;
  result_.confusion = naming_.confusion;
  if (decision.verdict == Verdict::unknown_effect) result_.law_valid_for = visited(data_, usable_);
  const bool undecided = decision.verdict == Verdict::cannot_tell && decision.chosen == Chosen::nominal;
  result_.explanations = competition_.told(case_, undecided ? nullptr : &contender(decision.chosen));
  chosen_rig_ = nominal_;
  if (decision.chosen != Chosen::nominal) fit_all_runs(contender(decision.chosen).fitted);
}

/// From where the training runs have led, and where starts did not agree from where others led.
Fitted Workflow::best_fit_of_all_runs(const Model& chosen) const {
  const FitSettings settings{.inflation = chosen_inflation_, .thorough = true};
  Fitted best = fit(experiment_, chosen, usable_, settings);
  for (const Rig& end : other_ends_) {
    Fitted other = fit(experiment_, begun_at(chosen, end), usable_, settings);
    if (other.failure.empty() && (!best.failure.empty() || other.cost < best.cost)) best = std::move(other);
  }
  return best;
}

void Workflow::tell_left_open(const Fitted& whole) {
  result_.left_open = left_open(whole, chosen_inflation_);
  const auto unknown = [&](const std::string& path) {
    const auto stated = nominal_.spreads.find(path);
    return stated != nominal_.spreads.end() && !std::isfinite(stated->second);
  };
  for (const LeftOpen& open : result_.left_open)
    if (std::any_of(open.parameters.begin(), open.parameters.end(), unknown))
      warn("left open by these data: " + open.words);
}

/// The numbers that are told, of the model that was chosen on the training runs.
void Workflow::fit_all_runs(const Fitted& chosen) {
  step_(stage("fitting all runs"));
  chosen_rig_ = chosen.model.rig;
  chosen_inflation_ = variance_inflation(experiment_, chosen.residuals, case_.split.training);
  auto whole = best_fit_of_all_runs(chosen.model);
  const bool failed = !whole.failure.empty();
  if (failed) {
    warn("the fit to all runs failed, the numbers are those of the training runs: " + whole.failure);
    whole = chosen;
  }
  auto bounds = intervals(experiment_, whole, failed ? case_.split.training : usable_, chosen_inflation_);
  if (!failed)
    trust_or_profile(experiment_, whole, usable_, chosen_inflation_, worth_a_profile(whole.model), bounds);
  tell_parameters(result_, whole.model, bounds, recalibrated_.fitted.model.rig);
  tell_left_open(whole);
  result_.corrected = whole.model.rig;
  for (std::size_t j = 0; j < bounds.size(); ++j)  // as well as these runs tell it, where the file told it
    if (const auto stated = result_.corrected.spreads.find(whole.model.free[j].path);
        stated != result_.corrected.spreads.end())
      stated->second = 0.5 * (bounds[j].high - bounds[j].low) / thresholds.interval.normal;
  for (const Moved& moved : result_.recalibrated)
    if (moved.at_the_edge && !moved.of_effect())
      warn(
          fmt::format("{} stands at the edge of what its data sheet allows, {:+.0f} deviations: measure "
                      "it, or something that acts like it is missing",
                      moved.fitted.name, moved.deviations));
  for (const auto& path : whole.model.refused) warn("no reading depends on " + path + ": it was not fitted");
}

/// How far the gap shrank, on the runs held out and run by run.
void Workflow::show_gap() {
  const Runs& held_out = whole_.held_out;
  const Eigen::VectorXd nominal = experiment_.residuals(nominal_, held_out),
                        recalibrated = experiment_.residuals(recalibrated_.fitted.model.rig, held_out),
                        corrected = experiment_.residuals(chosen_rig_, held_out);
  const auto rmse = [&](const Eigen::VectorXd& residuals) { return experiment_.rmse(residuals, held_out); };
  Gap& gap = result_.gap;
  gap = {.noise_floor = experiment_.floor().judged,
         .nominal_rmse = rmse(nominal),
         .recalibrated_rmse = rmse(recalibrated),
         .corrected_rmse = rmse(corrected),
         .jitter = experiment_.floor().jitter,
         .judged = judged()};
  const auto above = [&](double error) {
    return std::max(0.0, error * error - gap.noise_floor * gap.noise_floor);
  };
  if (above(gap.nominal_rmse) > 0.0)
    gap.closed = std::clamp(1.0 - above(gap.corrected_rmse) / above(gap.nominal_rmse), 0.0, 1.0);
  for (const domain::Beside which : domain::besides)
    if (const auto error = experiment_.rmse(which, corrected, held_out)) {
      const auto of = [&](const Eigen::VectorXd& residuals) {
        return *experiment_.rmse(which, residuals, held_out);
      };
      const auto [reading, unit] = data::told(which, data_.rig.pair() != nullptr);
      gap.beside.push_back({std::string(reading), std::string(unit), experiment_.floor().beside(which),
                            of(nominal), of(recalibrated), *error});
    }
  result_.start = look_at_start(experiment_, chosen_rig_, usable_);
  result_.remaining = remaining(experiment_, chosen_rig_, usable_, gap, settings_.seed);
  result_.runs =
      gaps_of_runs(experiment_, held_out, usable_, {nominal_, recalibrated_.fitted.model.rig, chosen_rig_});
}

bool Workflow::is_open(const Doubt& doubt) const {
  if (!doubt.effect) return result_.verdict == Verdict::recalibrate;
  return std::ranges::find(result_.effects, *doubt.effect, &NamedEffect::who) != result_.effects.end();
}

// What would separate the effect named first from those it may be, or the next one; or the numbers that
// were preferred from an effect.
void Workflow::plan_next() {
  // Plans are of currents, under loads.
  if (data_.pressure_is_given() || judged() != Judged::contraction) return;
  for (const Doubt& doubt : naming_.doubts) {
    if (!is_open(doubt)) continue;
    step_(stage("planning"));
    search_.part("the measurement that would tell more", [&] {
      result_.next_experiment = plan(experiment_, doubt.with_effect, doubt.with_rival, doubt.words(),
                                     case_.inflation, chosen_inflation_);
    });
    if (result_.next_experiment) return;
  }
}

void Workflow::tell_verdict() {
  result_.ended = search_.ended();
  result_.time_limit_s = search_.limit_s();
  result_.not_done = search_.not_done();
  result_.because = because(result_);
  if (result_.verdict != Verdict::nothing_missing)
    result_.because +=
        sentence_of(result_.remaining) + sentence_of(result_.start, result_.gap, data_.recorded.start);
}

}  // namespace mckibben::diagnose
