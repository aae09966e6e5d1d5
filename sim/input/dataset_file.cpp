// Reading of data sets; see the header.
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <sim/input/column_units.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/run_file.hpp>
#include <sim/input/stamped_run.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

/// Whether a load hangs on the muscle of a run.
bool hangs(const Dataset& dataset, const Run& run) {
  return dataset.rig.lifts_a_load() &&
         merged(dataset.columns, run.columns).contraction.as != domain::Role::input;
}

void check_runs(const YamlFile& file, const Dataset& dataset, Problems& problems) {
  const Node& list = *file.root.find("runs");
  if (dataset.runs.empty()) problems.error(file.source, list.place, "runs: at least one run is needed");
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const std::string& id = dataset.runs[i].id;
    const Place place = list.children[i].find("id")->place;
    const auto [earlier, is_new] = first.try_emplace(id, list.children[i].place.line);
    if (!is_file_safe(id))
      problems.error(file.source, place, fmt::format("id = {}: {}", shortened(id), file_safe_rule));
    else if (!is_new)
      problems.error(file.source, place,
                     fmt::format("id = {} is already that of the run in line {}", id, earlier->second));
    const Node* load = list.children[i].find("load");
    if (load == nullptr) continue;
    if (!hangs(dataset, dataset.runs[i]))
      problems.error(
          file.source, load->place,
          fmt::format("load = {}: {}", load->text,
                      dataset.rig.pair() != nullptr ? "the rig's two muscles turn a link; nothing hangs there"
                                                    : "the muscle's length is given; nothing hangs there"));
    else if (const auto why = too_heavy(dataset.runs[i].load_kg, dataset.rig); !why.empty())
      problems.error(file.source, load->place, fmt::format("load = {}: {}", load->text, why));
    else if (dataset.runs[i].load_kg + dataset.rig.joint.load_offset_kg <= 0.0 && dataset.own_clock)
      problems.error(file.source, load->place,
                     fmt::format("load = {}: it and the rig's joint.load_offset leave no load", load->text));
  }
}

/// Settled points say themselves what went before, and what inputs do.
void check_points(const YamlFile& file, const Dataset& dataset, const Run& run, Problems& problems) {
  if (merged(dataset.columns, run.columns).settled.absent()) return;
  if (dataset.recorded.start == domain::Start::moving)
    problems.error(file.source, file.root.find("start")->place,
                   fmt::format("start = moving: the rows of run {} are settled points", shortened(run.id)));
  if (dataset.recorded.hold != domain::Hold::usual)
    problems.error(file.source, file.root.find("hold")->place,
                   fmt::format("hold: the rows of run {} are settled points: commands hold while a point is "
                               "measured, pressures and lengths are there after half of it at most",
                               shortened(run.id)));
}

/// Loads as they were given, and a clock. A run without a load is a problem, if one must hang there.
void check_kind(const YamlFile& file, Dataset& dataset, Problems& problems) {
  const Node* list = file.root.find("runs");
  for (const char* key : {"start", "skip", "hold"})
    dataset.own_clock = dataset.own_clock || file.root.find(key) != nullptr;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    Run& run = dataset.runs[i];
    run.load_kg = run.given_load_kg.value_or(0.0);
    dataset.own_clock = dataset.own_clock || has_own_clock(merged(dataset.columns, run.columns), dataset.rig);
    const Node& node = list->children[i];
    const bool has_load = hangs(dataset, run);
    check_points(file, dataset, run, problems);
    if (dataset.recorded.hold == domain::Hold::previous &&
        merged(dataset.columns, run.columns).contraction.as == domain::Role::input)
      problems.error(
          file.source, file.root.find("hold")->place,
          fmt::format("hold = previous: the length of run {} is given, and cannot jump", shortened(run.id)));
    if (node.kind == Node::Kind::map && node.find("load") == nullptr && has_load)
      problems.error(file.source, node.place, "the key load is missing");
    if (dataset.recorded.start == domain::Start::moving && !has_load)
      problems.error(file.source, file.root.find("start")->place,
                     fmt::format("start = moving: run {} has no load that hangs; only of such a run can the "
                                 "first state be told",
                                 shortened(run.id)));
  }
}

