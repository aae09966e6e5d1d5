// The workflow; see the header and docs/diagnosis.md.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/diagnose/checks.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/first_look.hpp>
#include <sim/diagnose/interval.hpp>
#include <sim/diagnose/law.hpp>
#include <sim/diagnose/naming.hpp>
#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/diagnose/run_gaps.hpp>
#include <sim/diagnose/start.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/where.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/warnings.hpp>

namespace mckibben::diagnose {
namespace {

/// Mean squares above the floor: what is worth a search for a law, and what no disturbance would leave.
constexpr double worth_a_law = 0.15, beyond_disturbance = 60.0;
/// What no fit of the right effect that stopped early would leave.
constexpr double hopeless = 600.0;
/// Shares of the gap that effects must close to be named, to be named whatever is left, and a law to be
/// believed.
constexpr double least_named = 0.4, nearly_all = 0.9, least_law = 0.3;
/// The rate of false alarms that the thresholds are set for; docs/diagnosis.md has what was measured.
constexpr double false_alarm_rate = 0.03;

/// What is left of the motion where a gauge and the motion may contradict each other.
constexpr double contradicted = 1.0;

/// How often data are mended and looked at again.
constexpr int most_repairs = 2;

domain::Dataset without_gauges(domain::Dataset data, const Runs& dead) {
  for (const std::size_t run : dead) data.runs[run].muscle_pressure_Pa.reset();
  return data;
}

Runs all_but(const Runs& left_out, std::size_t count) {
  Runs list;
  for (std::size_t run = 0; run < count; ++run)
    if (!std::binary_search(left_out.begin(), left_out.end(), run)) list.push_back(run);
  return list;
}

/// What the motion alone has left on the runs held out: mean square above the floor's.
double motion_left(const Gap& gap) {
  return std::pow(gap.corrected_rmse / gap.noise_floor, 2) - 1.0;
}

class Workflow {
 public:
  Workflow(const domain::Dataset& data, const Doubts& doubts, const Settings& settings, const Step& step)
      : settings_(settings),
        step_(step),
        doubts_(doubts),
        data_(without_gauges(data, doubts_.dead_gauges)),
        usable_(all_but(doubts_.left_out, data.runs.size())),
        experiment_(data_, doubts_.masked, settings.threads, usable_),
        nominal_(data.rig),
        case_{
            experiment_, nominal_, {}, first_temperature, [this](const std::string& what) { learn(what); }} {}

  bool gauged() const { return experiment_.floor().pressure_Pa > 0.0; }

  /// Faults of the recording that stand in the way; none if `operator()` has a result. `look`: for such.
  const std::vector<Fault>& faults() const { return faults_; }

  Diagnosis operator()(bool look) {
    result_.seed = settings_.seed;
    result_.warnings = run::grouped(doubts_.warnings);
    result_.faults = doubts_.findings;
    const NoiseFloor& floor = experiment_.floor();
    if (floor.repeats >= floor.ratio)
      result_.warnings.push_back(fmt::format(
          "equal runs differ by {:.2g} in contraction ratio (rms over sqrt 2), more than a count and its "
          "jitter explain: this is taken for the noise floor",
          floor.repeats));
    else if (floor.noisy)
      result_.warnings.push_back(fmt::format(
          "contraction_ratio scatters by {:.2g} from tick to tick (rms), far more than counts do: "
          "this is taken for the noise floor",
          floor.jitter));
    if (carries(nominal_, plant::ResidualForce::name))
      result_.warnings.push_back("the rig's residual_law is kept as it is: if it is wrong, take it out");
    result_.false_alarm_rate = false_alarm_rate;
    result_.corrected = data_.rig;
    if (doubts_.cannot_tell) {
      result_.because = faults_in_words(result_) + *doubts_.cannot_tell;
      return std::move(result_);
    }
    case_.split = split(data_, usable_);
    step("replaying");
    replay();
    if (look) faults_ = first_look(case_, doubts_, nominal_fit_.fitted.model, usable_, step_);
    if (!faults_.empty()) return std::move(result_);
    recalibrate();
    judge();
    const Contender& final = chosen_ == &nominal_fit_ ? recalibrated_ : *chosen_;
    if (look && !far_from(final).empty())
      faults_ = examine(experiment_, final.fitted.model, usable_, {}).faults;
    if (!faults_.empty()) return std::move(result_);
    doubt();
    report();
    return std::move(result_);
  }

