// Numbers, the map, names, a law: the stages of the workflow that gather what the verdict follows from.
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/constancy.hpp>
#include <sim/diagnose/further.hpp>
#include <sim/diagnose/remaining.hpp>
#include <sim/diagnose/support.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/where.hpp>
#include <sim/diagnose/workflow.hpp>

namespace mckibben::diagnose {

void Workflow::fit_numbers() {
  step_(stage("recalibrating"));
  Recalibrated result = recalibrate(case_, nominal_fit_);
  recalibrated_ = std::move(result.contender);
  if (!result.failure.empty()) warn("the nominal parameters could not be fitted: " + result.failure);
  tell_starts(result);
  weigh_numbers();
}

void Workflow::weigh_numbers() {
  learn_gap("recalibrated", recalibrated_.held_out);
  evidence_.nominal_left = excess(nominal_fit_.held_out);
  evidence_.recalibrated_left = excess(recalibrated_.held_out);
  evidence_.recalibration =
      compare(experiment_, nominal_fit_.held_out, recalibrated_.held_out, case_.split.held_out);
  evidence_.bent = bent(recalibrated_.fitted, case_.inflation);
  evidence_.far_from_nominal = far_from(nominal_fit_);
  evidence_.far_from_recalibrated = far_from(recalibrated_);
}

void Workflow::tell_starts(Recalibrated& result) {
  other_ends_ = std::move(result.other_ends);
  result_.begun = {result.begun, other_ends_.empty()};
  if (!other_ends_.empty())
    warn(
        fmt::format("the recalibration was begun from {} places of the numbers that are hardly known, and "
                    "did not end alike: the best end is taken, another one may be better",
                    result.begun));
}

void Workflow::map_where() {
  step_(stage("mapping"));
  result_.where = where(experiment_, recalibrated_.fitted.model.rig, usable_, settings_.seed);
  evidence_.patterned = !densest(result_.where).empty();
}

/// Residuals held out that an improvement is measured against.
const Eigen::VectorXd& Workflow::reference() const {
  return evidence_.recalibration_helps() ? recalibrated_.held_out : nominal_fit_.held_out;
}

void Workflow::name() {
  const auto at_fault = [&](const Contender& named, More more) {
    if (!looks_for_faults_) return false;
    found_on_the_way(more == More::tried_in_vain ? faults_beside(named) : told_faults_beside(named));
    if (faults_.empty() && more == More::tried_in_vain) found_on_the_way(faults_that_bend(named));
    return !faults_.empty();
  };
  naming_ = name_effects(case_, nominal_fit_, recalibrated_, reference(), at_fault, step_, search_);
  if (!faults_.empty()) return;
  spare_names();
  evidence_.invisible = naming_.invisible.size();
  evidence_.catalogue =
      static_cast<std::size_t>(std::ranges::count(catalogue(data_), Side::both, &Candidate::side));
  if (naming_.effects.empty()) return;
  const Eigen::VectorXd& named = naming_.best.held_out;
  evidence_.named_left = excess(named);
  look_for_stand_ins();
  tell_support(case_, recalibrated_, naming_, step_);
  evidence_.named_share = compare(experiment_, reference(), named, case_.split.held_out).share;
  // A gauge that misleads may be met by an effect that takes the motion further away; an error of its own
  // leaves the motion alone.
  const bool explained = carries(naming_.best.fitted.model.rig, plant::GaugeError::name);
  evidence_.gauge_misleads = reads_more() && !explained && rmse(named) >= rmse(reference());
  if (evidence_.named()) learn_gap("with what was taken", named);
}

/// Numbers further off than they are stated to be come before names.
void Workflow::spare_names() {
  if (naming_.effects.empty()) {
    // A name that was given up again may have led to numbers that no descent had found.
    const Fitted& end = naming_.best.fitted;
    if (end.model.effects.empty() && recalibrated_.fitted.cost - end.cost > thresholds.near.clear)
      believe_numbers(naming_.best);
    return spare_search();
  }
  step_(stage("trying other numbers", naming_.effects.size() + 1));
  search_.part("whether other numbers do as well as the names",
               [&] { prefer_numbers(case_, bases(), naming_, step_); });
  if (naming_.effects.empty()) believe_numbers(naming_.best);
}

void Workflow::spare_search() {
  if (excess(reference()) < thresholds.decide.worth_a_law) return;
  step_(stage("trying other numbers"));
  std::optional<Contender> numbers;
  search_.part("numbers that are further off than they are stated to be",
               [&] { numbers = numbers_that_close(case_, bases(), reference()); });
  if (numbers) believe_numbers(*numbers);
}

void Workflow::believe_numbers(const Contender& numbers) {
  recalibrated_ = numbers;
  weigh_numbers();
  map_where();
}

/// Names that are not the same everywhere, or are not shown to be where much is left.
void Workflow::look_for_stand_ins() {
  const Fitted& fitted = naming_.best.fitted;
  Runs asked = case_.split.training;
  asked.insert(asked.end(), case_.split.held_out.begin(), case_.split.held_out.end());
  std::ranges::sort(asked);
  const auto found = constancies(experiment_, fitted.model, asked,
                                 variance_inflation(experiment_, fitted.residuals, case_.split.training));
  const bool much_left = thresholds.near.is_much(evidence_.named_left);
  for (NamedEffect& effect : naming_.effects) {
    const auto place = std::ranges::find(fitted.model.effects, effect.who(), &Candidate::who);
    effect.constancy = found[static_cast<std::size_t>(place - fitted.model.effects.begin())];
    effect.stands_in = effect.constancy.drift() != nullptr || (much_left && !effect.constancy.is_shown());
    ++(effect.stands_in ? evidence_.stand_ins : evidence_.names);
  }
}

void Workflow::look_for_law() {
  if (!asks_for_law(evidence_, thresholds)) return;
  std::vector<const Contender*> bases{&recalibrated_};
  if (excess(recalibrated_.fitted.residuals) > thresholds.law.bent) bases.push_back(&nominal_fit_);
  law_ = find_law(case_, bases, reference(), step_, search_);
  if (law_.terms > 0 && naming_.effects.empty()) spare_law();
  evidence_.law_terms = law_.terms;
  evidence_.law_left = excess(law_.contender.held_out);
  evidence_.law_share = law_.gain.share;
}

/// The same before a law of force.
void Workflow::spare_law() {
  std::optional<Contender> numbers;
  search_.part("whether other numbers do as well as a law",
               [&] { numbers = numbers_as_good(case_, bases(), law_.contender); });
  if (!numbers) return;
  law_.terms = 0;
  believe_numbers(*numbers);
}

}  // namespace mckibben::diagnose
