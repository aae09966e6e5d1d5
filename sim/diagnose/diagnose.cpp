// The workflow, in running order; see the header and docs/diagnosis.md.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/diagnose/amount.hpp>
#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/competition.hpp>
#include <sim/diagnose/constancy.hpp>
#include <sim/diagnose/decide.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/diagnose/estimates.hpp>
#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/first_look.hpp>
#include <sim/diagnose/further.hpp>
#include <sim/diagnose/interval.hpp>
#include <sim/diagnose/law.hpp>
#include <sim/diagnose/left_open.hpp>
#include <sim/diagnose/name.hpp>
#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/profile.hpp>
#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/remaining.hpp>
#include <sim/diagnose/remarks.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/diagnose/run_gaps.hpp>
#include <sim/diagnose/search.hpp>
#include <sim/diagnose/start.hpp>
#include <sim/diagnose/starts.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/support.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/where.hpp>
#include <sim/run/warnings.hpp>

namespace mckibben::diagnose {
namespace {

domain::Dataset without_gauges(domain::Dataset data, const Runs& dead, const Runs& dead_opposite) {
  for (const std::size_t run : dead) data.runs[run].muscle_pressure_Pa.reset();
  for (const std::size_t run : dead_opposite) data.runs[run].opposite_pressure_Pa.reset();
  return data;
}

/// With what is judged alone.
domain::Dataset without_besides(domain::Dataset data) {
  for (domain::Run& run : data.runs) {
    run.muscle_pressure_Pa.reset();
    run.opposite_pressure_Pa.reset();
    if (run.kind_of_judged() != Judged::force) run.force_N.clear();
  }
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
  /// `ask_all`: runs in the search, however many there are.
  Workflow(const domain::Dataset& data, const Checked& checked, const Settings& settings, const Step& step,
           Search& search, bool ask_all)
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

  Judged judged() const { return data_.judged(); }
  bool reads_more() const { return experiment_.floor().any_beside(); }

  /// Faults of the recording that stand in the way; none if `operator()` has a result. `look`: for such.
  const std::vector<Fault>& faults() const { return faults_; }

  /// Whether the runs that the search did not ask are met by what it chose as well as those that it asked.
  bool is_confirmed() const { return confirmed_; }

  Diagnosis operator()(bool look) {
    tell_check();
    if (checked_.cannot_tell) return unusable();
    replay_as_described();
    look = look &&
           judged() == Judged::contraction;  // at another length a run may fit no model for other reasons
    if (look) look_for_faults();
    if (data_.recorded.start == domain::Start::moving)  // what effects remember of before may be another, too
      std::erase_if(faults_, [](const Fault& fault) { return fault.kind == FaultKind::another_rig; });
    if (!faults_.empty()) return std::move(result_);
    fit_numbers();
    map_where();
    name();
    look_for_law();
    evidence_.search_ended = search_.ended() != Ended::no;
    const Decision decision = decide(evidence_, thresholds);
    if (look)
      search_.part("faults of runs beside what was found", [&] {
        faults_ = faults_beside(decision.chosen);
      });  // of a model that was found to its end
    if (!faults_.empty()) return std::move(result_);
    hand_over(decision);
    confirm();
    show_gap();
    plan_next();
    tell_verdict();
    return std::move(result_);
  }

 private:
  void learn(const std::string& what) {
    if (settings_.learned) settings_.learned(what);
  }
  void learn_gap(const std::string& of, const Eigen::VectorXd& held_out) {
    learn(fmt::format("{}: {} (rms) on the runs held out, the noise floor is {}", of,
                      amount_of(judged(), rmse(held_out), nominal_),
                      amount_of(judged(), experiment_.floor().judged, nominal_)));
  }
  double rmse(const Eigen::VectorXd& held_out) const {
    return experiment_.rmse(held_out, case_.split.held_out);
  }
  void warn(std::string what) { result_.warnings.push_back(std::move(what)); }

  void tell_check() {
    result_.seed = settings_.seed;
    result_.warnings = settings_.warnings;
    for (std::string& what : run::grouped(checked_.warnings)) warn(std::move(what));
    result_.faults = checked_.faulty;
    result_.false_alarm_rate = thresholds.decide.false_alarm_rate;
    result_.corrected = data_.rig;
    evidence_.usable = !checked_.cannot_tell;
    evidence_.common_fault = std::any_of(checked_.faulty.begin(), checked_.faulty.end(),
                                         [](const FaultyRun& faulty) { return faulty.common; });
    const NoiseFloor& floor = experiment_.floor();
    if (floor.repeats >= floor.judged)
      warn(
          fmt::format("equal runs differ by {:.2g} {} (rms over sqrt 2), more than a count "
                      "and its jitter explain: this is taken for the noise floor",
                      floor.repeats, unit_in_words(judged())));
    else if (floor.noisy)
      warn(
          fmt::format("{} scatters by {:.2g} from tick to tick (rms), far more than counts "
                      "do: this is taken for the noise floor",
                      judged() == Judged::angle ? "angle_rad" : "contraction_ratio", floor.jitter));
    for (const std::string& what : sheets_in_words(data_, floor)) warn(what);
    for (const std::string& what : rows_in_words(data_, floor)) warn(what);
    if (carries(nominal_, plant::ResidualForce::name))
      warn("the rig's residual_law is kept as it is: if it is wrong, take it out");
  }

  Diagnosis unusable() {
    result_.verdict = decide(evidence_, thresholds).verdict;
    result_.because = faults_in_words(result_) + *checked_.cannot_tell;
    return std::move(result_);
  }

  void replay_as_described() {
    step_(stage("replaying"));
    nominal_fit_ = replay(case_);
    competition_.enter(case_, nominal_fit_);
    learn_gap("the rig as described", nominal_fit_.held_out);
  }

  void look_for_faults() {
    search_.part("faults of runs",
                 [&] { faults_ = first_look(case_, checked_, nominal_fit_.fitted.model, usable_, step_); });
  }

  void fit_numbers() {
    step_(stage("recalibrating"));
    Recalibrated result = recalibrate(case_, nominal_fit_);
    recalibrated_ = std::move(result.contender);
    if (!result.failure.empty()) warn("the nominal parameters could not be fitted: " + result.failure);
    tell_starts(result);
    weigh_numbers();
  }

  void weigh_numbers() {
    learn_gap("recalibrated", recalibrated_.held_out);
    evidence_.nominal_left = excess(nominal_fit_.held_out);
    evidence_.recalibrated_left = excess(recalibrated_.held_out);
    evidence_.recalibration =
        compare(experiment_, nominal_fit_.held_out, recalibrated_.held_out, case_.split.held_out);
    evidence_.at_bounds = at_bounds(recalibrated_.fitted.model);
    evidence_.far_from_nominal = far_from(nominal_fit_);
    evidence_.far_from_recalibrated = far_from(recalibrated_);
  }

  void tell_starts(Recalibrated& result) {
    other_ends_ = std::move(result.other_ends);
    result_.begun = {result.begun, other_ends_.empty()};
    if (!other_ends_.empty())
      warn(
          fmt::format("the recalibration was begun from {} places of the numbers that are hardly known, and "
                      "did not end alike: the best end is taken, another one may be better",
                      result.begun));
  }

  void map_where() {
    step_(stage("mapping"));
    result_.where = where(experiment_, recalibrated_.fitted.model.rig, usable_, settings_.seed);
    evidence_.patterned = std::ranges::any_of(result_.where, &Cell::significant);
  }

  /// Residuals held out that an improvement is measured against.
  const Eigen::VectorXd& reference() const {
    return evidence_.recalibration_helps() ? recalibrated_.held_out : nominal_fit_.held_out;
  }

  void name() {
    naming_ = name_effects(case_, nominal_fit_, recalibrated_, reference(), step_, search_);
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
  void spare_names() {
    if (naming_.effects.empty()) return spare_search();
    step_(stage("trying other numbers", naming_.effects.size() + 1));
    search_.part("whether other numbers do as well as the names",
                 [&] { prefer_numbers(case_, bases(), naming_, step_); });
    if (naming_.effects.empty()) believe_numbers(naming_.best);
  }

  std::vector<const Fitted*> bases() const { return {&nominal_fit_.fitted, &recalibrated_.fitted}; }

  void spare_search() {
    if (excess(reference()) < thresholds.decide.worth_a_law) return;
    step_(stage("trying other numbers"));
    std::optional<Contender> numbers;
    search_.part("numbers that are further off than they are stated to be",
                 [&] { numbers = numbers_that_close(case_, bases(), reference()); });
    if (numbers) believe_numbers(*numbers);
  }

  void believe_numbers(const Contender& numbers) {
    recalibrated_ = numbers;
    weigh_numbers();
    map_where();
  }

  /// Names that are not the same everywhere, or are not shown to be where much is left.
  void look_for_stand_ins() {
    const Fitted& fitted = naming_.best.fitted;
    Runs asked = case_.split.training;
    asked.insert(asked.end(), case_.split.held_out.begin(), case_.split.held_out.end());
    std::ranges::sort(asked);
    const auto found = constancies(experiment_, fitted.model, asked,
                                   variance_inflation(experiment_, fitted.residuals, case_.split.training));
    const bool much_left = evidence_.named_left + 1.0 > thresholds.near.mean_square();
    for (NamedEffect& effect : naming_.effects) {
      const auto place = std::ranges::find(fitted.model.effects, effect.who(), &Candidate::who);
      effect.constancy = found[static_cast<std::size_t>(place - fitted.model.effects.begin())];
      effect.stands_in = effect.constancy.drift() != nullptr || (much_left && !effect.constancy.is_shown());
      ++(effect.stands_in ? evidence_.stand_ins : evidence_.names);
    }
  }

  void look_for_law() {
    if (!asks_for_law(evidence_, thresholds)) return;
    law_ = find_law(case_, {&recalibrated_, &nominal_fit_}, reference(), step_, search_);
    if (law_.terms > 0 && naming_.effects.empty()) spare_law();
    evidence_.law_terms = law_.terms;
    evidence_.law_left = excess(law_.contender.held_out);
    evidence_.law_share = law_.gain.share;
  }

  /// The same before a law of force.
  void spare_law() {
    std::optional<Contender> numbers;
    search_.part("whether other numbers do as well as a law",
                 [&] { numbers = numbers_as_good(case_, bases(), law_.contender); });
    if (!numbers) return;
    law_.terms = 0;
    believe_numbers(*numbers);
  }

  const Contender& contender(Chosen chosen) const {
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
  std::vector<FarRun> far_from(const Contender& contender) const {
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
  std::vector<Fault> faults_beside(Chosen chosen) const {
    const Contender& fitted = chosen == Chosen::nominal ? recalibrated_ : contender(chosen);
    if (far_from(fitted).empty()) return {};
    return examine(experiment_, fitted.fitted.model, usable_, {}).faults;
  }

  /// Usable runs that the search does without.
  Runs not_asked() const {
    const Split& asked = case_.split;
    Runs others;
    std::ranges::copy_if(usable_, std::back_inserter(others), [&](std::size_t run) {
      return !std::ranges::binary_search(asked.training, run) &&
             !std::ranges::binary_search(asked.held_out, run);
    });
    return others;
  }

  void confirm() {
    const Runs others = not_asked();
    if (others.empty()) return;
    const auto left = [&](const Runs& runs) {
      return excess(experiment_.residuals(result_.corrected, runs)) + 1.0;
    };
    const double of_asked = std::max(left(case_.split.training), left(case_.split.held_out));
    confirmed_ =
        left(others) <= std::max(thresholds.near.mean_square(), thresholds.asked.confirmed * of_asked);
    warn(fmt::format("of {} runs the search asked {}, of all loads and currents; what it found {}",
                     usable_.size(), usable_.size() - others.size(),
                     confirmed_ ? "was tried on all, and meets the others as well"
                                : "does not meet the others as well, and there was no time to ask all"));
  }

  void hand_over(const Decision& decision) {
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
    result_.explanations = competition_.told(case_, contender(decision.chosen));
    chosen_rig_ = nominal_;
    if (decision.chosen != Chosen::nominal) fit_all_runs(contender(decision.chosen).fitted);
  }

  /// From where the training runs have led, and where starts did not agree from where others led.
  Fitted best_fit_of_all_runs(const Model& chosen) const {
    const FitSettings settings{.inflation = chosen_inflation_, .thorough = true};
    Fitted best = fit(experiment_, chosen, usable_, settings);
    for (const RigFile& end : other_ends_) {
      Fitted other = fit(experiment_, begun_at(chosen, end), usable_, settings);
      if (other.failure.empty() && (!best.failure.empty() || other.cost < best.cost)) best = std::move(other);
    }
    return best;
  }

  void tell_left_open(const Fitted& whole) {
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
  void fit_all_runs(const Fitted& chosen) {
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
    for (const auto& path : whole.model.refused)
      warn("no reading depends on " + path + ": it was not fitted");
  }

  /// How far the gap shrank, on the runs held out and run by run.
  void show_gap() {
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
        const auto [reading, unit] = told(which, data_.rig.pair() != nullptr);
        gap.beside.push_back({std::string(reading), std::string(unit), experiment_.floor().beside(which),
                              of(nominal), of(recalibrated), *error});
      }
    result_.start = look_at_start(experiment_, chosen_rig_, usable_);
    result_.remaining = remaining(experiment_, chosen_rig_, usable_, gap, settings_.seed);
    result_.runs =
        gaps_of_runs(experiment_, held_out, usable_, {nominal_, recalibrated_.fitted.model.rig, chosen_rig_});
  }

  bool is_open(const Doubt& doubt) const {
    if (!doubt.effect) return result_.verdict == Verdict::recalibrate;
    return std::ranges::find(result_.effects, *doubt.effect, &NamedEffect::who) != result_.effects.end();
  }

  // What would separate the effect named first from those it may be, or the next one; or the numbers that
  // were preferred from an effect.
  void plan_next() {
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

  void tell_verdict() {
    result_.ended = search_.ended();
    result_.time_limit_s = search_.limit_s();
    result_.not_done = search_.not_done();
    result_.because = because(result_);
    if (result_.verdict != Verdict::nothing_missing)
      result_.because += sentence_of(result_.remaining) + sentence_of(result_.start, result_.gap);
  }

  Settings settings_;
  const Step& step_;
  Search& search_;
  Checked checked_;
  domain::Dataset data_;
  Runs usable_;
  Experiment experiment_;
  RigFile nominal_;
  Competition competition_;
  Split whole_;
  Case case_;              ///< of the runs that the search asks
  Contender nominal_fit_;  ///< the rig as described, nothing moved
  Contender recalibrated_;
  std::vector<RigFile> other_ends_;  ///< of recalibrations that did not end alike
  Naming naming_;
  Law law_;
  Evidence evidence_;
  RigFile chosen_rig_;             ///< fitted to the training runs
  double chosen_inflation_ = 1.0;  ///< of its residuals over long times
  std::vector<Fault> faults_;
  bool confirmed_ = true;
  Diagnosis result_;
};

/// The workflow, again each time that faults of the recording have been mended, and of all runs where a few
/// have led to what does not hold of the others.
std::pair<Diagnosis, bool> mended(domain::Dataset data, const Settings& settings, const Step& step,
                                  Search& search) {
  step(stage("checking"));
  Checked checked = check(data, settings.threads);
  bool ask_all = false;
  for (int repairs = 0;;) {
    Workflow workflow(data, checked, settings, step, search, ask_all);
    Diagnosis result = workflow(repairs < thresholds.fault.most_repairs);
    if (!workflow.faults().empty()) {
      mend(data, checked, workflow.faults());
      ++repairs;
    } else if (!workflow.is_confirmed() && search.ended() == Ended::no) {
      ask_all = true;
    } else {
      return {std::move(result), workflow.reads_more()};
    }
  }
}

}  // namespace

Diagnosis diagnose(const domain::Dataset& data, const Settings& settings, const run::ProgressHook& progress) {
  std::size_t steps = 0;
  std::string without;
  Telling telling;
  const Step step = [&](const Doing& doing) { progress(without + telling(doing), ++steps, 0); };
  Search search(settings.time_limit_s);
  auto [result, gauged] = mended(data, settings, step, search);
  const double left = motion_left(result.gap);
  if (!gauged || !gauge_is_suspect(left, thresholds)) return result;
  if (search.ended() != Ended::no) {
    result.not_done.emplace_back("the same without the gauge, which no model meets together with the motion");
    return result;
  }
  // No model meets the gauge and the motion: perhaps one meets the motion alone.
  without = "without the gauge: ";
  Diagnosis ungauged = mended(without_besides(data), settings, step, search).first;
  if (!better_without_gauge(left, motion_left(ungauged.gap), ungauged.verdict, !ungauged.stand_ins.empty(),
                            thresholds))
    return result;
  ungauged.warnings.insert(ungauged.warnings.begin(), ignored_in_words(data));
  return ungauged;
}

}  // namespace mckibben::diagnose
