// See the header.
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/examine.hpp>
#include <sim/data/warnings.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/remaining.hpp>
#include <sim/diagnose/remarks.hpp>
#include <sim/diagnose/start.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/visited.hpp>
#include <sim/diagnose/where.hpp>
#include <sim/identify/bench.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/diagnosis.hpp>
#include <sim/identify/estimates.hpp>
#include <sim/identify/gaps.hpp>
#include <sim/identify/mended.hpp>
#include <sim/identify/next.hpp>
#include <sim/identify/rivals.hpp>
#include <sim/identify/visible.hpp>

namespace mckibben::identify {

using diagnose::Diagnosis, diagnose::Experiment;

namespace {

class HandingOver {
 public:
  HandingOver(const Identified& found, const Settings& settings, const Reporting& reporting)
      : found_(found),
        settings_(settings),
        reporting_(reporting),
        data_(found.study->data),
        usable_(found.study->usable),
        left_(unpredicted_by_all(found)),
        experiment_(data_, usable_.masked, settings.threads, usable_.runs) {
    for (const Eigen::VectorXd& one : left_) rms_.push_back(found.study->rows.rms(one));
  }

  Diagnosis operator()() {
    result_.seed = reporting_.seed;
    result_.described = data_.rig;
    result_.false_alarm_rate = diagnose::thresholds.tell.false_alarm_rate;
    report_data();
    result_.verdict = verdict();
    result_.contradicts_sheet = found_.decision.contradicts_sheet;
    const std::size_t handed = handed_over();
    report_model(handed);
    report_loads();
    result_.explanations = explanations(found_, rms_);
    result_.ranking = ranking(found_, rms_);
    step("where model and data disagree");
    report_gap(handed);
    plan_next();
    report_verdict();
    return std::move(result_);
  }

 private:
  void step(const std::string& what) const {
    if (settings_.trying) settings_.trying(what);
  }
  void warn(std::string what) { result_.warnings.push_back(std::move(what)); }
  const Scored& chosen() const { return found_.table[found_.decision.chosen]; }

  void report_data() {
    result_.warnings = reporting_.warnings;
    for (std::string& what : data::grouped(usable_.warnings)) warn(std::move(what));
    result_.faults = usable_.faulty;
    const diagnose::NoiseFloor& floor = experiment_.floor();
    for (const std::string& what : diagnose::noise_in_words(data_, floor)) warn(what);
    for (const std::string& what : diagnose::sheets_in_words(data_, floor)) warn(what);
    for (const std::string& what : diagnose::rows_in_words(data_, floor)) warn(what);
    if (diagnose::carries(data_.rig, plant::ResidualForce::name))
      warn("the rig's residual_law is kept as it is: if it is wrong, take it out");
  }

  /// Names that predict unseen runs better than general terms do alone, and close most of the gap that the
  /// parameters leave, where both together explain the data: the terms are something else that is missing.
  bool names_hold() const {
    if (!found_.chosen().has_effects()) return false;
    Point without_terms = found_.chosen().point;
    without_terms.terms = Terms::none;
    const auto names = found_.study->dictionary.names(without_terms);
    std::optional<std::size_t> named, terms;
    for (std::size_t i = 0; i < found_.table.size(); ++i) {
      const Scored& one = found_.table[i];
      if (!one.general && one.names == names) named = i;
      if (one.general && !found_.models[i].has_effects() &&
          (!terms || one.score > found_.table[*terms].score))
        terms = i;
    }
    if (!named) return false;
    if (terms) {  // else none that was not far off
      const auto [nats, error] = loss(found_.table[*named].held_out, found_.table[*terms].held_out);
      if (!(nats > std::max(decisive.errors * error, decisive.strong))) return false;
    }
    const auto gap = [&](std::size_t i) {  // of what the parameters leave
      const Three all = three(i);
      return gap_of(found_,
                    {all.recalibrated, all.recalibrated, all.corrected, all.by_recalibrated,
                     all.by_recalibrated, all.by_corrected},
                    experiment_.floor());
    };
    return gap(*named).closed >= diagnose::thresholds.tell.closed &&
           gap(found_.decision.chosen).floors_left() <= diagnose::thresholds.start.explained_floors;
  }

