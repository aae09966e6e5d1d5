// Reading of data sets; see the header.
#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/rig_number.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/folders.hpp>
#include <sim/input/run_file.hpp>
#include <sim/input/stamped_run.hpp>
#include <sim/input/thinned.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

void check_runs(const YamlFile& file, const Dataset& dataset, Problems& problems) {
  const Node& list = *file.root.find("runs");
  if (dataset.runs.empty()) problems.error(file.source, list.place, "runs: at least one run is needed");
  std::unordered_map<std::string, std::size_t> first;
  std::vector<double> loads_kg;
  for (const Run& run : dataset.runs) loads_kg.push_back(run.load_kg);
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
    if (const auto why = domain::too_heavy(loads_kg[i], dataset.rig, loads_kg); !why.empty())
      problems.error(file.source, load->place, fmt::format("load = {}: {}", load->text, why));
  }
}

/// Shows a contradiction where the files say it.
void show(const YamlFile& file, const Node& run, const domain::Contradiction& found, Problems& problems) {
  const bool of_columns = domain::find_quantity(found.key) != nullptr;
  const Node* said = nullptr;
  for (const Node* in :
       {of_columns ? run.find("columns") : &run, of_columns ? file.root.find("columns") : &file.root})
    if (said == nullptr && in != nullptr) said = in->find(found.key);
  const std::string what = of_columns        ? found.key + ": "
                           : said != nullptr ? fmt::format("{} = {}: ", found.key, said->text)
                                             : "";
  problems.error(file.source, said != nullptr ? said->place : run.place, what + found.why);
}

/// Loads as they were given, and a clock; and what contradicts the rig, or itself: in columns only if they
/// were read without errors.
void check_kind(const YamlFile& file, Dataset& dataset, Problems& problems) {
  const Node* list = file.root.find("runs");
  const bool well_read = problems.errors() == 0;
  for (const char* key : {"start", "skip", "hold"})
    dataset.own_clock = dataset.own_clock || file.root.find(key) != nullptr;
  for (Run& run : dataset.runs) {
    run.load_kg = run.given_load_kg.value_or(0.0);
    dataset.own_clock = dataset.own_clock || has_own_clock(merged(dataset.columns, run.columns), dataset.rig);
  }
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Node& node = list->children[i];
    const bool empty_load = !dataset.runs[i].given_load_kg && node.find("load") != nullptr;  // has been shown
    if (node.kind == Node::Kind::map)
      for (const domain::Contradiction& found : domain::contradictions(dataset, dataset.runs[i]))
        if ((well_read || domain::find_quantity(found.key) == nullptr) &&
            !(empty_load && found.key == "load"))
          show(file, node, found, problems);
  }
}

/// Whether a run's commands are in a unit of its valves.
bool check_commands(const YamlFile& file, const Node& node, const Dataset& dataset, const Run& run,
                    Problems& problems) {
  const auto wrong = wrong_command_units(merged(dataset.columns, run.columns), dataset.rig);
  for (const domain::Contradiction& found : wrong) show(file, node, found, problems);
  return wrong.empty();
}

/// False if a unit is wrong: the numbers would be, too.
bool check_columns(const YamlFile& file, Problems& problems) {
  const std::size_t before = problems.errors();
  if (const Node* shared = file.root.find("columns")) check_units(file.source, *shared, problems);
  for (const Node& run : file.root.find("runs")->children)
    if (const Node* own = run.find("columns")) check_units(file.source, *own, problems);
  return problems.errors() == before;
}

/// How tables were read; what several files share is said once.
std::vector<std::string> remarks_of(const std::vector<Problem>& notes) {
  constexpr std::size_t few = 3;
  std::map<std::string, std::vector<const Problem*>> kinds;
  for (const Problem& each : notes) {
    std::string kind = each.message;
    std::erase_if(kind, [](unsigned char c) { return std::isdigit(c) != 0; });
    kinds[kind].push_back(&each);
  }
  std::vector<std::string> remarks;
  for (const auto& [kind, alike] : kinds)
    for (const Problem* each : alike) {
      const std::string more =
          alike.size() > few ? fmt::format("; likewise in {} other places", alike.size() - 1) : "";
      remarks.push_back(where(*each) + ": " + each->message + more);
      if (!more.empty()) break;
    }
  return remarks;
}

}  // namespace

Dataset read_dataset(const fs::path& path) {
  std::error_code ignored;
  const bool folder = fs::is_directory(path, ignored);
  const fs::path file = folder ? path / "dataset.yaml" : path;
  if (folder && !fs::exists(file, ignored))
    throw MissingInput(path.string() + ": no dataset.yaml is in this folder" + how_to_import(path));
  return read_dataset(Source::load(file, largest_yaml_bytes));
}

Dataset read_dataset(Source source) {
  Dataset dataset;
  const YamlFile file = parse_yaml(std::move(source));
  dataset.path = file.source.name();
  Problems problems;
  constexpr std::string_view also_allowed[] = {"schema"};
  if (begin_file(file, dataset_schema, problems))
    read_struct(file.source, file.root, dataset, problems, also_allowed);
  check_kind(file, dataset, problems);
  if (problems.errors() == 0) {
    check_runs(file, dataset, problems);
    std::set<fs::path> files;
    for (const Run& run : dataset.runs) files.insert((file.source.folder() / run.file).lexically_normal());
    const std::uintmax_t together = bytes_of(std::move(files));
    if (check_columns(file, problems))
      for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
        const Node& node = file.root.find("runs")->children[i];
        if (check_commands(file, node, dataset, dataset.runs[i], problems))
          read_run_file(file, node, dataset, dataset.runs[i], together, problems);
      }
  }
  problems.join_columns();
  problems.raise();
  dataset.remarks = remarks_of(problems.warnings());
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

void take_rig(Dataset& dataset, const std::string& called, Rig rig) {
  if (const auto recorded = dataset.rig.command_unit(); rig.command_unit() != recorded)
    throw BadInput({{Severity::error, called, nowhere,
                     fmt::format("the data are of a valve that is commanded in {}, this rig's is in {}",
                                 name_of(recorded), name_of(rig.command_unit())),
                     ""}});
  dataset.rig = std::move(rig);
}

std::string why_unfit(domain::Purpose purpose, const Dataset& dataset) {
  if (dataset.judged() == domain::Judged::contraction)
    if (std::string why = no_load(dataset.rig); !why.empty()) return why;
  const auto found = domain::why_not(purpose, dataset);
  return found ? fmt::format("in run {} {}", shortened(found->key), found->why) : "";
}

void require_judged(const Dataset& dataset, std::string_view verb) {
  if (const std::string why = why_unfit(domain::Purpose::judging, dataset); !why.empty())
    throw BadInput({{Severity::error, dataset.path.string(), nowhere,
                     fmt::format("{} cannot take it yet: {}", verb, why), ""}});
}

}  // namespace mckibben::input
