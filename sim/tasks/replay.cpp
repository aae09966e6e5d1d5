// See the header.
#include <utility>

#include <sim/data/warnings.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/run/look.hpp>
#include <sim/tasks/replay.hpp>

namespace mckibben::tasks {
void replace_rig(domain::Dataset& dataset, const std::string& called, plant::Rig rig) {
  const bool pair = dataset.rig.pair() != nullptr;
  if (!dataset.own_clock) input::require_load(rig, called, "a replay of data with a load");
  if ((rig.pair() != nullptr) != pair)
    throw input::BadInput({{input::Severity::error, called, input::nowhere,
                            pair ? "the data are of two muscles, this rig has one"
                                 : "the data are of one muscle, this rig has two",
                            ""}});
  dataset.rig = std::move(rig);
}

std::vector<std::string> warnings_of(const domain::Dataset& dataset,
                                     const std::vector<run::ReplayedRun>& runs) {
  std::vector<data::Finding> findings;
  if (!dataset.own_clock)
    findings = data::examine(dataset, run::expected_of(dataset, runs)).findings;
  else if (input::why_unfit(domain::Purpose::judging, dataset).empty() && !run::interrupted())
    findings = run::look(dataset).findings;
  data::raise(dataset, findings);
  std::vector<std::string> warnings;
  for (const auto& finding : findings)
    if (!data::only_limits_diagnosis(finding)) warnings.push_back(data::text_of(dataset, finding));
  for (const auto& run : runs)
    for (const auto& doubt : run::doubts(run.recording))
      warnings.push_back(data::warning_of_run(run.id, doubt));
  return dataset.own_clock ? data::grouped(std::move(warnings)) : warnings;
}

}  // namespace mckibben::tasks