  /// Faults of the bench are no effects of the rig: the verdict is about the rig without them.
  Verdict of_the_rig(Verdict decided) const {
    if (decided == Verdict::unknown_effect && names_hold()) return Verdict::missing_effect;
    const Model& model = found_.chosen();
    if (decided != Verdict::missing_effect || model.has_effects()) return decided;
    return (model.point.z.cwiseAbs().array() > diagnose::thresholds.parameter.notable).any()
               ? Verdict::recalibrate
               : Verdict::nothing_missing;
  }

  /// What the decision says, as far as the data and a search that was ended allow.
  Verdict verdict() {
    Verdict said = usable_.cannot_tell.empty() ? verdict_of_search() : Verdict::cannot_tell;
    result_.cannot_tell = usable_.cannot_tell;
    const bool finds_no_effect = said == Verdict::nothing_missing || said == Verdict::recalibrate;
    if (finds_no_effect && data_.parts_of_a_run) {  // one run shows an effect, but does not rule one out
      said = Verdict::cannot_tell;
      result_.cannot_tell = "No effect was found, but one run is too little to rule one out; " +
                            data::runs_that_would_help(data_) + ".";
    }
    if (!result_.cannot_tell.empty()) result_.to_measure = data::runs_that_would_help(data_);
    return said;
  }

  /// The most probable model with nothing but the rig's parameters and faults of the bench; null: none.
  const Model* without_effects() const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < found_.table.size(); ++i) {
      const Scored& one = found_.table[i];
      if (!one.described && !one.general && !found_.models[i].has_effects() &&
          (!best || one.score > found_.table[*best].score))
        best = i;
    }
    return best ? &found_.models[*best] : nullptr;
  }

  /// Whether the chosen model leaves more than noise, and more of the gap than an answer may.
  bool leaves_the_gap() const {
    return !found_.chosen().error.explains() &&
           gap_of(found_, three(found_.decision.chosen), experiment_.floor()).closed <
               diagnose::thresholds.tell.closed;
  }

  Verdict verdict_of_search() {
    const Verdict decided = of_the_rig(found_.decision.verdict);
    if (found_.ended != Ended::no && decided != Verdict::missing_effect) return Verdict::cannot_tell;
    const Model* parameters = without_effects();
    if (leaves_the_gap()) {
      // Parameters that leave the gap are no answer, nor are effects that need what the sheet forbids.
      if (decided == Verdict::recalibrate)
        return found_.table[found_.decision.best].general ? Verdict::unknown_effect : Verdict::cannot_tell;
      if (decided == Verdict::missing_effect && found_.decision.contradicts_sheet)
        return Verdict::unknown_effect;
    }
    if (decided != Verdict::nothing_missing) return decided;
    // The rig as described may be chosen for being as good at unseen runs: the parameters say what it leaves.
    if (!found_.chosen().error.explains() && (parameters == nullptr || !parameters->error.explains()))
      return Verdict::cannot_tell;
    if (parameters == nullptr) return decided;
    step("what of the catalogue these data would show");
    const Visible seen = visible(*parameters);
    if (seen.hidden.empty()) return decided;
    warn(
        fmt::format("these data would not show, even at their usual size: {}", fmt::join(seen.hidden, ", ")));
    const double most = diagnose::thresholds.tell.invisible * static_cast<double>(seen.all);
    if (static_cast<double>(seen.hidden.size()) <= most) return decided;
    result_.to_measure = "runs of other kinds would help: other loads, and faster, slower and larger inputs";
    return Verdict::cannot_tell;
  }

