// Reading of data sets; see the header.
#include <unordered_map>

#include <fmt/format.h>

#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/run_file.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

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
    const Node& load = *list.children[i].find("load");
    if (const auto why = too_heavy(dataset.runs[i].load_kg, dataset.rig); !why.empty())
      problems.error(file.source, load.place, fmt::format("load = {}: {}", load.text, why));
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
  Dataset dataset;
  std::error_code ignored;
  dataset.path = fs::is_directory(path, ignored) ? path / "dataset.yaml" : path;
  const YamlFile file = load_yaml(dataset.path);
  Problems problems;
  problems.opened(file.source);
  problems.adopt(file.found);
  constexpr std::string_view also_allowed[] = {"schema"};
  if (check_schema(file, dataset_schema, problems))
    read_struct(file.source, file.root, dataset, problems, also_allowed);
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

}  // namespace mckibben::input