 private:
  void step(const std::string& what) { step_(what); }
  void learn(const std::string& what) {
    if (settings_.learned) settings_.learned(what);
  }
  void learn_gap(const std::string& of, const Eigen::VectorXd& held_out) {
    learn(fmt::format("{}: {:.2f} mm (rms) on the runs held out, the noise floor is {:.3f} mm", of,
                      1e3 * nominal_.muscle.rest_length_m * experiment_.rmse(held_out, case_.split.held_out),
                      1e3 * nominal_.muscle.rest_length_m * experiment_.floor().ratio));
  }

  void replay() {
    nominal_fit_.held_out = experiment_.residuals(nominal_, case_.split.held_out);
    auto& fitted = nominal_fit_.fitted;
    fitted.model = {nominal_, nominal_parameters(nominal_)};
    auto slopes = experiment_.slopes(nominal_, fitted.model.free, case_.split.training);
    fitted.residuals = std::move(slopes.residuals);
    fitted.columns = std::move(slopes.columns);
    fitted.cost = fitted.residuals.squaredNorm() / case_.temperature;
    learn_gap("the rig as described", nominal_fit_.held_out);
  }

  void recalibrate() {
    step("recalibrating");
    Model slight = nominal_fit_.fitted.model;
    bool has_effects = false;
    for (const Candidate& effect : catalogue()) {
      if (!effect.carried(nominal_)) continue;
      *find(slight.rig, effect.amplitude).value = effect.absent + 2.0 * least_amplitude * effect.typical;
      has_effects = true;
    }
    recalibrated_ = contend(case_, nominal_fit_.fitted.model, nullptr, has_effects);
    if (has_effects) {
      // They may be there in vain: from next to nothing the way down can be another.
      auto other = contend(case_, slight, nullptr, true);
      if (other.fitted.failure.empty() &&
          (!recalibrated_.fitted.failure.empty() || other.fitted.cost < recalibrated_.fitted.cost))
        recalibrated_ = std::move(other);
    }
    if (!recalibrated_.fitted.failure.empty()) {
      result_.warnings.push_back("the nominal parameters could not be fitted: " +
                                 recalibrated_.fitted.failure);
      recalibrated_ = nominal_fit_;
    }
    learn_gap("recalibrated", recalibrated_.held_out);
    const auto& residuals = recalibrated_.fitted.residuals;
    if (excess(residuals) + 1.0 > near_floor * near_floor) return;
    case_.temperature = temperature(experiment_, residuals, case_.split.training);
    auto again = contend(case_, recalibrated_.fitted.model);
    if (again.fitted.failure.empty()) recalibrated_ = std::move(again);
  }

  void judge() {
    const auto& held = case_.split.held_out;
    const auto tell = [this](const std::string& what) { step(what); };
    const auto recalibration = compare(experiment_, nominal_fit_.held_out, recalibrated_.held_out, held);
    if (recalibration.gained <= 0.0) chosen_ = &nominal_fit_;
    const Eigen::VectorXd reference = chosen_->held_out;
    naming_ = name_effects(case_, nominal_fit_, recalibrated_, reference, tell);
    // A gauge that misleads may be met by an effect that takes the motion further away.
    const bool misled = gauged() && !naming_.effects.empty() &&
                        experiment_.rmse(naming_.best.held_out, held) >= experiment_.rmse(reference, held);
    const bool named = !naming_.effects.empty() && !misled;
    if (named) learn_gap("with what was taken", naming_.best.held_out);
    if (misled)
      result_.warnings.push_back(
          "effects that would explain the gauge's pressures make the motion worse: is the gauge right?");
    const Eigen::VectorXd& with_names = named ? naming_.best.held_out : reference;
    const double left = excess(with_names);
    const double named_share = named ? compare(experiment_, reference, with_names, held).share : 0.0;
    if (left > worth_a_law && left > 0.05 * excess(nominal_fit_.held_out))
      law_ = find_law(case_, {&recalibrated_, &nominal_fit_}, reference, tell);
    const bool lawful = law_.terms > 0 && law_.gain.share > least_law &&
                        (!named || excess(law_.contender.held_out) < 0.4 * left);
    if (lawful) {
      result_.verdict = Verdict::unknown_effect;
      chosen_ = &law_.contender;
    } else if (named && (left < hopeless || named_share >= nearly_all) &&
               (named_share >= least_named || excess(reference) < worth_a_law)) {
      result_.verdict = Verdict::missing_effect;
      result_.effects = naming_.effects;
      chosen_ = &naming_.best;
      if (left + 1.0 > near_floor * near_floor)
        result_.warnings.push_back(
            fmt::format("{:.1f} noise floors are left with the effects named: more is missing, or their laws "
                        "are not quite these",
                        std::sqrt(left + 1.0)));
    } else if (left > beyond_disturbance) {
      result_.verdict = Verdict::unknown_effect;
      std::vector<std::string> names;
      for (const NamedEffect& effect : naming_.effects)
        names.push_back(full_name(effect.name, effect.variant));
      if (named)
        result_.warnings.push_back(
            fmt::format("nearest comes {}, but {:.1f} noise floors are left: not named",
                        fmt::join(names, " with "), std::sqrt(left + 1.0)));
    } else {
      const bool gap = excess(nominal_fit_.held_out) > nothing_left;
      result_.verdict = gap && convinces(recalibration) ? Verdict::recalibrate : Verdict::nothing_missing;
      tell_invisible();
    }
  }