  /// The model whose rig is handed over: the chosen one, or one that a rig file can carry; the rig's
  /// parameters where nothing is decided and they predict better.
  std::size_t handed_over() {
    std::size_t handed = found_.decision.chosen;
    const auto rig_can_carry = [&](std::size_t i) { return found_.models[i].point.terms != Terms::rubs; };
    const auto predicts_better = [&](std::size_t i) {
      return !rig_can_carry(handed) || found_.table[i].held_out.sum() > found_.table[handed].held_out.sum();
    };
    if (!rig_can_carry(handed)) {
      warn(
          "what is left acts like friction that depends on the place along the stroke: no rig file can "
          "carry that");
      for (std::size_t i = 0; i < found_.table.size(); ++i)
        if (rig_can_carry(i) && predicts_better(i)) handed = i;
    }
    const bool decided =
        result_.verdict != Verdict::cannot_tell && result_.verdict != Verdict::unknown_effect;
    for (std::size_t i = 0; i < found_.table.size() && !decided; ++i)
      if (found_.table[i].names.empty() && rig_can_carry(i) && rms_[i] < rms_[handed]) handed = i;
    return handed;
  }

  void report_model(std::size_t handed) {
    const Model& found = found_.models[handed];
    Estimates estimates = estimates_of(found);
    result_.bench = bench_faults(found, estimates);
    if (found.point.lets_differ(loads) && found.point.terms == Terms::none) {
      step("fitting with the loads as they are reported");
      mended_.emplace(with_reported_loads(found, result_.bench));
      if (mended_->read.allFinite())
        estimates = estimates_of(*mended_);
      else
        mended_.reset();
    }
    const Model& model = mended_ ? *mended_ : found;
    result_.corrected = estimates.rig;
    result_.recalibrated = std::move(estimates.moved);
    result_.left_open = std::move(estimates.left_open);
    result_.residual_law = std::move(estimates.law);
    if (!result_.residual_law.empty()) result_.law_valid_for = diagnose::visited(data_, usable_.runs);
    if (result_.verdict == Verdict::missing_effect) {
      result_.effects = std::move(estimates.effects);
      support(found_, result_.effects);
    } else {  // names beside general terms, or of an open search, are no findings
      result_.stand_ins = std::move(estimates.effects);
      for (diagnose::NamedEffect& one : result_.stand_ins) one.stands_in = true;
    }
    if (const Model* parameters = found_.of(false))
      for (std::size_t j = 0; j < result_.recalibrated.size(); ++j)
        result_.absorbed.push_back({result_.recalibrated[j].fitted.name,
                                    parameters->point.z[static_cast<Eigen::Index>(j)],
                                    model.point.z[static_cast<Eigen::Index>(j)]});
    const auto unknown = [&](const std::string& path) {
      const auto stated = data_.rig.spreads.find(path);
      return stated != data_.rig.spreads.end() && !std::isfinite(stated->second);
    };
    for (const diagnose::LeftOpen& open : result_.left_open)
      if (std::ranges::any_of(open.parameters, unknown)) warn("not determined by these data: " + open.words);
  }

  /// An estimate replaces what was guessed before. What asks for a label to be mended comes first.
  void report_loads() {
    const auto offset = std::ranges::find(result_.recalibrated, "joint.load_offset",
                                          [](const diagnose::Moved& one) { return one.fitted.name; });
    if (offset != result_.recalibrated.end() && offset->notable()) return;
    const auto estimated = [&](const std::string& run) {
      return std::ranges::any_of(result_.bench, [&](const diagnose::BenchFault& fault) {
        return fault.of_loads() &&
               (data_.parts_of_a_run || std::ranges::find(fault.runs, run) != fault.runs.end());
      });
    };
    std::vector<std::string> doubts;
    for (const LoadDoubt& doubt : reporting_.of_loads)
      if (std::ranges::none_of(doubt.runs, estimated)) doubts.push_back(doubt.words);
    result_.warnings.insert(result_.warnings.begin(), doubts.begin(), doubts.end());
  }

  /// The rig as described, its parameters alone, and the one that is handed over.
  Three three(std::size_t handed) const {
    const auto place = [&](bool described) {
      for (std::size_t i = 0; i < found_.table.size(); ++i)
        if (found_.table[i].names.empty() && found_.table[i].described == described) return i;
      return handed;  // ended before there was one
    };
    const std::size_t nominal = place(true),
                      recalibrated = found_.of(false) != nullptr ? place(false) : nominal;
    return {found_.models[nominal], found_.models[recalibrated], found_.models[handed],
            left_[nominal],         left_[recalibrated],         left_[handed]};
  }

