// The workflow as often as it takes: with faults mended, with all runs asked, without the gauge. See the
// header and docs/diagnosis.md.
#include <cmath>
#include <cstddef>
#include <string>
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
    run.muscle_pressure_Pa.reset();
    run.opposite_pressure_Pa.reset();
    if (run.kind_of_judged() != Judged::force) run.force_N.clear();
  }
  return data;
}

/// What the motion alone has left on the runs held out: mean square above the floor's.
double motion_left(const Gap& gap) {
  return std::pow(gap.corrected_rmse / gap.noise_floor, 2) - 1.0;
}

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