  // What nobody could have seen is not "nothing".
  void tell_invisible() {
    if (naming_.invisible.empty()) return;
    const auto list = fmt::format("{}", fmt::join(naming_.invisible, ", "));
    if (result_.verdict == Verdict::nothing_missing && 2 * naming_.invisible.size() > catalogue().size())
      result_.verdict = Verdict::cannot_tell;
    result_.warnings.push_back("these data would not show, even at their usual size: " + list);
  }

  /// Runs that leave more above the floor than noise and slow disturbances would, in words.
  std::vector<std::string> far_from(const Contender& contender) const {
    std::vector<std::string> list;
    const auto look_at = [&](const Eigen::VectorXd& residuals, const Runs& runs) {
      for (const auto& part : experiment_.parts(runs)) {
        const double left = excess(residuals.segment(part.begin, part.rows));
        if (left > near_floor * near_floor)
          list.push_back(fmt::format("{} by {:.0f}", data_.runs[part.run].id, std::sqrt(left)));
      }
    };
    look_at(contender.fitted.residuals, case_.split.training);
    look_at(contender.held_out, case_.split.held_out);
    std::sort(list.begin(), list.end());
    return list;
  }

  // "Nothing is missing" is for data that agree run by run.
  void doubt() {
    const bool quiet = result_.verdict == Verdict::nothing_missing || result_.verdict == Verdict::recalibrate;
    if (!quiet) return;
    const bool agrees = result_.verdict == Verdict::recalibrate || far_from(nominal_fit_).empty();
    if (!agrees && chosen_ != &nominal_fit_) result_.verdict = Verdict::recalibrate;
    const bool moved = result_.verdict == Verdict::recalibrate;
    result_.unexplained = fmt::format("{}", fmt::join(far_from(moved ? *chosen_ : nominal_fit_), ", "));
    const bool recorder = std::any_of(result_.faults.begin(), result_.faults.end(),
                                      [](const Finding& finding) { return finding.common; });
    if (!result_.unexplained.empty() || recorder) result_.verdict = Verdict::cannot_tell;
  }

