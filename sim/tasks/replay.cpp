// See the header.
#include <utility>

#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/run/judged.hpp>
#include <sim/run/sanity.hpp>
#include <sim/run/warnings.hpp>
#include <sim/tasks/replay.hpp>

namespace mckibben::tasks {
namespace {

template <class Runs>
std::vector<std::string> warnings_of(const domain::Dataset& dataset,
                                     const std::vector<domain::Objection>& objections, const Runs& runs) {
  run::raise(dataset, objections);
  std::vector<std::string> warnings;
  warnings.reserve(objections.size());
  for (const auto& objection : objections) warnings.push_back(domain::text_of(dataset, objection));
  for (const auto& run : runs)
    for (const auto& doubt : run::doubts(run.recording))
      warnings.push_back(run::warning_of_run(run.id, doubt));
  return warnings;
}

}  // namespace

void replace_rig(domain::Dataset& dataset, const std::string& called, domain::RigFile rig) {
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
  return warnings_of(dataset, run::sanity(dataset, run::expected_of(runs)), runs);
}

std::vector<std::string> warnings_of(const domain::Dataset& dataset,
                                     const std::vector<run::StampedRun>& runs) {
  std::vector<domain::Objection> objections;
  if (input::has_one_load(dataset) && !run::interrupted())
    objections = run::look(run::with_rows(dataset)).objections;
  return run::grouped(warnings_of(dataset, objections, runs));
}

}  // namespace mckibben::tasks