  void report_gap(std::size_t handed) {
    const Three all = three(handed);
    result_.gap = gap_of(found_, all, experiment_.floor());
    for (const diagnose::BesideGap& one : result_.gap.beside)
      if (one.corrected_rmse > diagnose::thresholds.start.explained_floors * one.noise_floor)
        warn(fmt::format(
            "{} is not met: {:.3g} {} off, where its noise is {:.3g} {}; no model that was tried meets "
            "both it and the {}. Is it this muscle's, and near it?",
            one.reading, one.corrected_rmse, one.unit, one.noise_floor, one.unit,
            plant::name_of(result_.gap.judged)));
    result_.runs = gaps_of_runs(found_, all, experiment_);
    const auto rig_of = [](const Model& model) { return model.problem->dictionary.setting(model.point).rig; };
    result_.where =
        diagnose::where(experiment_, rig_of(result_.gap.nominal_is_nearer() ? all.nominal : all.recalibrated),
                        usable_.runs, reporting_.seed);
    const domain::Dataset mended = without_faults(mended_ ? *mended_ : found_.models[handed]);
    for (const diagnose::BenchFault& fault : result_.bench)
      for (std::size_t i = 0; i < fault.loads_kg.size(); ++i)
        std::ranges::find(result_.runs, fault.runs[i], &diagnose::RunGap::id)->estimated_load_kg =
            fault.loads_kg[i];
    const Experiment of_mended(mended, usable_.masked, settings_.threads, usable_.runs);
    result_.start = look_at_start(of_mended, result_.corrected, usable_.runs);
    if (!found_.models[handed].point.differ.empty())
      result_.gap.mended_rmse =
          std::min(result_.gap.corrected_rmse, result_.start.floors_left * of_mended.floor().judged);
    result_.remaining = remaining(of_mended, result_.corrected, usable_.runs, result_.gap, reporting_.seed);
  }

  /// Every valve by currents that are known.
  bool is_commanded() const {
    if (data_.rig.pair() == nullptr) return !data_.runs.front().current_mA.empty();
    return std::ranges::all_of(data_.runs, [](const domain::Run& run) {
      return run.measured->gives("command", 1) && run.measured->gives("command", 2);
    });
  }

  /// What would separate the chosen model from the best that does as well.
  void plan_next() {
    const domain::Judged judged = data_.judged();
    if (!is_commanded() || data_.rig.holds_a_length() ||
        (judged != domain::Judged::contraction && judged != domain::Judged::angle))
      return;
    const Model* rival = doubt(found_);
    if (rival == nullptr || chosen().general || found_.ended != Ended::no) return;
    step("planning the next measurement");
    const auto words = [&](const Model& model) {
      const auto names = model.problem->dictionary.names(model.point);
      return names.empty() ? std::string("other parameters") : fmt::format("{}", fmt::join(names, " with "));
    };
    const std::vector<std::string> both{words(found_.chosen()), words(*rival)};
    result_.next_experiment = next_measurement(found_.chosen(), *rival, both, settings_.threads);
    if (!result_.next_experiment)
      result_.next_sensor = next_sensor(found_.chosen(), *rival, both, settings_.threads);
  }

  void report_verdict() {
    result_.ended = found_.ended;
    result_.time_limit_s = settings_.time_limit_s;
    result_.not_done = found_.not_done;
    result_.because = because(result_);
    if (result_.verdict != Verdict::nothing_missing)
      result_.because +=
          sentence_of(result_.remaining) + sentence_of(result_.start, result_.gap, data_.recorded.start);
  }

  const Identified& found_;
  const Settings& settings_;
  const Reporting& reporting_;
  const domain::Dataset& data_;
  const Usable& usable_;
  std::vector<Eigen::VectorXd> left_;  ///< by each model of the table, where runs are held out
  std::vector<double> rms_;
  Experiment experiment_;
  std::optional<Model> mended_;  ///< what is handed over where loads differ
  Diagnosis result_;
};

}  // namespace

Diagnosis diagnosis_of(const Identified& found, const Settings& settings, const Reporting& reporting) {
  return HandingOver(found, settings, reporting)();
}

}  // namespace mckibben::identify
