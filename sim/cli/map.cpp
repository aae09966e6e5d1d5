// The verb `map`: error maps of the thesis's controller, one picture a load.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/error_map.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/error_map.hpp>

namespace mckibben::cli {
namespace {

struct MapOptions : Options {
  std::string calibration;
  std::string rig;                ///< empty for the thesis's
  std::vector<double> loads_kg;   ///< empty for the thesis's
  bool up = false, down = false;  ///< neither for both
  int ratios = 30, speeds = 5;    ///< how many targets
  double fastest_per_s = 0.5;     ///< the largest target speed
  bool extrapolate_load = false, extrapolate_target = false;
};

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

/// The thesis's loads, if the calibration is of its kind,
/// else the calibration's own: both ends and the middle.
std::vector<double> usual_loads(const controllers::CalibratedRange& range) {
  if (std::count_if(std::begin(thesis_loads_kg), std::end(thesis_loads_kg),
                    [&](double load_kg) { return run::covers(range, load_kg); }) > 1)
    return {std::begin(thesis_loads_kg), std::end(thesis_loads_kg)};
  return {range.lowest_load_kg, 0.5 * (range.lowest_load_kg + range.highest_load_kg), range.highest_load_kg};
}

/// Loads asked for, or the usual ones that the calibration covers. Throws BadInput.
std::vector<double> loads_of(const controllers::CalibratedRange& range, const MapOptions& options) {
  std::vector<double> wanted = options.loads_kg, covered;
  if (wanted.empty()) wanted = usual_loads(range);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (options.extrapolate_load) return wanted;

  std::string outside;
  for (const double load_kg : wanted)
    if (run::covers(range, load_kg))
      covered.push_back(load_kg);
    else
      outside += fmt::format("{}{:g} kg", outside.empty() ? "" : ", ", load_kg);
  if (outside.empty()) return covered;
  const std::string text = fmt::format(
      "made with loads from {:g} to {:g} kg, which {} {} outside; calibrate with loads on both sides, or "
      "allow it with --extrapolate-load",
      range.lowest_load_kg, range.highest_load_kg, outside,
      outside.find(',') == std::string::npos ? "lies" : "lie");
  if (!options.loads_kg.empty() || covered.empty())
    throw input::BadInput({{input::Severity::error, options.calibration, {}, text, ""}});
  say(fmt::format("not mapped: {} was {}", options.calibration, text));
  return covered;
}

/// What is asked for; adds the files that are read. Throws BadInput.
run::MapPlan plan_of(const MapOptions& options, std::vector<domain::InputFile>& files) {
  run::MapPlan plan;
  plant::Rig rig;
  input::read_together(
      {{options.calibration, [&] { plan.calibration = input::read_calibration(options.calibration, files); }},
       {options.rig, [&] { rig = input::read_rig(options.rig.empty() ? "thesis" : options.rig, files); }}});
  input::require_load(rig, options.rig, "map");
  if (std::string why = input::wrong_rig(plan.calibration, rig, true); !why.empty())
    throw input::BadInput({{input::Severity::error, options.calibration, {}, std::move(why), ""}});
  plan.rig = rig;
  plan.loads_kg = loads_of(plan.calibration.range, options);
  if (options.up || !options.down) plan.branches.push_back(controllers::Branch::contraction);
  if (options.down || !options.up) plan.branches.push_back(controllers::Branch::relaxation);
  plan.ratios = middles(options.ratios, plant::Braid(rig.muscle).largest_contraction_ratio());
  plan.speeds_per_s = parts(options.speeds, options.fastest_per_s);
  plan.extrapolate_load = options.extrapolate_load;
  plan.extrapolate_target = options.extrapolate_target;
  return plan;
}

/// The calibration or its folder, the rig if one is given, -map.
std::string name_of(const MapOptions& options) {
  const auto file = std::filesystem::absolute(options.calibration).lexically_normal();
  const std::string stem = file.stem().string(), home = file.parent_path().filename().string();
  const std::string name = stem == "calibration" && !home.empty() ? home : stem;
  if (options.rig.empty()) return name + "-map";
  return fmt::format("{}-{}-map", name, std::filesystem::path(options.rig).stem().string());
}

/// Tells the job how many targets are finished.
void tell_interrupted(Job& job, const run::ErrorMaps& maps) {
  std::size_t all = 0, finished = 0;
  for (const auto& load : maps.loads)
    for (const auto& branch : load.branches) {
      all += branch.cells.size();
      finished += static_cast<std::size_t>(
          std::count_if(branch.cells.begin(), branch.cells.end(),
                        [](const auto& cell) { return cell.failure != run::not_begun; }));
    }
  job.interrupted(finished, all, "targets");
}

int map_errors(const MapOptions& options) {
  std::vector<domain::InputFile> files;
  const run::MapPlan plan = plan_of(options, files);
  const std::string name = name_of(options);
  Job job(options, "map " + options.calibration, name, files);
  const run::ErrorMaps maps =
      with_progress(name, [&](const auto& hook) { return run::error_maps(plan, options.threads, hook); });
  if (maps.interrupted) tell_interrupted(job, maps);

  std::vector<double> loads_kg;
  for (const auto& load : maps.loads) loads_kg.push_back(load.load_kg);
  for (const auto& load : maps.loads)
    if (load.failure.empty())
      job.write(fmt::format("map_{}kg.svg", domain::kg_in_name(load.load_kg, loads_kg)),
                output::heat_map_svg(plan, maps, load));
  const std::string document = output::json_of(plan, maps, files);
  const std::string table = output::table_of(plan, maps);
  job.write("map.csv", output::csv_of(maps));
  job.write("map.json", document);
  job.write("table.txt", table);
  job.write("report.html", report::report_html(plan, maps));
  return job.finish({document, table}, any_failed(maps.loads) ? failure : done);
}

}  // namespace

void add_map(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      add_verb(app, "map", models_of_thesis,
               "Map the errors of the thesis's open-loop controller over its targets (figures 4.50, 4.51)");
  MapOptions& options = asked.when(verb, map_errors);
  add_input(verb, options.calibration, "calibration", "Calibration file that `calibrate` wrote",
            "CALIBRATION");
  add_common(verb, options, "out/<calibration>-map");
  add_loads(verb, options.loads_kg,
            "\"8.87 kg\"; may be repeated (default: the thesis's five and its unseen 8.87 kg, "
            "those that the calibration covers; of a calibration for other loads its ends and middle)");
  add_rig(verb, options.rig, "(default: thesis)");
  verb.add_flag("--up", options.up, "Going up only");
  verb.add_flag("--down", options.down, "Going down only");
  add_number(verb, "--ratios", options.ratios, 1, 1000,
             "How many target contraction ratios, up to e_max (default: 30)");
  add_number(verb, "--speeds", options.speeds, 1, 1000, "How many target speeds (default: 5)");
  add_quantity(verb, "--fastest", options.fastest_per_s, "1/s", 100.0,
               "The largest target speed (default: \"0.5 1/s\")", "SPEED");
  verb.add_flag("--extrapolate-load", options.extrapolate_load, "Allow loads outside the calibrated range");
  verb.add_flag("--extrapolate-target", options.extrapolate_target,
                "Let contraction ratios and current speeds leave the calibrated range; otherwise they are "
                "brought to its end");
  verb.footer(
      "Examples:\n"
      "  mckibben map scenarios/thesis_calibration.yaml --load \"16.138 kg\" --up\n"
      "  mckibben map out/thesis_campaign-calibrate/calibration.yaml --load \"8.87 kg\" "
      "--extrapolate-load\n"
      "Writes map.csv, table.txt, map.json and a picture for each load.\n");
}

}  // namespace mckibben::cli