  void report() {
    if (result_.effects.empty()) disown(naming_.ranking);
    result_.ranking = naming_.ranking;
    result_.confusion_names = naming_.confusion_names;
    result_.confusion = naming_.confusion;
    const auto& held = case_.split.held_out;
    const bool as_it_was =
        result_.verdict == Verdict::nothing_missing || result_.verdict == Verdict::cannot_tell;
    if (as_it_was || chosen_ == &nominal_fit_) {
      chosen_rig_ = nominal_;
    } else {
      step("fitting all runs");
      const double scatter = temperature(experiment_, chosen_->fitted.residuals, case_.split.training);
      auto whole =
          fit(experiment_, chosen_->fitted.model, usable_, {.temperature = scatter, .thorough = true});
      const bool failed = !whole.failure.empty();
      if (failed) {
        result_.warnings.push_back(
            "the fit to all runs failed, the numbers are those of the training runs: " + whole.failure);
        whole = chosen_->fitted;
      }
      const auto bounds = intervals(experiment_, whole, failed ? case_.split.training : usable_, scatter);
      tell_parameters(result_, whole.model, bounds, recalibrated_.fitted.model.rig);
      static_cast<plant::Rig&>(result_.corrected) = whole.model.rig;
      chosen_rig_ = chosen_->fitted.model.rig;
      for (const Moved& moved : result_.recalibrated)
        if (std::abs(moved.deviations) > 0.999 * most_deviations &&
            !moved.fitted.name.starts_with("effects."))
          result_.warnings.push_back(
              fmt::format("{} stands at the edge of what its data sheet allows, {:+.0f} deviations: measure "
                          "it, or something "
                          "that acts like it is missing",
                          moved.fitted.name, moved.deviations));
      for (const auto& path : whole.model.refused)
        result_.warnings.push_back("no reading depends on " + path + ": it was not fitted");
    }
    if (result_.verdict == Verdict::unknown_effect) result_.law_valid_for = visited(data_, usable_);
    const Eigen::VectorXd corrected = experiment_.residuals(chosen_rig_, held);
    result_.gap = {experiment_.floor().ratio,
                   experiment_.rmse(nominal_fit_.held_out, held),
                   experiment_.rmse(recalibrated_.held_out, held),
                   experiment_.rmse(corrected, held),
                   0.0,
                   experiment_.floor().jitter};
    const auto above = [&](double rmse) {
      return std::max(0.0, rmse * rmse - result_.gap.noise_floor * result_.gap.noise_floor);
    };
    if (above(result_.gap.nominal_rmse) > 0.0)
      result_.gap.closed =
          std::clamp(1.0 - above(result_.gap.corrected_rmse) / above(result_.gap.nominal_rmse), 0.0, 1.0);
    step("mapping");
    result_.where = where(experiment_, recalibrated_.fitted.model.rig, usable_, settings_.seed);
    result_.start = look_at_start(experiment_, chosen_rig_, usable_);
    result_.runs = gaps_of_runs(experiment_, case_.split.held_out, usable_,
                                {nominal_, recalibrated_.fitted.model.rig, chosen_rig_});
    plan_next();
    result_.because = because(result_);
    if (result_.verdict != Verdict::nothing_missing)
      result_.because += sentence_of(result_.start, result_.gap);
  }

  // What would separate the effect named first from those it may be, or the next one.
  void plan_next() {
    if (result_.effects.empty()) return;
    for (const Doubt& doubt : naming_.doubts) {
      step("planning");
      const double scatter = temperature(experiment_, chosen_->fitted.residuals, case_.split.training);
      result_.next_experiment = plan(experiment_, doubt.with_effect, doubt.with_rival,
                                     {doubt.effect, doubt.rival}, result_.gap.corrected_rmse, 1.0 / scatter);
      if (result_.next_experiment) return;
    }
  }

  Settings settings_;
  const Step& step_;
  Doubts doubts_;
  domain::Dataset data_;
  Runs usable_;
  Experiment experiment_;
  plant::Rig nominal_;
  Case case_;
  Contender nominal_fit_;  ///< the rig as described, nothing moved
  Contender recalibrated_;
  Naming naming_;
  Law law_;
  const Contender* chosen_ = &recalibrated_;
  plant::Rig chosen_rig_;  ///< fitted to the training runs
  std::vector<Fault> faults_;
  Diagnosis result_;
};

/// The workflow, again each time that faults of the recording have been mended.
std::pair<Diagnosis, bool> mended(domain::Dataset data, const Settings& settings, const Step& step) {
  step("checking");
  Doubts doubts = check(data, settings.threads);
  for (int repairs = 0;; ++repairs) {
    Workflow workflow(data, doubts, settings, step);
    Diagnosis result = workflow(repairs < most_repairs);
    if (workflow.faults().empty()) return {std::move(result), workflow.gauged()};
    mend(data, doubts, workflow.faults());
  }
}

}  // namespace

Diagnosis diagnose(const domain::Dataset& data, const Settings& settings, const run::ProgressHook& progress) {
  std::size_t steps = 0;
  std::string without;
  const Step step = [&](const std::string& what) { progress(without + what, ++steps, 0); };
  auto [result, gauged] = mended(data, settings, step);
  const double left = motion_left(result.gap);
  if (!gauged || !(left >= contradicted)) return result;
  // No model meets the gauge and the motion: perhaps one meets the motion alone.
  without = "without the gauge: ";
  Diagnosis ungauged = mended(without_gauges(data, all_but({}, data.runs.size())), settings, step).first;
  if (ungauged.verdict == Verdict::cannot_tell || motion_left(ungauged.gap) > 0.25 * left) return result;
  ungauged.warnings.insert(
      ungauged.warnings.begin(),
      "muscle_pressure_bar is ignored: no model meets both it and the motion, but one meets the motion alone "
      "(has the gauge an offset, another scale, a limit; was it on another muscle?)");
  return ungauged;
}

}  // namespace mckibben::diagnose