/// False if a unit is wrong: the numbers would be, too.
bool check_columns(const YamlFile& file, Problems& problems) {
  const std::size_t before = problems.errors();
  if (const Node* shared = file.root.find("columns")) check_units(file.source, *shared, problems);
  for (const Node& run : file.root.find("runs")->children)
    if (const Node* own = run.find("columns")) check_units(file.source, *own, problems);
  return problems.errors() == before;
}

}  // namespace

Dataset read_dataset(const fs::path& path) {
  std::error_code ignored;
  const fs::path file = fs::is_directory(path, ignored) ? path / "dataset.yaml" : path;
  return read_dataset(Source::load(file, largest_yaml_bytes));
}

Dataset read_dataset(Source source) {
  Dataset dataset;
  const YamlFile file = parse_yaml(std::move(source));
  dataset.path = file.source.name();
  Problems problems;
  problems.opened(file.source);
  problems.adopt(file.found);
  constexpr std::string_view also_allowed[] = {"schema"};
  if (check_schema(file, dataset_schema, problems))
    read_struct(file.source, file.root, dataset, problems, also_allowed);
  check_kind(file, dataset, problems);
  if (problems.errors() == 0) {
    check_runs(file, dataset, problems);
    if (check_columns(file, problems))
      for (std::size_t i = 0; i < dataset.runs.size(); ++i)
        read_run_file(file, file.root.find("runs")->children[i], dataset, dataset.runs[i], problems);
  }
  problems.raise();
  dataset.inputs = problems.inputs();
  return dataset;
}

void require_ticks(const Dataset& dataset, std::string_view verb) {
  require_load(dataset.rig, dataset.path.string(), verb);
  if (dataset.own_clock)
    throw BadInput(
        {{Severity::error, dataset.path.string(), nowhere,
          fmt::format("{} cannot take it yet: its runs have a clock of their own, not a row each tick; "
                      "replay does",
                      verb),
          ""}});
}

namespace {

/// Why a run is none of a hanging load whose contraction was read; empty if it is one.
std::string_view why_not_one_load(const Run& run) {
  if (!run.measured) return "";
  if (run.measured->length_is_given) return "the muscle's length is given, and in others it is not";
  return run.measured->contraction_ratio.empty() ? "contraction is not read" : "";
}

/// Why a run at a given length has nothing to be judged by; empty if it has.
std::string_view why_no_bench(const Run& run) {
  const auto& read = run.measured->force_N;
  const bool none = std::ranges::all_of(read, [](double force_N) { return std::isnan(force_N); });
  return none ? "the muscle's length is given, and force is not read" : "";
}

/// Why a run of a pair has nothing to be judged by, or is driven in two ways; empty if neither.
std::string_view why_no_pair(const Run& run) {
  if (!run.measured) return "angle is not read";
  const auto& read = run.measured->angle_rad;
  if (std::ranges::all_of(read, [](double angle_rad) { return std::isnan(angle_rad); }))
    return "angle is not read";
  const auto& [one, two] = run.measured->sides;
  return one.pressure_is_given == two.pressure_is_given
             ? ""
             : "the pressure of one muscle is given, and that of the other is not";
}

/// The same of any run.
std::string_view why_not(const Dataset& dataset, const Run& run) {
  switch (dataset.judged()) {
    case domain::Judged::angle:
      return why_no_pair(run);
    case domain::Judged::force:
      return why_no_bench(run);
    case domain::Judged::contraction:
      break;
  }
  return why_not_one_load(run);
}

}  // namespace

bool has_one_load(const Dataset& dataset) {
  return dataset.rig.lifts_a_load() &&
         std::ranges::all_of(dataset.runs, [](const Run& run) { return why_not_one_load(run).empty(); });
}

std::string why_not_judged(const Dataset& dataset) {
  if (dataset.judged() == domain::Judged::contraction)
    if (std::string why = no_load(dataset.rig); !why.empty()) return why;
  for (const Run& run : dataset.runs)
    if (const auto why = why_not(dataset, run); !why.empty())
      return fmt::format("in run {} {}", shortened(run.id), why);
  return "";
}

void require_judged(const Dataset& dataset, std::string_view verb) {
  if (const std::string why = why_not_judged(dataset); !why.empty())
    throw BadInput({{Severity::error, dataset.path.string(), nowhere,
                     fmt::format("{} cannot take it yet: {}", verb, why), ""}});
}

}  // namespace mckibben::input
