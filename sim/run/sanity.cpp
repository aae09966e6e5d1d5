// See the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/input/yaml_file.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/column_sanity.hpp>
#include <sim/run/load_sanity.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/sanity.hpp>

namespace mckibben::run {
namespace {

/// So much is simulated in a few seconds: the thesis's campaign.
constexpr std::size_t most_rows = 200'000, most_rows_of_a_run = 20'000;

using input::Node;

/// What is to be changed: the quantity where its map or load is said, otherwise the run, or the first line.
input::Place place_of(const input::YamlFile& file, const Finding& finding) {
  const Node& run = file.root.find("runs")->children.at(finding.runs.front());
  for (const Node* from : {&run, static_cast<const Node*>(&file.root)}) {
    const Node* columns = from->find("columns");
    const Node* node = finding.quantity == "load" ? from->find("load")
                       : columns != nullptr       ? columns->find(finding.quantity)
                                                  : nullptr;
    if (node != nullptr) return node->place;
  }
  return run.place;
}

domain::Run beginning_of(domain::Run run, std::size_t rows) {
  rows = std::min(rows, run.current_mA.size());
  run.current_mA.resize(rows);
  run.contraction_ratio.resize(rows);
  if (run.muscle_pressure_Pa) run.muscle_pressure_Pa->resize(rows);
  return run;
}

}  // namespace

std::vector<Finding> sanity(const domain::Dataset& data, const std::vector<Expected>& expected) {
  std::vector<Finding> findings;
  check_columns(data, expected, findings);
  // The wrong numbers would weigh wrong.
  if (findings.empty()) check_loads(data, expected, findings);
  return findings;
}

std::vector<Expected> expected_of(const std::vector<ReplayedRun>& replayed) {
  std::vector<Expected> list(replayed.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const Sample& sample : replayed[i].recording.samples) {
      list[i].contraction_ratio.push_back(sample.state.joint.contraction_ratio);
      list[i].pressure_Pa.push_back(sample.state.side.muscle_pressure_Pa);
    }
  }
  return list;
}

Look look(const domain::Dataset& data) {
  std::size_t rows = 0;
  for (const domain::Run& run : data.runs) rows += std::min(run.current_mA.size(), most_rows_of_a_run);
  const std::size_t step = rows / most_rows + 1;
  domain::Dataset some;
  some.rig = data.rig;
  some.columns = data.columns;
  for (std::size_t i = 0; i < data.runs.size(); i += step)
    some.runs.push_back(beginning_of(data.runs[i], most_rows_of_a_run));
  const auto replayed = replay(some, 0, [](const auto&, auto, auto) {});
  if (interrupted()) throw Interrupted();
  Look result{sanity(some, expected_of(replayed)), some.runs.size()};
  for (Finding& finding : result.findings)
    for (std::size_t& run : finding.runs) run *= step;
  return result;
}

std::string text_of(const domain::Dataset& data, const Finding& finding) {
  const std::size_t count = finding.runs.size();
  if (count == data.runs.size() && count > 1) return "all runs: " + finding.message;
  constexpr std::size_t most_shown = 9;
  std::string ids;
  for (std::size_t i = 0; i < std::min(count, most_shown); ++i)
    ids += (i > 0 ? ", " : "") + data.runs[finding.runs[i]].id;
  if (count > most_shown) ids += fmt::format(" and {} more", count - most_shown);
  return fmt::format("run{} {}: {}", count > 1 ? "s" : "", ids, finding.message);
}

std::vector<input::Problem> problems_of(const domain::Dataset& data, const std::vector<Finding>& findings) {
  if (findings.empty()) return {};
  input::Problems problems;
  const auto tell = [&](const input::Source& source, input::Place place, const Finding& finding) {
    const std::string text = text_of(data, finding);
    if (finding.certain)
      problems.error(source, place, text);
    else
      problems.warning(source, place, text);
  };
  try {
    const input::YamlFile file = input::load_yaml(data.path);
    for (const Finding& finding : findings) tell(file.source, place_of(file, finding), finding);
  } catch (const input::MissingInput&) {  // a data set that was made and not read
    for (const Finding& finding : findings) tell({data.path.string(), "", {}}, input::nowhere, finding);
  }
  return problems.sorted();
}

void raise(const domain::Dataset& data, const std::vector<Finding>& findings) {
  if (std::any_of(findings.begin(), findings.end(), [](const Finding& one) { return one.certain; }))
    throw input::BadInput(problems_of(data, findings));
}

}  // namespace mckibben::run
