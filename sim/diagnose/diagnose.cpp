// The workflow as often as it takes: with faults mended, with all runs asked, without the gauge. See the
// header and docs/diagnosis.md.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <sim/diagnose/check.hpp>
#include <sim/diagnose/decide.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/diagnose/remarks.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/diagnose/search.hpp>
#include <sim/diagnose/telling.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/workflow.hpp>

namespace mckibben::diagnose {
namespace {

/// With what is judged alone.
domain::Dataset without_besides(domain::Dataset data) {
  for (domain::Run& run : data.runs) {
    for (const domain::Beside which : domain::besides)
      if (which != domain::Beside::force) run.gauge(which).reset();
    if (run.kind_of_judged() != Judged::force) run.force_N.clear();
  }
  return data;
}

/// What the motion alone has left on the runs held out: mean square above the floor's.
double motion_left(const Gap& gap) {
  return std::pow(gap.corrected_rmse / gap.noise_floor, 2) - 1.0;
}

/// Runs left out for what other runs say of them, but which the corrected rig meets: fits on the way had not
/// arrived, and the fault is none.
Runs met_after_all(const Checked& as_recorded, const Checked& checked, const Diagnosis& result) {
  Runs blamed = as_recorded.contradicted, met;
  if (result.runs.empty()) return {};  // the data are of no use
  std::ranges::set_difference(checked.left_out, as_recorded.left_out, std::back_inserter(blamed));
  const double near = thresholds.near.floors * result.gap.noise_floor;
  for (const std::size_t run : blamed)
    if (!checked.is_sound(run) && result.runs[run].corrected_rmse <= near) met.push_back(run);
  return met;
}

/// The workflow, again each time that faults of the recording have been mended, or turn out to be none, and
/// of all runs where a few have led to what does not hold of the others.
std::pair<Diagnosis, bool> mended(const domain::Dataset& recorded, const Settings& settings, const Step& step,
                                  Search& search) {
  step(stage("checking"));
  Checked as_recorded = check(recorded, settings.threads);
  domain::Dataset data = recorded;
  Checked checked = as_recorded;
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
      Runs met;
      if (search.ended() == Ended::no) met = met_after_all(as_recorded, checked, result);
      if (met.empty()) return {std::move(result), workflow.reads_more()};
      std::ranges::copy(as_recorded.sound, std::back_inserter(met));
      as_recorded = check(recorded, settings.threads, std::move(met));
      data = recorded;
      checked = as_recorded;
      repairs = 0;
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
