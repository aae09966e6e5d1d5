// Reading of data sets; see the header.
#include <unordered_map>

#include <fmt/format.h>

#include <sim/input/csv.hpp>
#include <sim/input/dataset.hpp>
#include <sim/input/file_names.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

constexpr double bar_Pa = 1e5;
constexpr double lowest_contraction = -0.2, highest_contraction = 1.0;

void read_run(const Source& source, const Dataset& dataset, Run& run, Problems& problems) {
  constexpr std::string_view required[] = {"time_s", "current_mA", "contraction_ratio"};
  constexpr std::string_view optional[] = {"muscle_pressure_bar"};
  problems.opened(source);
  TableProblems found(source, problems);
  const Table table = read_table(source, required, optional, found);
  if (table.columns.size() < std::size(required)) return;
  check_ticks(source, table, dataset.rig.tick_s, found);
  const Table::Column& current = *table.find("current_mA");
  const Table::Column& contraction = *table.find("contraction_ratio");
  check_dac_range(source, current, dataset.rig.dac.largest_current_mA, found);
  check_range(source, contraction, lowest_contraction, highest_contraction, "what a muscle can do", found);
  run.current_mA = current.values;
  run.contraction_ratio = contraction.values;
  if (const Table::Column* pressure = table.find("muscle_pressure_bar")) {
    run.muscle_pressure_Pa = pressure->values;
    for (double& value : *run.muscle_pressure_Pa) value *= bar_Pa;
  }
}

void check_ids(const YamlFile& file, const Dataset& dataset, Problems& problems) {
  const Node& list = *file.root.find("runs");
  if (dataset.runs.empty()) problems.error(file.source, list.place, "runs: at least one run is needed");
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const std::string& id = dataset.runs[i].id;
    const Place place = list.children[i].find("id")->place;
    const auto [earlier, is_new] = first.try_emplace(id, list.children[i].place.line);
    if (!is_file_safe(id))
      problems.error(file.source, place, fmt::format("id = {}: {}", id, file_safe_rule));
    else if (!is_new)
      problems.error(file.source, place,
                     fmt::format("id = {} is already that of the run in line {}", id, earlier->second));
  }
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
    check_ids(file, dataset, problems);
    for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
      Run& run = dataset.runs[i];
      try {
        read_run(Source::load((file.source.folder() / run.file).lexically_normal(), largest_csv_bytes),
                 dataset, run, problems);
      } catch (const MissingInput& missing) {
        problems.missing_file(file.source, file.root.find("runs")->children[i].find("file")->place,
                              missing.what());
      }
    }
  }
  problems.raise();
  dataset.inputs = problems.inputs();
  return dataset;
}

}  // namespace mckibben::input
