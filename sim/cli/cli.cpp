// Parsing of the command line (CLI11) and the one place where failures become exit statuses.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sim/cli/cli.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>
#include <sim/output/folder.hpp>
#include <sim/run/batch.hpp>
#include <sim/study/study.hpp>

namespace mckibben::cli {
namespace {

constexpr const char* examples =
    "Examples:\n"
    "  mckibben run scenarios/five_loads.yaml          controllers compared under five loads\n"
    "  mckibben run my.yaml --out results --threads 1  somewhere else, on one thread\n"
    "  mckibben dataset scenarios/thesis_campaign.yaml synthetic calibration data\n"
    "  mckibben calibrate data/                        the thesis's models from it\n"
    "  mckibben map out/calibration/calibration.yaml   errors of the thesis's controller over its targets\n"
    "  mckibben replay measured/ --rig my_rig.yaml     measured currents on a rig of yours\n"
    "  mckibben effects                                what a rig may have besides the nominal\n"
    "  mckibben diagnose measured/                     what does the rig lack? finds it and adds it\n"
    "  mckibben check my.yaml                          is the file right? nothing is run\n"
    "Exit status: 0 done, 1 a criterion of yours is not met, 64 usage, 65 bad input file,\n"
    "66 input file missing, 70 numerical failure or a defect of ours, 74 cannot write, 130 interrupted.\n";

// Runs a verb and says on stderr what went wrong.
int guarded(const std::function<int()>& verb) {
  const auto say = [](const char* text) { fmt::print(stderr, "{}\n", text); };
  try {
    const int status = verb();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw output::CannotWrite("cannot write to standard output");
    return status;
  } catch (const input::BadInput& error) {
    say(error.what());
    return bad_input;
  } catch (const input::MissingInput& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return missing_input;
  } catch (const output::CannotWrite& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return cannot_write;
  } catch (const run::Interrupted&) {
    say("mckibben: interrupted; nothing was written, earlier results are as they were");
    return interrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "mckibben: {}\nThis is a defect of the program; please report it.\n", error.what());
    return failure;
  }
}

void add_common(CLI::App& verb, Options& options) {
  verb.add_option("--out", options.out, "Results folder (default: out/<name>)")->type_name("DIR");
  verb.add_flag("--json", options.json, "Print the result as one JSON document");
  verb.add_option("--threads", options.threads,
                  "Threads (default: all the machine has); results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

/// A whole number without sign or leading zeros that fits: as the scenario's own key is read.
std::string is_seed(const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  const bool leading_zero = text.size() > 1 && text.front() == '0';
  if (read.ec == std::errc{} && read.ptr == end && !leading_zero) return "";
  return fmt::format("{} is not a whole number from 0 to 18446744073709551615", text);
}

/// CLI11 calls an unknown verb a missing one: says what was meant instead.
bool is_unknown_verb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  std::vector<std::string> verbs;
  for (const auto* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (std::find(verbs.begin(), verbs.end(), argv[1]) != verbs.end()) return false;
  const std::vector<std::string_view> known(verbs.begin(), verbs.end());
  fmt::print(stderr, "mckibben: unknown verb {}{} (verbs: {}; --help explains them)\n", argv[1],
             input::did_you_mean(argv[1], known), input::join(known));
  return true;
}

void add_calibrate(CLI::App& verb, std::string& path, CalibrateOptions& how) {
  using namespace thesis;
  verb.add_option("dataset", path, "Data set: its dataset.yaml or the folder")
      ->required()
      ->type_name("DATASET");
  verb.add_flag("--kgf", how.kgf, "Pressures of figures and report in kgf/m2, as the thesis prints them");
  const auto choice = [&verb](const char* name, auto& value, auto choices, const char* help) {
    const auto choose = [&value, choices](const std::string& text) { value = choices.at(text); };
    verb.add_option_function<std::string>(name, choose, help)->check(CLI::IsMember(choices))->type_name("");
  };
  choice("--pressure", how.fits.processing.pressure,
         std::map<std::string, PressureSource>{{"current", PressureSource::current},
                                               {"gauge", PressureSource::gauge}},
         "Pressure from the current by the valve's line (default: current) or from the gauge");
  choice("--acceleration", how.fits.processing.acceleration,
         std::map<std::string, Acceleration>{{"counted", Acceleration::counted},
                                             {"neglected", Acceleration::neglected}},
         "Acceleration in the force balance (default: counted)");
  choice("--fit", how.fits.fitting,
         std::map<std::string, PressureFitting>{{"joint", PressureFitting::joint},
                                                {"sequence", PressureFitting::sequence}},
         "Pressure coefficients from all samples at once, or from the thesis's sequence of fits (default: "
         "joint)");
  verb.add_option("--load-order", how.fits.orders.load, "Highest order in load (default: 3, the thesis's)")
      ->check(CLI::Range(0, 3))
      ->type_name("N");
  verb.add_option("--speed-order", how.fits.orders.speed,
                  "Highest order in the current's speed (default: 2, the thesis's)")
      ->check(CLI::Range(0, 2))
      ->type_name("N");
  verb.footer(
      "Example:\n  mckibben calibrate data --out calibration\n"
      "Writes calibration.yaml (for the open-loop controllers), calibration.json, report.txt and "
      "figures/.\n");
}

/// Reads a quantity above 0 and up to `most`; what is wrong with it is a usage error.
double positive_quantity(const std::string& text, const char* unit, double most) {
  double value = 0.0;
  try {
    value = input::read_quantity(text, unit);
  } catch (const input::BadQuantity& error) {
    throw CLI::ValidationError(error.what());
  }
  if (value > 0.0 && value <= most) return value;
  throw CLI::ValidationError(
      fmt::format("{} must be above 0 and at most {}", text, input::write_quantity(most, unit)));
}

void add_map(CLI::App& verb, std::string& path, Options& options, MapOptions& how) {
  verb.add_option("calibration", path, "Calibration file that `calibrate` wrote")
      ->required()
      ->type_name("CALIBRATION");
  verb.add_option_function<std::vector<std::string>>(
          "--load",
          [&how](const std::vector<std::string>& texts) {
            for (const auto& text : texts) how.loads_kg.push_back(positive_quantity(text, "kg", 500.0));
          },
          "Load such as \"8.87 kg\"; may be repeated (default: the thesis's five and its unseen 8.87 kg, "
          "those "
          "that the calibration covers)")
      ->allow_extra_args(false)
      ->type_name("LOAD");
  verb.add_option("--rig", options.rig, "Rig file or shipped rig (default: thesis)")->type_name("RIG");
  verb.add_flag("--up", how.up, "Going up only");
  verb.add_flag("--down", how.down, "Going down only");
  verb.add_option("--ratios", how.ratios, "How many target contraction ratios, up to e_max (default: 30)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  verb.add_option("--speeds", how.speeds, "How many target speeds (default: 5)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  verb.add_option_function<std::string>(
          "--fastest",
          [&how](const std::string& text) { how.fastest_per_s = positive_quantity(text, "1/s", 100.0); },
          "The largest target speed (default: \"0.5 1/s\")")
      ->type_name("SPEED");
  verb.add_flag("--extrapolate-load", how.extrapolate_load, "Allow loads outside the calibrated range");
  verb.add_flag("--extrapolate-target", how.extrapolate_target,
                "Let contraction ratios and current speeds leave the calibrated range; otherwise they are "
                "brought to its end");
  verb.footer(
      "Example:\n  mckibben map out/thesis_campaign-calibration/calibration.yaml --load \"8.87 kg\" "
      "--extrapolate-load\n"
      "Writes map.csv, table.txt, map.json and a picture for each load.\n");
}

void add_diagnose(CLI::App& verb, std::string& path, Options& options, std::string& seed, std::string& plan) {
  verb.add_option("dataset", path, "Data set: its dataset.yaml or the folder")
      ->required()
      ->type_name("DATASET");
  verb.add_option("--rig", options.rig, "Rig file or shipped rig instead of the data set's")
      ->type_name("RIG");
  verb.add_option("--seed", seed, "Seed of the resampling (default: 1)")->check(is_seed)->type_name("N");
  verb.add_option("--plan", plan, "Write the measurement that would tell more, if one would, as a campaign")
      ->type_name("FILE");
  verb.footer(
      "Example:\n  mckibben diagnose measured/ --out diagnosis --plan next.yaml\n"
      "Writes report.html (to read), rig.yaml (the corrected rig, for run and replay) and diagnosis.json.\n");
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app("McKibben: a simulator of a pneumatic muscle that lifts a load, and of its controllers.",
               "mckibben");
  app.footer(examples);
  app.set_version_flag("--version", std::string("mckibben ") + MCKIBBEN_VERSION);
  app.require_subcommand(1);

  Options options;
  std::string path, kind = "scenario", format = "json";
  std::string seed;
  std::vector<std::string> paths;
  std::function<int()> chosen;

  auto* run_verb =
      app.add_subcommand("run", "Simulate each load x controller of a scenario; print tracking errors");
  run_verb->add_option("scenario", path, "Scenario file")->required()->type_name("SCENARIO.yaml");
  add_common(*run_verb, options);
  run_verb->add_option("--seed", seed, "Seed of the noise (default: the scenario's)")
      ->check(is_seed)
      ->type_name("N");
  run_verb->footer("Example:\n  mckibben run scenarios/five_loads.yaml\n");
  run_verb->callback([&] {
    if (!seed.empty()) options.seed = std::stoull(seed);
    chosen = [&] { return run_scenario(path, options); };
  });

  auto* dataset_verb = app.add_subcommand(
      "dataset", "Simulate a campaign; write a calibration data set and, apart, the truth");
  dataset_verb->add_option("campaign", path, "Campaign file")->required()->type_name("CAMPAIGN.yaml");
  add_common(*dataset_verb, options);
  dataset_verb->add_option("--seed", seed, "Seed of the noise (default: the campaign's)")
      ->check(is_seed)
      ->type_name("N");
  dataset_verb->footer(
      "Example:\n  mckibben dataset scenarios/thesis_campaign.yaml --out data\n"
      "Writes data/ and data-truth/. If interrupted, the same command goes on where it stopped.\n");
  dataset_verb->callback([&] {
    if (!seed.empty()) options.seed = std::stoull(seed);
    chosen = [&] { return make_dataset(path, options); };
  });

  CalibrateOptions how;
  auto* calibrate_verb = app.add_subcommand(
      "calibrate", "Fit the thesis's friction and pressure models to a data set; draw its figures");
  add_common(*calibrate_verb, options);
  add_calibrate(*calibrate_verb, path, how);
  calibrate_verb->callback([&] { chosen = [&] { return calibrate_dataset(path, options, how); }; });

  MapOptions targets;
  auto* map_verb = app.add_subcommand(
      "map", "Map the errors of the thesis's open-loop controller over its targets (figures 4.50, 4.51)");
  add_common(*map_verb, options);
  add_map(*map_verb, path, options, targets);
  map_verb->callback([&] { chosen = [&] { return map_errors(path, options, targets); }; });

  std::string study;
  auto* study_verb = app.add_subcommand(
      "study", "Simulate and calibrate a campaign; compare what was found with what was true");
  study_verb
      ->add_option("name", study,
                   "lag (friction or lag of valve and hose?), counting (what counts at each tick do to the "
                   "load), figures (the thesis's accuracy beside ours)")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(study::names.begin(), study::names.end())));
  study_verb->add_option("campaign", path, "Campaign file")->required()->type_name("CAMPAIGN.yaml");
  add_common(*study_verb, options);
  study_verb->footer(
      "Example:\n  mckibben study lag scenarios/thesis_campaign.yaml\n"
      "Writes NAME.md (the page), NAME.csv and NAME.svg (its picture), NAME.json (every number).\n");
  study_verb->callback([&] { chosen = [&] { return make_study(study, path, options); }; });

  auto* replay_verb =
      app.add_subcommand("replay", "Simulate a data set's runs with their recorded currents; compare");
  replay_verb->add_option("dataset", path, "Data set: its dataset.yaml or the folder")
      ->required()
      ->type_name("DATASET");
  add_common(*replay_verb, options);
  replay_verb->add_option("--rig", options.rig, "Rig file or shipped rig instead of the data set's")
      ->type_name("RIG");
  replay_verb->footer("Example:\n  mckibben replay measured/ --rig my_rig.yaml --out compared\n");
  replay_verb->callback([&] { chosen = [&] { return replay_dataset(path, options); }; });

  std::string plan;
  auto* diagnose_verb = app.add_subcommand(
      "diagnose", "Find where model and data disagree; name the missing effect, add it, show the gap shrink");
  add_common(*diagnose_verb, options);
  add_diagnose(*diagnose_verb, path, options, seed, plan);
  diagnose_verb->callback([&] {
    if (!seed.empty()) options.seed = std::stoull(seed);
    chosen = [&] { return diagnose_dataset(path, options, plan); };
  });

  auto* check_verb =
      app.add_subcommand("check", "Validate scenario, campaign, rig and data set files; nothing is run");
  check_verb->add_option("files", paths, "Files to check")->required()->type_name("FILE");
  add_common(*check_verb, options);
  check_verb->footer("Example:\n  mckibben check scenarios/*.yaml\n");
  check_verb->callback([&] { chosen = [&] { return check_files(paths, options); }; });

  auto* effects_verb = app.add_subcommand(
      "effects", "The catalogue of effects that a rig may have: laws, parameters, sources");
  effects_verb->add_option("names", paths, "Only these, with how to switch them on")->type_name("NAME");
  add_common(*effects_verb, options);
  effects_verb->footer("Example:\n  mckibben effects muscle_leak\n");
  effects_verb->callback([&] { chosen = [&] { return list_effects(paths, options); }; });

  auto* schema_verb =
      app.add_subcommand("schema", "Print the keys of a kind of file, as JSON Schema or as a table");
  schema_verb->add_option("kind", kind, "Kind of file")
      ->check(CLI::IsMember({"scenario", "campaign", "rig", "dataset"}));
  schema_verb
      ->add_option("--format", format,
                   "How to print it; yaml prints the rig `thesis` with every value, to start from")
      ->check(CLI::IsMember({"json", "markdown", "yaml"}));
  schema_verb->footer("Example:\n  mckibben schema scenario --format markdown\n");
  schema_verb->callback([&] { chosen = [&] { return print_schema(kind, format); }; });

  if (is_unknown_verb(app, argc, argv)) return usage_error;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : usage_error;
  }
  run::catch_interrupts();
  return guarded(chosen);
}

}  // namespace mckibben::cli
