// The help of the program, and the verbs but those of the thesis's models.
#include <memory>
#include <string>

#include <sim/cli/app.hpp>
#include <sim/cli/options.hpp>
#include <sim/solver/settings.hpp>

namespace mckibben::cli {
namespace {

constexpr const char* what_it_is =
    "McKibben simulates a pneumatic muscle that lifts a load: servo valve, hose, gas, braid, thread "
    "friction,\n"
    "encoder, and the controllers that move the load along a target. Given measurements of a real rig, it\n"
    "finds what that rig has and the simulated one lacks.\n"
    "\n"
    "Do these three first:\n"
    "  mckibben init my.yaml        writes a scenario with comments, to change as you like\n"
    "  mckibben run my.yaml         simulates it: a table of tracking errors, a plot, CSV files\n"
    "  mckibben diagnose measured/  takes your measurements and names what your rig has besides\n";

constexpr const char* last_words =
    "mckibben VERB --help explains a verb, with examples. In a checkout, ./mckibben test runs its tests.\n"
    "Results go to stdout, everything else to stderr.\n"
    "Exit status: 0 done, 1 a criterion of yours is not met, 64 usage, 65 bad input file,\n"
    "66 input file missing, 70 numerical failure or a defect of ours, 74 cannot write, 130 interrupted.\n";

/// What CLI11 writes, without what it adds to our words: exclusions, a colon before choices.
class Help : public CLI::Formatter {
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return "";
    std::string type = option->get_type_name();
    if (type.starts_with(':')) type.erase(0, 1);
    const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    return " " + type + (many ? " ..." : "");
  }
};

void add_init(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand("init", "Write a scenario with comments, to start from");
  verb.group("Simulate");
  asked.path = "scenario.yaml";
  verb.add_option("file", asked.path, "Where to (default: scenario.yaml); a file that is there is left alone")
      ->type_name("FILE");
  add_json(verb, asked.options);
  verb.footer(
      "Examples:\n"
      "  mckibben init my.yaml\n"
      "  mckibben init scenarios/mine.yaml --json\n"
      "The file says how to go on. It is a scenario as it stands: mckibben run my.yaml\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return write_scenario(asked.path, asked.options); }; });
}

void add_run(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      *app.add_subcommand("run", "Simulate each load x controller of a scenario; print tracking errors");
  verb.group("Simulate");
  verb.add_option("scenario", asked.path, "Scenario file")->required()->type_name("SCENARIO.yaml");
  add_common(verb, asked.options);
  add_seed(verb, asked.options, "the noise (default: the scenario's)");
  add_formats(verb, asked.options);
  verb.footer(
      "Examples:\n"
      "  mckibben run scenarios/five_loads.yaml\n"
      "  mckibben run my.yaml --out results --seed 2      somewhere else, with other noise\n"
      "  mckibben run my.yaml --json > result.json        for a script\n"
      "  mckibben run my.yaml --format mat,netcdf         for MATLAB, Octave, Python besides\n"
      "Writes table.txt, run.json, report.html, tracking.svg and a CSV for each run.\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return run_scenario(asked.path, asked.options); }; });
}

void add_make_dataset(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "dataset", "Simulate a campaign; write a calibration data set and, apart, the truth");
  verb.group("Simulate");
  verb.add_option("campaign", asked.path, "Campaign file")->required()->type_name("CAMPAIGN.yaml");
  add_common(verb, asked.options);
  add_seed(verb, asked.options, "the noise (default: the campaign's)");
  add_formats(verb, asked.options);
  verb.footer(
      "Examples:\n"
      "  mckibben dataset scenarios/thesis_campaign.yaml --out data\n"
      "  mckibben dataset my_campaign.yaml --seed 2       the same measured again, with other noise\n"
      "Writes data/ and data-truth/. If interrupted, the same command goes on where it stopped.\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return make_dataset(asked.path, asked.options); }; });
}

void add_replay(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      *app.add_subcommand("replay", "Simulate a data set's runs with their recorded currents; compare");
  verb.group("Compare with measurements");
  add_dataset(verb, asked.path);
  add_common(verb, asked.options);
  add_rig(verb, asked.options, "instead of the data set's");
  add_formats(verb, asked.options);
  verb.footer(
      "Examples:\n"
      "  mckibben replay measured/\n"
      "  mckibben replay labview.yaml --format mat        .lvm and .mat in, .mat out: docs/formats.md\n"
      "  mckibben replay measured/ --rig my_rig.yaml --out compared\n"
      "Writes table.txt, run.json and the simulation of each run as CSV.\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return replay_dataset(asked.path, asked.options); }; });
}

void add_diagnose(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "diagnose", "Find where model and data disagree; name the missing effect, add it, show the gap shrink");
  verb.group("Compare with measurements");
  add_dataset(verb, asked.path);
  add_common(verb, asked.options);
  add_rig(verb, asked.options, "instead of the data set's");
  add_seed(verb, asked.options, "the resampling (default: 1)");
  verb.add_option("--plan", asked.plan,
                  "Write the measurement that would tell more, if one would, as a campaign")
      ->type_name("FILE");
  verb.footer(
      "Examples:\n"
      "  mckibben diagnose measured/\n"
      "  mckibben diagnose measured/ --out diagnosis --plan next.yaml\n"
      "Writes report.html (to read), rig.yaml (the corrected rig, for run and replay) and diagnosis.json.\n");
  verb.callback([&asked] {
    asked.chosen = [&asked] { return diagnose_dataset(asked.path, asked.options, asked.plan); };
  });
}

void add_diff(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "diff", "Compare two folders that run or replay wrote: inputs, metrics, trajectories");
  verb.group("Find out");
  verb.add_option("left", asked.path, "Folder that run or replay wrote")->required()->type_name("FOLDER");
  verb.add_option("right", asked.other, "Another one, written by the same verb")
      ->required()
      ->type_name("FOLDER");
  add_out(verb, asked.options, "nothing is written");
  add_json(verb, asked.options);
  verb.add_option("--tolerance", asked.allowed,
                  "Difference of the contraction ratio that is allowed at any tick; more is exit status 1 "
                  "(default: any)")
      ->check(from_to(0.0, 1.0))
      ->type_name("RATIO");
  verb.footer(
      "Examples:\n"
      "  mckibben diff out/five_loads out/mine            what differs?\n"
      "  mckibben diff before/ after/ --tolerance 1e-6    has anything changed? for a script\n");
  verb.callback([&asked] {
    asked.chosen = [&asked] {
      return compare_folders(asked.path, asked.other, asked.allowed, asked.options);
    };
  });
}

void add_effects(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "effects", "The catalogue of effects that a rig may have: laws, parameters, sources");
  verb.group("Find out");
  verb.add_option("names", asked.names, "Only these, with how to switch them on")
      ->check(one_of("effect", names_of_effects()))
      ->type_name("");
  add_common(verb, asked.options, "nothing is written");
  verb.footer(
      "Examples:\n"
      "  mckibben effects                                 all of them\n"
      "  mckibben effects muscle_leak                     its law, and what to write into a rig file\n"
      "  mckibben effects --out pictures                  effects.json, and a picture of what each does\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return list_effects(asked.names, asked.options); }; });
}

void add_check(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      *app.add_subcommand("check", "Validate scenario, campaign, rig and data set files; nothing is run");
  verb.group("Find out");
  verb.add_option("files", asked.names, "Files to check")->required()->type_name("FILE");
  add_common(verb, asked.options, "nothing is written");
  verb.footer(
      "Examples:\n"
      "  mckibben check scenarios/*.yaml\n"
      "  mckibben check measured/ --json                  a data set and all of its files\n"
      "Every error of a file at once, each with file, line, column, value and rule.\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return check_files(asked.names, asked.options); }; });
}

void add_schema(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      *app.add_subcommand("schema", "Print the keys of a kind of file, as JSON Schema or as a table");
  verb.group("Find out");
  verb.add_option("kind", asked.kind, "Kind of file (default: scenario)")
      ->check(one_of("kind", {"scenario", "campaign", "rig", "dataset"}))
      ->type_name("");
  CLI::Option* format =
      verb.add_option("--format", asked.format,
                      "How to print it (default: json); yaml prints the rig `thesis` with every value, to "
                      "start from")
          ->check(one_of("format", {"json", "markdown", "yaml"}))
          ->type_name("");
  verb.add_flag("--json", asked.options.json, "The same as --format json")->excludes(format);
  verb.footer(
      "Examples:\n"
      "  mckibben schema scenario --format markdown       every key with unit, default and range\n"
      "  mckibben schema rig --format yaml > my_rig.yaml  a rig to change\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return print_schema(asked.kind, asked.format); }; });
}

void add_doctor(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "doctor", "Is the program sound here? Integrates known cases; prints versions and builds");
  verb.group("Find out");
  add_json(verb, asked.options);
  asked.tolerance = solver::Settings{}.tolerance;
  verb.add_option("--tolerance", asked.tolerance, "Of the integration (default: 1e-6, as in a rig)")
      ->check(from_to(solver::tightest_tolerance, 1e-3))
      ->type_name("RATIO");
  verb.footer(
      "Examples:\n"
      "  mckibben doctor\n"
      "  mckibben doctor --json > doctor.json             to go with a report of something odd\n"
      "Exit status: 70 if a case is not found, 74 if out/ cannot be written.\n");
  verb.callback([&asked] { asked.chosen = [&asked] { return examine(asked.tolerance, asked.options); }; });
}

void add_completion(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "completion", "Print a script by which the shell completes verbs, options and values");
  verb.group("Find out");
  verb.add_option("shell", asked.shell, "For which shell")
      ->required()
      ->check(one_of("shell", {"bash", "zsh"}))
      ->type_name("");
  add_json(verb, asked.options);
  verb.footer(
      "Examples:\n"
      "  mckibben completion bash > ~/.local/share/bash-completion/completions/mckibben\n"
      "  mckibben completion zsh > ~/.zfunc/_mckibben     where ~/.zfunc is in fpath, before compinit\n"
      "Or for this session only: source <(mckibben completion bash)\n");
  verb.callback(
      [&asked] { asked.chosen = [&asked] { return print_completion(asked.shell, asked.options); }; });
}

}  // namespace

void add_simulating_verbs(CLI::App& app, Asked& asked) {
  add_init(app, asked);
  add_run(app, asked);
  add_make_dataset(app, asked);
}

void add_comparing_verbs(CLI::App& app, Asked& asked) {
  add_replay(app, asked);
  add_diagnose(app, asked);
}

void add_helping_verbs(CLI::App& app, Asked& asked) {
  add_diff(app, asked);
  add_effects(app, asked);
  add_check(app, asked);
  add_schema(app, asked);
  add_doctor(app, asked);
  add_completion(app, asked);
}

void build(CLI::App& app, Asked& asked) {
  app.description(what_it_is);
  app.footer(last_words);
  app.formatter(std::make_shared<Help>());
  app.get_formatter()->label("SUBCOMMAND", "VERB ...");
  app.set_version_flag("--version", std::string("mckibben ") + MCKIBBEN_VERSION,
                       "Print the version and stop");
  app.get_help_ptr()->description("Print this help and stop");
  app.require_subcommand(1);
  add_simulating_verbs(app, asked);
  add_comparing_verbs(app, asked);
  add_model_verbs(app, asked);
  add_helping_verbs(app, asked);
}

}  // namespace mckibben::cli
