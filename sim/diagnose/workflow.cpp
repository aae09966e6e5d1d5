// The order of the stages, what is told of the check, and runs that a model does not come near: faults beside
// it, runs that the search did not ask.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <sim/data/amount.hpp>
#include <sim/data/warnings.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/first_look.hpp>
#include <sim/diagnose/remarks.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/workflow.hpp>

namespace mckibben::diagnose {
namespace {

domain::Dataset without_gauges(domain::Dataset data, const Runs& dead, const Runs& dead_opposite) {
  for (const std::size_t run : dead) data.runs[run].muscle_pressure_Pa.reset();
  for (const std::size_t run : dead_opposite) data.runs[run].opposite_pressure_Pa.reset();
  return data;
}

Runs all_but(const Runs& left_out, std::size_t count) {
  Runs list;
  for (std::size_t run = 0; run < count; ++run)
    if (!std::binary_search(left_out.begin(), left_out.end(), run)) list.push_back(run);
  return list;
}

}  // namespace

Workflow::Workflow(const domain::Dataset& data, const Checked& checked, const Settings& settings,
                   const Step& step, Search& search, bool ask_all)
    : settings_(settings),
      step_(step),
      search_(search),
      checked_(checked),
      data_(without_gauges(data, checked_.dead_gauges, checked_.dead_opposite_gauges)),
      usable_(all_but(checked_.left_out, data.runs.size())),
      experiment_(data_, checked_.masked, settings.threads, usable_),
      nominal_(data.rig),
      whole_(split(data_, usable_)),
      case_{experiment_,
            nominal_,
            ask_all ? whole_ : asked(data_, whole_),
            thresholds.scatter.first_inflation,
            [this](const std::string& what) { learn(what); },
            [this](const Contender& contender) { competition_.enter(case_, contender); }} {}

Diagnosis Workflow::operator()(bool look) {
  tell_check();
  if (checked_.cannot_tell) return unusable();
  replay_as_described();
  // At another length a run may fit no model for other reasons.
  looks_for_faults_ = look && judged() == Judged::contraction;
  if (looks_for_faults_) look_for_faults();
  if (data_.recorded.start == domain::Start::moving)  // what effects remember of before may be another, too
    std::erase_if(faults_, [](const Fault& fault) { return fault.kind == FaultKind::another_rig; });
  if (!faults_.empty()) return std::move(result_);
  fit_numbers();
  map_where();
  name();
  if (!faults_.empty()) return std::move(result_);
  look_for_law();
  evidence_.search_ended = search_.ended() != Ended::no;
  const Decision decision = decide(evidence_, thresholds);
  if (looks_for_faults_)  // of a model that was found to its end
    search_.part("faults of runs beside what was found", [&] {
      found(faults_beside(decision.chosen == Chosen::nominal ? recalibrated_ : contender(decision.chosen)));
    });
  if (!faults_.empty()) return std::move(result_);
  hand_over(decision);
  confirm();
  show_gap();
  plan_next();
  tell_verdict();
  return std::move(result_);
}

void Workflow::learn(const std::string& what) {
  if (settings_.learned) settings_.learned(what);
}

void Workflow::learn_gap(const std::string& of, const Eigen::VectorXd& held_out) {
  learn(fmt::format("{}: {} (rms) on the runs held out, the noise floor is {}", of,
                    data::amount_of(judged(), rmse(held_out), nominal_),
                    data::amount_of(judged(), experiment_.floor().judged, nominal_)));
}

double Workflow::rmse(const Eigen::VectorXd& held_out) const {
  return experiment_.rmse(held_out, case_.split.held_out);
}

void Workflow::tell_check() {
  result_.seed = settings_.seed;
  result_.warnings = settings_.warnings;
  for (std::string& what : data::grouped(checked_.warnings)) warn(std::move(what));
  result_.faults = checked_.faulty;
  result_.false_alarm_rate = thresholds.decide.false_alarm_rate;
  result_.corrected = data_.rig;
  evidence_.usable = !checked_.cannot_tell;
  evidence_.runs = usable_.size();
  evidence_.common_fault = std::any_of(checked_.faulty.begin(), checked_.faulty.end(),
                                       [](const FaultyRun& faulty) { return faulty.common; });
  const NoiseFloor& floor = experiment_.floor();
  for (const std::string& what : noise_in_words(data_, floor)) warn(what);
  for (const std::string& what : sheets_in_words(data_, floor)) warn(what);
  for (const std::string& what : rows_in_words(data_, floor)) warn(what);
  if (carries(nominal_, plant::ResidualForce::name))
    warn("the rig's residual_law is kept as it is: if it is wrong, take it out");
}

Diagnosis Workflow::unusable() {
  result_.verdict = decide(evidence_, thresholds).verdict;
  result_.because = faults_in_words(result_) + *checked_.cannot_tell;
  return std::move(result_);
}

void Workflow::replay_as_described() {
  step_(stage("replaying"));
  nominal_fit_ = replay(case_);
  competition_.enter(case_, nominal_fit_);
  learn_gap("the rig as described", nominal_fit_.held_out);
}

void Workflow::look_for_faults() {
  search_.part("faults of runs", [&] {
    found_on_the_way(first_look(case_, checked_, nominal_fit_.fitted.model, usable_, step_));
  });
}

/// Those of sound runs are none.
void Workflow::found(std::vector<Fault> faults) {
  std::erase_if(faults, [&](const Fault& fault) { return !fault.common && checked_.is_sound(fault.run); });
  faults_ = std::move(faults);
}

/// What the load tells is believed only if nothing that was found explains it.
void Workflow::found_on_the_way(std::vector<Fault> faults) {
  if (std::ranges::none_of(faults, &Fault::told_by_load)) found(std::move(faults));
}

const Contender& Workflow::contender(Chosen chosen) const {
  switch (chosen) {
    case Chosen::law:
      return law_.contender;
    case Chosen::named:
      return naming_.best;
    case Chosen::recalibrated:
      return recalibrated_;
    case Chosen::nominal:
      break;
  }
  return nominal_fit_;
}

/// Runs that leave more above the floor than noise and slow disturbances would.
std::vector<FarRun> Workflow::far_from(const Contender& contender) const {
  std::vector<FarRun> list;
  const auto look_at = [&](const Eigen::VectorXd& residuals, const Runs& runs) {
    for (const auto& part : experiment_.parts(runs)) {
      const double left = excess(residuals.segment(part.begin, part.rows));  // above the floor
      if (left > thresholds.near.mean_square()) list.push_back({data_.runs[part.run].id, left});
    }
  };
  look_at(contender.fitted.residuals, case_.split.training);
  look_at(contender.held_out, case_.split.held_out);
  const Runs others = not_asked();
  look_at(experiment_.residuals(contender.fitted.model.rig, others), others);
  return list;
}

/// Faults of runs that a fitted model does not come near.
std::vector<Fault> Workflow::faults_beside(const Contender& fitted) const {
  if (far_from(fitted).empty()) return {};
  return examine(experiment_, fitted.fitted.model, usable_, {}).faults;
}

/// The same on the way, where more may be missing: faults of a few runs that say what they are, if no effect
/// beside does nearly as well.
std::vector<Fault> Workflow::told_faults_beside(const Contender& named) const {
  const auto say_nothing = [](const std::vector<Fault>& faults) {
    return faults.empty() || std::ranges::any_of(faults, [](const Fault& fault) {
             return fault.common || fault.kind == FaultKind::another_rig;
           });
  };
  if (say_nothing(faults_beside(named))) return {};
  auto faults = examine(experiment_, named.fitted.model, usable_, catalogue(data_)).faults;
  if (say_nothing(faults)) faults.clear();
  return faults;
}

/// The same where a run at fault has bent the fit so far that straight lines from there do not tell: fitted
/// again without the run that it meets worst, the model must meet all others.
std::vector<Fault> Workflow::faults_that_bend(const Contender& named) const {
  const Fitted& bent = named.fitted;
  if (case_.split.training.size() <= thresholds.fault.least_sound) return {};
  const auto left = [&](const auto& part) { return excess(bent.residuals.segment(part.begin, part.rows)); };
  const auto parts = experiment_.parts(case_.split.training);
  const auto worst = std::ranges::max_element(parts, {}, left);
  if (left(*worst) <= thresholds.near.mean_square()) return {};
  Split others = case_.split;
  std::erase(others.training, worst->run);
  const Fitted fitted = fit(experiment_, bent.model, others.training, {.inflation = case_.inflation});
  if (!fitted.failure.empty() || !all_near_floor(experiment_, fitted.residuals, others.training) ||
      !all_near_floor(experiment_, experiment_.residuals(fitted.model.rig, others.held_out), others.held_out))
    return {};
  return examine(experiment_, fitted.model, usable_, {}).faults;
}

/// Usable runs that the search does without.
Runs Workflow::not_asked() const {
  const Split& asked = case_.split;
  Runs others;
  std::ranges::copy_if(usable_, std::back_inserter(others), [&](std::size_t run) {
    return !std::ranges::binary_search(asked.training, run) &&
           !std::ranges::binary_search(asked.held_out, run);
  });
  return others;
}

void Workflow::confirm() {
  const Runs others = not_asked();
  if (others.empty()) return;
  const auto left = [&](const Runs& runs) {
    return excess(experiment_.residuals(result_.corrected, runs)) + 1.0;
  };
  const double of_asked = std::max(left(case_.split.training), left(case_.split.held_out));
  confirmed_ = left(others) <= std::max(thresholds.near.mean_square(), thresholds.asked.confirmed * of_asked);
  warn(fmt::format("of {} runs the search asked {}, of all loads and currents; what it found {}",
                   usable_.size(), usable_.size() - others.size(),
                   confirmed_ ? "was tried on all, and meets the others as well"
                              : "does not meet the others as well, and there was no time to ask all"));
}

}  // namespace mckibben::diagnose
