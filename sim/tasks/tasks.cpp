// See the header.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <sim/data/even_rows.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/parts.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/stamps.hpp>
#include <sim/data/warnings.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/identify/diagnosis.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/run/exchanged.hpp>
#include <sim/run/look.hpp>
#include <sim/tasks/tasks.hpp>
#include <sim/thesis/calibrate.hpp>

namespace mckibben::tasks {

domain::Dataset read_measured(const std::string& dataset, const std::string& rig,
                              void (*take)(domain::Dataset&, const std::string&, plant::Rig)) {
  domain::Dataset data;
  plant::Rig other;
  std::vector<domain::InputFile> files;
  input::read_together({{dataset, [&] { data = input::read_dataset(std::filesystem::path(dataset)); }},
                        {rig, [&] {
                           if (!rig.empty()) other = input::read_rig(rig, files);
                         }}});
  if (rig.empty()) return data;
  take(data, rig, std::move(other));
  data.inputs.insert(data.inputs.end(), files.begin(), files.end());
  return data;
}

void replace_rig(domain::Dataset& dataset, const std::string& called, plant::Rig rig) {
  const bool pair = dataset.rig.pair() != nullptr;
  if (!dataset.own_clock) input::require_load(rig, called, "a replay of data with a load");
  if ((rig.pair() != nullptr) != pair)
    throw input::BadInput({{input::Severity::error, called, input::nowhere,
                            pair ? "the data are of two muscles, this rig has one"
                                 : "the data are of one muscle, this rig has two",
                            ""}});
  input::take_rig(dataset, called, std::move(rig));
}

namespace {

/// What can hardly be; throws where it cannot.
std::vector<data::Finding> asked_of(const domain::Dataset& dataset) {
  std::vector<data::Finding> findings = run::asked_of(dataset);
  data::raise(dataset, findings);
  return findings;
}

std::vector<std::string> in_words(const domain::Dataset& dataset,
                                  const std::vector<data::Finding>& findings) {
  std::vector<std::string> warnings = dataset.remarks;
  for (const data::Finding& finding : findings) warnings.push_back(data::text_of(dataset, finding));
  return warnings;
}

}  // namespace

std::vector<std::string> asked_first(const domain::Dataset& dataset) {
  return in_words(dataset, asked_of(dataset));
}

std::vector<std::string> warnings_of(const domain::Dataset& dataset,
                                     const std::vector<run::ReplayedRun>& runs, bool* judged) {
  std::vector<std::string> warnings = asked_first(dataset);
  const bool fit = input::why_unfit(domain::Purpose::judging, dataset).empty();
  const bool looks = dataset.own_clock && !run::interrupted() && fit;
  std::vector<data::Finding> looked;
  if (looks)
    looked = run::look(dataset).findings;
  else if (!dataset.own_clock)
    looked = data::examine(dataset, run::expected_of(dataset, runs)).findings;
  data::raise(dataset, looked);
  if (judged != nullptr) *judged = fit && std::ranges::none_of(looked, data::is_error);
  if (!looks) {
    run::add_not_at_rest(dataset, runs, looked);
    run::add_far_off(dataset, runs, looked);
  }
  for (const auto& finding : looked)
    if (!data::only_limits_diagnosis(finding)) warnings.push_back(data::text_of(dataset, finding));
  for (const auto& run : runs)
    for (const auto& doubt : run::doubts(run.recording))
      warnings.push_back(data::warning_of_run(run.id, doubt));
  return dataset.own_clock ? data::grouped(std::move(warnings)) : warnings;
}

namespace {

/// What `check` says of the data, but for what is about a diagnosis. Throws what is wrong with them.
std::vector<std::string> checked(const domain::Dataset& data) {
  std::vector<data::Finding> found = asked_of(data);
  std::vector<data::Finding> looked = run::look(data).findings;
  std::erase_if(looked, data::only_limits_diagnosis);
  std::ranges::move(looked, std::back_inserter(found));
  data::raise(data, found);
  return data::grouped(in_words(data, found));
}

}  // namespace

domain::Dataset ticked(domain::Dataset data, const thesis::Orders& orders,
                       const std::function<void(const std::string&)>& say) {
  thesis::require_pressure_valve(data);
  const bool stamped = data.own_clock && input::why_unfit(domain::Purpose::calibration, data).empty();
  if (!stamped) input::require_ticks(data, "calibrate");
  thesis::require_enough_runs(data, orders);
  for (const std::string& warning : checked(data)) say("warning: " + warning);
  if (!stamped) return data;
  data = data::with_rows(std::move(data));
  const data::Spacing spacing = data::spacing_of(data);
  const double row_s = spacing.is_even() ? data.row_s() : spacing.row_s;
  if (!spacing.gaps.empty())
    throw data::UnfitData(
        data,
        {{.runs = spacing.gaps,
          .message = fmt::format("calibrate cannot take it: stamps are {:.6g} ms apart at {:.6g} s, others "
                                 "{:.6g} ms: leave that part out (from, to of the run)",
                                 1e3 * spacing.gap_s, spacing.gap_at_s, 1e3 * spacing.row_s)}});
  if (spacing.is_even()) {
    say(fmt::format("rows {:.6g} ms apart are made of the stamps", 1e3 * row_s));
  } else {
    data::make_even(data, row_s);
    say(
        fmt::format("stamps are {:.4g} to {:.4g} ms apart: rows {:.6g} ms apart are interpolated from them, "
                    "commands averaged",
                    1e3 * spacing.narrowest_s, 1e3 * spacing.widest_s, 1e3 * row_s));
  }
  data.rig.tick_s = row_s;
  return data;
}

namespace {

[[noreturn]] void refuse(const std::string& file, std::string message) {
  throw input::BadInput({{input::Severity::error, file, input::nowhere, std::move(message), ""}});
}

void add_hypotheses(const std::vector<std::string>& files, domain::Dataset& data) {
  for (const std::string& file : files) {
    auto law = input::read_hypothesis(file, data.inputs);
    law.values.front() = 0.0;  // whatever the file says: it is to be found
    diagnose::each_side(data.rig, [&](plant::Effects& effects) {
      auto& list = effects.laws.list;
      const auto same = [&](const auto& other) { return other.text->name == law.text->name; };
      if (std::ranges::any_of(list, same))
        refuse(file, fmt::format("the rig has a law {} already", law.text->name));
      if (list.size() == plant::most_written_laws)
        refuse(file, fmt::format("a rig has at most {} laws", plant::most_written_laws));
      list.push_back(law);
    });
  }
}

}  // namespace

Prepared prepare(domain::Dataset& data, const std::vector<std::string>& hypotheses,
                 const std::function<void(const std::vector<std::string>&)>& say) {
  add_hypotheses(hypotheses, data);
  std::vector<data::Finding> asked = asked_of(data);
  Prepared prepared{in_words(data, asked)};
  std::vector<std::string>& warnings = prepared.warnings;
  input::require_judged(data, "diagnose");
  for (const data::Finding& finding : data::mend_at_stamps(data))
    warnings.push_back(data::text_of(data, finding).append(data::consequence_of(finding)));
  data = data::with_rows(std::move(data));
  const std::vector<data::Finding> looked = run::look(data).findings;
  asked.insert(asked.end(), looked.begin(), looked.end());
  data::raise_for_diagnosis(data, asked);
  data = data::in_parts(std::move(data));
  if (data.parts_of_a_run)
    warnings.push_back(fmt::format("one run: parts of it, {} to {}, are each predicted from the others",
                                   data.runs.front().id, data.runs.back().id));
  std::vector<std::string> at_once = warnings;  // the diagnosis says the rest of it again, with what it did
  for (data::Finding finding : looked) {
    if (finding.quantity == "load") {
      identify::LoadDoubt doubt{{}, data::text_of(data, finding)};
      for (const std::size_t run : finding.runs) doubt.runs.push_back(data.runs[run].id);
      prepared.of_loads.push_back(std::move(doubt));
      finding.message =
          "the load does not fit the motion (`check` says more); the diagnosis looks for it with the rest";
    }
    at_once.push_back(data::text_of(data, finding));
  }
  say(data::grouped(std::move(at_once)));
  return prepared;
}

Found find(const domain::Dataset& data, const Diagnosing& how, const run::ProgressHook& progress) {
  std::size_t steps = 0;
  const identify::Settings settings{.threads = how.threads,
                                    .trying = [&](const std::string& what) { progress(what, ++steps, 0); },
                                    .time_limit_s = how.time_limit_s,
                                    .known = how.known};
  identify::Identified identified = identify::identify(data, settings);
  Found found{
      identify::diagnosis_of(identified, settings, {how.seed, how.prepared.warnings, how.prepared.of_loads}),
      {},
      {},
      std::move(identified.simulated)};
  found.nominal = run::replay(data, how.threads, progress);
  domain::Dataset mended = data;
  mended.rig = found.diagnosis.corrected;
  for (std::size_t i = 0; i < mended.runs.size(); ++i)
    mended.runs[i].load_kg = found.diagnosis.runs[i].estimated_load_kg.value_or(mended.runs[i].load_kg);
  found.corrected = run::replay(mended, how.threads, progress);
  return found;
}

}  // namespace mckibben::tasks
