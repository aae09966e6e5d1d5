// The verbs of the thesis's models: calibrate, map, study.
#include <map>

#include <fmt/format.h>

#include <sim/cli/app.hpp>
#include <sim/cli/options.hpp>
#include <sim/study/study.hpp>

namespace mckibben::cli {
namespace {

constexpr const char* models_group = "The thesis's models";

template <class T>
void add_choice(CLI::App& verb, const char* name, T& value, const std::map<std::string, T>& choices,
                const char* help) {
  std::vector<std::string> words;
  words.reserve(choices.size());
  for (const auto& choice : choices) words.push_back(choice.first);
  const auto choose = [&value, choices](const std::string& text) { value = choices.at(text); };
  verb.add_option_function<std::string>(name, choose, help)->check(one_of("choice", words))->type_name("");
}

void add_calibrate(CLI::App& app, Asked& asked) {
  using namespace thesis;
  CLI::App& verb = *app.add_subcommand(
      "calibrate", "Fit the thesis's friction and pressure models to a data set; draw its figures");
  CalibrateOptions& how = asked.calibration;
  verb.group(models_group);
  add_dataset(verb, asked.path);
  add_common(verb, asked.options);
  verb.add_flag("--kgf", how.kgf, "Pressures of figures and report in kgf/m2, as the thesis prints them");
  add_choice(verb, "--pressure", how.fits.processing.pressure,
             {{"current", PressureSource::current}, {"gauge", PressureSource::gauge}},
             "Pressure from the current by the valve's line (default: current) or from the gauge");
  add_choice(verb, "--acceleration", how.fits.processing.acceleration,
             {{"counted", Acceleration::counted}, {"neglected", Acceleration::neglected}},
             "Acceleration in the force balance (default: counted)");
  add_choice(
      verb, "--fit", how.fits.fitting,
      {{"joint", PressureFitting::joint}, {"sequence", PressureFitting::sequence}},
      "Pressure coefficients from all samples at once, or from the thesis's sequence of fits (default: "
      "joint)");
  verb.add_option("--load-order", how.fits.orders.load, "Highest order in load (default: 3, the thesis's)")
      ->check(from_to(0, 3))
      ->type_name("N");
  verb.add_option("--speed-order", how.fits.orders.speed,
                  "Highest order in the current's speed (default: 2, the thesis's)")
      ->check(from_to(0, 2))
      ->type_name("N");
  verb.footer(
      "Examples:\n"
      "  mckibben calibrate data --out calibration\n"
      "  mckibben calibrate data --pressure gauge --fit sequence --kgf   as the thesis did\n"
      "Writes calibration.yaml (for the open-loop controllers), calibration.json, report.txt and "
      "figures/.\n");
  verb.callback([&asked] {
    asked.chosen = [&asked] { return calibrate_dataset(asked.path, asked.options, asked.calibration); };
  });
}

void add_map(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "map", "Map the errors of the thesis's open-loop controller over its targets (figures 4.50, 4.51)");
  MapOptions& how = asked.targets;
  verb.group(models_group);
  verb.add_option("calibration", asked.path, "Calibration file that `calibrate` wrote")
      ->required()
      ->type_name("CALIBRATION");
  add_common(verb, asked.options);
  verb.add_option_function<std::vector<std::string>>(
          "--load",
          [&how](const std::vector<std::string>& texts) {
            for (const auto& text : texts) how.loads_kg.push_back(positive_quantity(text, "kg", 500.0));
          },
          "Load such as \"8.87 kg\"; may be repeated (default: the thesis's five and its unseen 8.87 kg, "
          "those that the calibration covers; of a calibration for other loads its ends and middle)")
      ->allow_extra_args(false)
      ->type_name("LOAD");
  add_rig(verb, asked.options, "(default: thesis)");
  verb.add_flag("--up", how.up, "Going up only");
  verb.add_flag("--down", how.down, "Going down only");
  verb.add_option("--ratios", how.ratios, "How many target contraction ratios, up to e_max (default: 30)")
      ->check(from_to(1, 1000))
      ->type_name("N");
  verb.add_option("--speeds", how.speeds, "How many target speeds (default: 5)")
      ->check(from_to(1, 1000))
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
      "Examples:\n"
      "  mckibben map scenarios/thesis_calibration.yaml --load \"16.138 kg\" --up\n"
      "  mckibben map out/thesis_campaign-calibration/calibration.yaml --load \"8.87 kg\" "
      "--extrapolate-load\n"
      "Writes map.csv, table.txt, map.json and a picture for each load.\n");
  verb.callback(
      [&asked] { asked.chosen = [&asked] { return map_errors(asked.path, asked.options, asked.targets); }; });
}

void add_study(CLI::App& app, Asked& asked) {
  CLI::App& verb = *app.add_subcommand(
      "study", "Simulate and calibrate a campaign; compare what was found with what was true");
  verb.group(models_group);
  verb.add_option("name", asked.study,
                  "lag (friction or lag of valve and hose?), counting (what counts at each tick do to the "
                  "load), figures (the thesis's accuracy beside ours)")
      ->required()
      ->check(one_of("study", {study::names.begin(), study::names.end()}))
      ->type_name("");
  verb.add_option("campaign", asked.path, "Campaign file")->required()->type_name("CAMPAIGN.yaml");
  add_common(verb, asked.options);
  verb.footer(
      "Examples:\n"
      "  mckibben study lag scenarios/thesis_campaign.yaml\n"
      "  mckibben study counting scenarios/thesis_campaign.yaml --json > counting.json\n"
      "Writes NAME.md (the page), NAME.csv and NAME.svg (its picture), NAME.json (every number).\n");
  verb.callback(
      [&asked] { asked.chosen = [&asked] { return make_study(asked.study, asked.path, asked.options); }; });
}

}  // namespace

void add_model_verbs(CLI::App& app, Asked& asked) {
  add_calibrate(app, asked);
  add_map(app, asked);
  add_study(app, asked);
}

}  // namespace mckibben::cli
