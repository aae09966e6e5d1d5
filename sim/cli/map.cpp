// The verb `map`: error maps of the thesis's controller, one picture a load.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/error_map.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/heat_map.hpp>
#include <sim/output/progress.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/error_map.hpp>

namespace mckibben::cli {
namespace {

// The thesis's: five that it calibrates with, one that its controller had not seen (T 4.3).
constexpr double thesis_loads_kg[] = {8.87, 11.138, 13.870, 16.138, 18.870, 23.406};

/// Cells side by side from 0 to `end`: their middles.
std::vector<double> middles(int n, double end) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) values.push_back(end * (i + 0.5) / n);
  return values;
}

/// Parts of `fastest`: its n-th, ... , itself.
std::vector<double> parts(int n, double fastest) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(n));
  for (int i = 1; i <= n; ++i) values.push_back(fastest * i / n);
  return values;
}

/// The thesis's loads, if the calibration is of its kind, else the calibration's own: both ends and the
/// middle.
std::vector<double> usual_loads(const controllers::CalibratedRange& range) {
  if (std::count_if(std::begin(thesis_loads_kg), std::end(thesis_loads_kg),
                    [&](double load_kg) { return run::covers(range, load_kg); }) > 1)
    return {std::begin(thesis_loads_kg), std::end(thesis_loads_kg)};
  return {range.lowest_load_kg, 0.5 * (range.lowest_load_kg + range.highest_load_kg), range.highest_load_kg};
}

/// Loads asked for, or the usual ones that the calibration covers. Throws BadInput.
std::vector<double> loads_of(const std::string& path, const controllers::CalibratedRange& range,
                             const MapOptions& how) {
  std::vector<double> wanted = how.loads_kg, covered;
  if (wanted.empty()) wanted = usual_loads(range);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (how.extrapolate_load) return wanted;

  std::string outside;
  for (const double load_kg : wanted)
    if (run::covers(range, load_kg))
      covered.push_back(load_kg);
    else
      outside += fmt::format("{}{:g} kg", outside.empty() ? "" : ", ", load_kg);
  if (outside.empty()) return covered;
  const std::string text = fmt::format(
      "made with loads from {:g} to {:g} kg, which {} {} outside; calibrate with loads on both sides, or "
      "allow it "
      "with --extrapolate-load",
      range.lowest_load_kg, range.highest_load_kg, outside,
      outside.find(',') == std::string::npos ? "lies" : "lie");
  if (!how.loads_kg.empty() || covered.empty())
    throw input::BadInput({{input::Severity::error, path, {}, text, ""}});
  fmt::print(stderr, "mckibben: not mapped: {} was {}\n", path, text);
  return covered;
}

}  // namespace

int map_errors(const std::string& path, const Options& options, const MapOptions& how) {
  std::vector<domain::InputFile> files;
  run::MapPlan plan;
  plan.calibration = input::read_calibration(path, files);
  const domain::RigFile rig = input::read_rig(options.rig.empty() ? "thesis" : options.rig, files);
  plan.rig = rig;
  plan.engine = rig.integrator;
  plan.loads_kg = loads_of(path, plan.calibration.range, how);
  if (how.up || !how.down) plan.branches.push_back(controllers::Branch::contraction);
  if (how.down || !how.up) plan.branches.push_back(controllers::Branch::relaxation);
  plan.ratios = middles(how.ratios, plant::Braid(rig.muscle).largest_contraction_ratio());
  plan.speeds_per_s = parts(how.speeds, how.fastest_per_s);
  plan.extrapolate_load = how.extrapolate_load;
  plan.extrapolate_target = how.extrapolate_target;

  const auto file = std::filesystem::absolute(path).lexically_normal();
  const std::string stem = file.stem().string(), home = file.parent_path().filename().string();
  std::string name = fmt::format("map-{}", stem == "calibration" && !home.empty() ? home : stem);
  if (!options.rig.empty())
    name = fmt::format("{}-{}", name, std::filesystem::path(options.rig).stem().string());
  const auto where = destination(options, name);
  keep_apart(where, files);
  output::ResultFolder folder(where, "map " + path, say);

  run::ErrorMaps maps;
  {
    output::Progress progress(name);
    maps = run::error_maps(plan, options.threads, progress.hook());
  }
  const auto place = maps.interrupted ? beside(where) : where;
  if (maps.interrupted) folder.go_to(place);
  for (const auto& load : maps.loads)
    if (load.failure.empty())
      folder.write(fmt::format("map_{}kg.svg", domain::write_number(load.load_kg)),
                   output::heat_map_svg(plan, maps, load));
  input::Json json = output::json_of(plan, maps, files);
  if (maps.interrupted) json["interrupted"] = true;
  const std::string document = json.dump(2) + "\n";
  const std::string table = output::table_of(plan, maps);
  folder.write("map.csv", output::csv_of(maps));
  folder.write("map.json", document);
  folder.write("table.txt", table);
  folder.write("report.html", report::report_html(plan, maps));
  publish(folder, place);
  print(options.json ? document : table);
  if (maps.interrupted) {
    std::size_t all = 0, finished = 0;
    for (const auto& load : maps.loads)
      for (const auto& branch : load.branches)
        for (const auto& cell : branch.cells) {
          ++all;
          if (cell.failure != run::not_begun) ++finished;
        }
    say_interrupted(finished, all, "targets", where);
    return interrupted;
  }
  const bool failed = std::any_of(maps.loads.begin(), maps.loads.end(),
                                  [](const auto& load) { return !load.failure.empty(); });
  return failed ? failure : done;
}

}  // namespace mckibben::cli
